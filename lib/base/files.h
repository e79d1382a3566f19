// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_files_h
#define ricochet_base_files_h

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <string>

namespace Ricochet
{
  /// The end of the name of a file while it is written.
  inline const std::string unfinished = ".unfinished";

  /**
   * Write @p bytes to a new file beside @p file, wait until they are on the disk,
   * and let it replace @p file: whatever happens, there is the old file or the
   * new one, and never a part of one.
   *
   * @throws ComputationError naming the file, when it cannot be written (disk
   * full, folder not writable); the old file is then still there.
   */
  void
  write_atomically(const std::string &file, const std::string &bytes);

  /**
   * The same for a file that ranks write together: the pieces one after another,
   * in the order of the ranks. The first rank writes; at most one piece of another
   * rank is in its memory at a time. Collective.
   *
   * @throws ComputationError on all ranks.
   */
  void
  write_atomically(const std::string &file,
                   const std::string &my_piece,
                   const MPI_Comm     communicator);

  /**
   * Write @p bytes, which are more, over the @p old_end of a @p file.
   *
   * @return whether the file could be read, and ended so.
   * @throws ComputationError naming the file, when the disk is full; the file is then as it
   * was.
   */
  bool
  replace_end(const std::string &file,
              const std::string &old_end,
              const std::string &bytes);

  /**
   * All bytes of @p file.
   *
   * @throws InputError naming the file, when it cannot be read to its end or has
   * more than @p largest_size bytes (a device may never end).
   */
  std::string
  read_file(
    const std::string &file,
    const std::size_t  largest_size = std::numeric_limits<std::size_t>::max());

  /// CRC-32 of @p bytes, continued from that of what came before.
  std::uint32_t
  checksum(const std::string &bytes, const std::uint32_t before = 0);

  /// A file that grows at its end, each time by all that it is given.
  class GrowingFile
  {
  public:
    GrowingFile() = default;
    ~GrowingFile();
    GrowingFile(const GrowingFile &) = delete;
    GrowingFile &
    operator=(const GrowingFile &) = delete;

    /// Open @p file, empty unless @p keep. @throws ComputationError
    void
    open(const std::string &file, const bool keep);

    /// @throws ComputationError naming the file, when the disk is full.
    void
    append(const std::string &bytes);

    /// Wait until all is on the disk. @throws ComputationError
    void
    sync();

  private:
    std::string name;
    int         descriptor = -1;
  };

  /// A folder that no other process writes to while this lives.
  class FolderLock
  {
  public:
    FolderLock() = default;
    ~FolderLock();
    FolderLock(const FolderLock &) = delete;
    FolderLock &
    operator=(const FolderLock &) = delete;

    /**
     * Lock @p folder, by a file in it. The lock ends with the process, however
     * that ends.
     *
     * @return what is to be noted: some file systems have no locks.
     * @throws InputError when another process has it, or the folder cannot be
     * written to.
     */
    std::string
    take(const std::string &folder);

  private:
    int descriptor = -1;
  };

  /**
   * Do @p action on the first rank. An InputError or ComputationError there is
   * thrown on all ranks alike. Collective.
   */
  void
  on_first_rank(const MPI_Comm               communicator,
                const std::function<void()> &action);
} // namespace Ricochet

#endif
