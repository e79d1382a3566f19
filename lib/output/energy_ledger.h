// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_energy_ledger_h
#define ricochet_output_energy_ledger_h

#include <base/program.h>

#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * The table of a run: one row per time step, each column with its unit. Rows
   * go to `energy.csv` at once, so that what was computed is on disk whatever
   * happens next; `energy.h5` holds the same table, one data set per column
   * with its unit as an attribute.
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
    };

    explicit EnergyLedger(RunFolder &folder)
      : folder(folder)
    {}

    /// Before the first row: @return the column's number.
    unsigned int
    add_column(const std::string &name, const std::string &unit);

    /// Begin `energy.csv`.
    void
    start();

    /**
     * Go on with the table that the folder holds: keep its first @p n_rows rows
     * and drop what a later part of an earlier run has added.
     * @throws InputError when it has other columns or fewer rows.
     */
    void
    resume(const unsigned int n_rows);

    /// Append one row and write it. @throws ComputationError when the disk is
    /// full.
    void
    add_row(const std::vector<double> &row);

    /// Write `energy.h5`.
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

    /// Number of the column called @p name.
    unsigned int
    column_number(const std::string &name) const;

  private:
    std::string
    header() const;

    RunFolder                       &folder;
    std::vector<Column>              column_list;
    std::vector<std::vector<double>> row_list;
    std::ofstream                    csv;
  };
} // namespace Ricochet

#endif
