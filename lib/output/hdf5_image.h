// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_hdf5_image_h
#define ricochet_output_hdf5_image_h

#include <cstdint>
#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * An HDF5 file that is made in memory, as HDF5 itself does not always notice that a disk is
   * full. On one rank.
   */
  class Hdf5Image
  {
  public:
    /// @throws ComputationError here and in all members, where HDF5 fails.
    Hdf5Image();

    ~Hdf5Image();

    Hdf5Image(const Hdf5Image &) = delete;
    Hdf5Image &
    operator=(const Hdf5Image &) = delete;

    /**
     * Add a table of numbers, whose groups are made as needed.
     *
     * @param path "NAME" or "GROUP/NAME".
     * @param values row by row.
     * @param n_columns 1 for a list; @p values has a multiple of it.
     * @param unit the attribute "unit".
     */
    void
    add(const std::string         &path,
        const std::vector<double> &values,
        const unsigned int         n_columns,
        const std::string         &unit);

    /// Add a number as an attribute of the whole file.
    void
    add_attribute(const std::string &name, const double value);

    /// The contents of the file so far.
    std::string
    bytes() const;

  private:
    // A handle of HDF5.
    std::int64_t file;
  };
} // namespace Ricochet

#endif
