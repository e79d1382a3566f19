// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_xdmf_list_h
#define ricochet_output_xdmf_list_h

#include <base/run_folder.h>

#include <map>
#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * The file `solution.xdmf`, by which ParaView reads a series of HDF5 files with their times.
   *
   * Collective: all ranks append, rank 0 writes.
   */
  class XdmfList
  {
  public:
    /// A run that is resumed takes over the entries of files that are there.
    explicit XdmfList(RunFolder &folder);

    static inline const std::string name = "solution.xdmf";

    /// The entries of a list on the disk; none where there is no such file.
    static std::vector<std::string>
    read(const std::string &file);

    /// A list as text.
    static std::string
    text_of(const std::vector<std::string> &entries);

    /// Name of the file of a @p step, in the folder.
    static std::string
    file_of(const unsigned int step);

    /// List the file of @p step, and drop those of later steps, which a resumed run repeats.
    /// @param entry the element `<Grid>` of the file; on rank 0. @throws ComputationError
    void
    append(const unsigned int step, const std::string &entry);

  private:
    const RunFolder &folder;
    // Entries by step; on rank 0.
    std::map<unsigned int, std::string> entries;
    // Whether the list on the disk has these entries.
    bool is_written = false;
  };
} // namespace Ricochet

#endif
