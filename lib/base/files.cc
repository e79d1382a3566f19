// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/files.h>

#include <boost/crc.hpp>
#include <boost/serialization/utility.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

namespace Ricochet
{
  namespace
  {
    [[noreturn]] void
    cannot_write(const std::string &file, const int error)
    {
      // The limit on the size of a file is one that the user or a batch system
      // has set; the system's own text speaks of a file too large.
      throw ComputationError(
        "'" + file + "' cannot be written: " + std::strerror(error) + ".");
    }

    void
    write_all(const int          descriptor,
              const std::string &bytes,
              const std::string &file)
    {
      for (std::size_t done = 0; done < bytes.size();)
        {
          const ssize_t n =
            ::write(descriptor, bytes.data() + done, bytes.size() - done);
          if (n < 0 && errno == EINTR)
            continue;
          if (n <= 0)
            cannot_write(file, n < 0 ? errno : ENOSPC);
          done += n;
        }
    }

    void
    sync_to_disk(const int descriptor, const std::string &file)
    {
      // Pipes and some file systems know no fsync().
      if (::fsync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP)
        cannot_write(file, errno);
    }

    /// A file that disappears unless keep() is called.
    class NewFile
    {
    public:
      explicit NewFile(const std::string &file)
        : file(file)
        , name(file + unfinished)
        , descriptor(::open(name.c_str(),
                            O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC,
                            0666))
      {
        if (descriptor < 0)
          cannot_write(file, errno);
      }

      ~NewFile()
      {
        if (descriptor >= 0)
          ::close(descriptor);
        if (!kept)
          ::unlink(name.c_str());
      }

      NewFile(const NewFile &) = delete;
      NewFile &
      operator=(const NewFile &) = delete;

      void
      append(const std::string &bytes)
      {
        write_all(descriptor, bytes, file);
      }

      /// Replace the old file.
      void
      keep()
      {
        sync_to_disk(descriptor, file);
        const int error = ::close(descriptor);
        descriptor      = -1;
        if (error != 0)
          cannot_write(file, errno);
        if (std::rename(name.c_str(), file.c_str()) != 0)
          cannot_write(file, errno);
        kept = true;
        // The name is part of the folder, which is on the disk only now.
        const std::string folder =
          std::filesystem::path(file).parent_path().string();
        const int folder_descriptor =
          ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_CLOEXEC);
        if (folder_descriptor >= 0)
          {
            ::fsync(folder_descriptor);
            ::close(folder_descriptor);
          }
      }

    private:
      const std::string file, name;
      int               descriptor;
      bool              kept = false;
    };
  } // namespace



  void
  write_atomically(const std::string &file, const std::string &bytes)
  {
    NewFile new_file(file);
    new_file.append(bytes);
    new_file.keep();
  }



  void
  write_atomically(const std::string &file,
                   const std::string &my_piece,
                   const MPI_Comm     communicator)
  {
    using namespace dealii::Utilities::MPI;
    const unsigned int n_ranks = n_mpi_processes(communicator);
    const int          tag     = 4711;
    if (this_mpi_process(communicator) != 0)
      {
        // Pieces are as long as they like, messages are not.
        const std::uint64_t size = my_piece.size();
        MPI_Send(&size, 1, MPI_UINT64_T, 0, tag, communicator);
        for (std::uint64_t sent = 0; sent < size;)
          {
            const int n = std::min<std::uint64_t>(size - sent, 1 << 30);
            MPI_Send(my_piece.data() + sent, n, MPI_CHAR, 0, tag, communicator);
            sent += n;
          }
      }
    on_first_rank(communicator, [&]() {
      // A problem is reported when all pieces have come: no rank waits for
      // ever.
      std::string              problem;
      std::unique_ptr<NewFile> new_file;
      const auto               careful = [&](const auto &action) {
        if (!problem.empty())
          return;
        try
          {
            action();
          }
        catch (const ComputationError &error)
          {
            problem = error.what();
          }
      };
      careful([&]() {
        new_file = std::make_unique<NewFile>(file);
        new_file->append(my_piece);
      });
      std::string piece;
      for (unsigned int rank = 1; rank < n_ranks; ++rank)
        {
          std::uint64_t size = 0;
          MPI_Recv(&size,
                   1,
                   MPI_UINT64_T,
                   rank,
                   tag,
                   communicator,
                   MPI_STATUS_IGNORE);
          piece.resize(size);
          for (std::uint64_t received = 0; received < size;)
            {
              const int n = std::min<std::uint64_t>(size - received, 1 << 30);
              MPI_Recv(piece.data() + received,
                       n,
                       MPI_CHAR,
                       rank,
                       tag,
                       communicator,
                       MPI_STATUS_IGNORE);
              received += n;
            }
          careful([&]() { new_file->append(piece); });
        }
      careful([&]() { new_file->keep(); });
      if (!problem.empty())
        throw ComputationError(problem);
    });
  }



  bool
  replace_end(const std::string &file,
              const std::string &old_end,
              const std::string &bytes)
  {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
    if (descriptor < 0)
      return false;
    const auto fail = [&](const int error) {
      ::close(descriptor);
      cannot_write(file, error);
    };
    const off_t size  = ::lseek(descriptor, 0, SEEK_END);
    const off_t begin = size - static_cast<off_t>(old_end.size());
    std::string end(old_end.size(), '\0');
    if (begin < 0 ||
        ::pread(descriptor, end.data(), end.size(), begin) !=
          static_cast<ssize_t>(end.size()) ||
        end != old_end)
      {
        ::close(descriptor);
        return false;
      }
    // In one piece, so that a run that is killed leaves all of it or nothing.
    const ssize_t written =
      ::pwrite(descriptor, bytes.data(), bytes.size(), begin);
    if (written != static_cast<ssize_t>(bytes.size()))
      {
        const int  error = written < 0 ? errno : ENOSPC;
        const bool is_restored =
          ::pwrite(descriptor, end.data(), end.size(), begin) ==
            static_cast<ssize_t>(end.size()) &&
          ::ftruncate(descriptor, size) == 0;
        fail(is_restored ? error : EIO);
      }
    if (::close(descriptor) != 0)
      cannot_write(file, errno);
    return true;
  }



  std::string
  read_file(const std::string &file, const std::size_t largest_size)
  {
    const auto fail = [&](const int error) {
      throw InputError("'" + file +
                       "' cannot be read: " + std::strerror(error) + ".");
    };
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
      fail(errno);
    std::string bytes, block(1 << 16, '\0');
    ssize_t     n = 0;
    while ((n = ::read(descriptor, block.data(), block.size())) != 0)
      {
        if (n > 0)
          {
            bytes.append(block, 0, n);
            if (bytes.size() > largest_size)
              {
                ::close(descriptor);
                throw InputError("'" + file + "' is larger than " +
                                 std::to_string(largest_size) +
                                 " bytes, which is not expected of it.");
              }
          }
        else if (errno != EINTR)
          {
            const int error = errno;
            ::close(descriptor);
            fail(error);
          }
      }
    ::close(descriptor);
    return bytes;
  }



  std::uint32_t
  checksum(const std::string &bytes, const std::uint32_t before)
  {
    // Boost's class goes on from a remainder, which is a checksum inverted and
    // with its bits in the opposite order.
    std::uint32_t remainder = 0;
    for (unsigned int bit = 0; bit < 32; ++bit)
      remainder |= ((~before >> bit) & 1u) << (31 - bit);
    boost::crc_32_type crc(remainder);
    crc.process_bytes(bytes.data(), bytes.size());
    return crc.checksum();
  }



  GrowingFile::~GrowingFile()
  {
    if (descriptor >= 0)
      ::close(descriptor);
  }



  void
  GrowingFile::open(const std::string &file, const bool keep)
  {
    if (descriptor >= 0)
      ::close(descriptor);
    name = file;
    descriptor =
      ::open(file.c_str(),
             O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | (keep ? 0 : O_TRUNC),
             0666);
    if (descriptor < 0)
      cannot_write(file, errno);
  }



  void
  GrowingFile::append(const std::string &bytes)
  {
    if (descriptor >= 0)
      write_all(descriptor, bytes, name);
  }



  void
  GrowingFile::sync()
  {
    if (descriptor >= 0)
      sync_to_disk(descriptor, name);
  }



  FolderLock::~FolderLock()
  {
    if (descriptor >= 0)
      ::close(descriptor);
  }



  std::string
  FolderLock::take(const std::string &folder)
  {
    const std::string file = (std::filesystem::path(folder) / ".lock").string();
    descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0)
      throw InputError("The output folder '" + folder +
                       "' cannot be written to: " + std::strerror(errno) + ".");
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0)
      return {};
    if (errno == EWOULDBLOCK)
      throw InputError("The output folder '" + folder +
                       "' is in use by another run. Wait for it, or name "
                       "another folder with --output-dir.");
    return "note: the output folder cannot be locked (" +
      std::string(std::strerror(errno)) +
      "), so that nothing keeps another run from writing to it";
  }



  void
  on_first_rank(const MPI_Comm               communicator,
                const std::function<void()> &action)
  {
    using namespace dealii::Utilities::MPI;
    // Kind of the failure: none, the input, or the computation.
    std::pair<int, std::string> problem;
    if (this_mpi_process(communicator) == 0)
      try
        {
          action();
        }
      catch (const InputError &error)
        {
          problem = {1, error.what()};
        }
      catch (const ComputationError &error)
        {
          problem = {2, error.what()};
        }
    problem = broadcast(communicator, problem, 0);
    if (problem.first == 1)
      throw InputError(problem.second);
    if (problem.first == 2)
      throw ComputationError(problem.second);
  }
} // namespace Ricochet
