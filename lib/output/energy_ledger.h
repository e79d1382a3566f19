// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_energy_ledger_h
#define ricochet_output_energy_ledger_h

#include <base/run_folder.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * The energy table of a run: one row per time step, each column with its
   * unit. Rows go to `energy.csv` at once, so that computed steps are in the
   * file whatever happens next; `energy.h5` holds the same table, one data set
   * per column with its unit as an attribute.
   *
   * A value that does not exist (say, a modified energy of a method that has
   * none) is not a number in the rows and empty in the file.
   *
   * Collective: all ranks add the same rows, rank 0 writes.
   */
  class EnergyLedger
  {
  public:
    struct Column
    {
      std::string name;
      std::string unit;
      /// Whether values need not exist.
      bool may_be_empty = false;
      /// Whether it is a sum over the run.
      bool is_sum = false;
    };

    /// Record of the table in a checkpoint, by which it is identified.
    struct Seal
    {
      unsigned int  n_rows   = 0;
      std::uint32_t checksum = 0;
    };

    explicit EnergyLedger(RunFolder &folder)
      : folder(folder)
    {}

    /// Add a column before the first row. @return its number.
    unsigned int
    add_column(const std::string &name,
               const std::string &unit,
               const bool         may_be_empty = false,
               const bool         is_sum       = false);

    /// Begin `energy.csv`. @throws ComputationError
    void
    start();

    /**
     * Continue the table in the folder: keep the rows that @p seal covers, and
     * drop later rows of an earlier run.
     * @throws InputError when it has other columns, fewer rows, something that is
     * not a number, times that do not rise, or not the rows that were written.
     */
    void
    resume(const Seal &seal);

    /// Append one row and write it. @throws ComputationError when the disk is
    /// full.
    void
    add_row(const std::vector<double> &row);

    /// Wait until all rows are on the disk. @throws ComputationError @return
    /// their identification.
    Seal
    seal();

    /// Write `energy.h5`. @throws ComputationError
    void
    write_hdf5() const;

    const std::vector<Column> &
    columns() const
    {
      return column_list;
    }

    const std::vector<std::vector<double>> &
    rows() const
    {
      return row_list;
    }

    /// Number of the column called @p name, if there is one.
    std::optional<unsigned int>
    find_column(const std::string &name) const;

    /// Number of a column that is there.
    unsigned int
    column_number(const std::string &name) const;

    /// The value of the column called @p name in a @p row; 0 without that column.
    double
    value(const std::vector<double> &row, const std::string &name) const;

  private:
    std::string
    header() const;

    RunFolder                       &folder;
    std::vector<Column>              column_list;
    std::vector<std::vector<double>> row_list;
    GrowingFile                      csv;
    // Checksum of all of energy.csv.
    std::uint32_t csv_checksum = 0;
  };

  /// An energy table that a run has written.
  struct EnergyTable
  {
    std::vector<EnergyLedger::Column> columns;
    std::vector<std::vector<double>>  rows;

    /// @throws InputError when @p file cannot be read or is no such table.
    static EnergyTable
    read(const std::string &file);

    /// Number of the column called @p name. @throws InputError
    unsigned int
    column_number(const std::string &name) const;
  };
} // namespace Ricochet

#endif
