// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_time_table_h
#define ricochet_base_time_table_h

#include <deal.II/base/function_lib.h>

#include <string>
#include <vector>

namespace Ricochet
{
  /// Functions of the time from a table: linear between its rows, and constant before the
  /// first and after the last one.
  class TimeTable
  {
  public:
    /**
     * Read a file with a row for each time: the time (s), then the values, separated by
     * commas, semicolons or blanks. Lines that begin with # are comments, and the first line
     * may have the names of the columns.
     *
     * @param name of the parameter, for messages.
     * @throws InputError for a file that cannot be read, with the line: fewer than two rows,
     * rows of different length, what is no number, and times that do not grow.
     */
    TimeTable(const std::string &file, const std::string &name);

    unsigned int
    n_values() const
    {
      return functions.size();
    }

    /// Value number @p k at @p time (s).
    double
    value(const unsigned int k, const double time) const
    {
      return functions[k].value(dealii::Point<1>(time));
    }

  private:
    std::vector<dealii::Functions::InterpolatedTensorProductGridData<1>>
      functions;
  };
} // namespace Ricochet

#endif
