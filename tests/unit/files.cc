// SPDX-License-Identifier: LGPL-2.1-or-later

// Files that are complete at any time, and parameters from files and command
// lines.

#include <base/exceptions.h>
#include <base/files.h>
#include <base/parameter_file.h>

#include <boost/test/unit_test.hpp>

#include <unistd.h>

#include <filesystem>
#include <fstream>

using namespace Ricochet;
namespace fs = std::filesystem;

BOOST_AUTO_TEST_SUITE(files)

namespace
{
  /// A folder of its own for a test.
  struct TemporaryFolder
  {
    TemporaryFolder()
      : path(fs::temp_directory_path() /
             ("ricochet-files-" + std::to_string(::getpid())))
    {
      fs::create_directories(path);
    }

    ~TemporaryFolder()
    {
      fs::remove_all(path);
    }

    std::string
    file(const std::string &name) const
    {
      return (path / name).string();
    }

    const fs::path path;
  };
} // namespace



BOOST_AUTO_TEST_CASE(written_atomically)
{
  const TemporaryFolder folder;
  const std::string     file = folder.file("a"), bytes("one\0two", 7);
  write_atomically(file, "before");
  write_atomically(file, bytes);
  BOOST_CHECK(read_file(file) == bytes);
  BOOST_CHECK(!fs::exists(file + unfinished));
  // A failed write leaves the old file and nothing else.
  fs::create_directory(folder.file("b"));
  BOOST_CHECK_THROW(write_atomically(folder.file("b"), bytes),
                    ComputationError);
  BOOST_CHECK(!fs::exists(folder.file("b") + unfinished));
  BOOST_CHECK_THROW(write_atomically(folder.file("no/such"), bytes),
                    ComputationError);
  BOOST_CHECK_THROW(write_atomically("/dev/full/x", bytes), ComputationError);
}

BOOST_AUTO_TEST_CASE(files_that_grow)
{
  const TemporaryFolder folder;
  {
    GrowingFile file;
    file.open(folder.file("a"), /* keep */ false);
    file.append("one ");
    file.append("two");
    file.sync();
  }
  {
    GrowingFile file;
    file.open(folder.file("a"), /* keep */ true);
    file.append(" three");
  }
  BOOST_CHECK_EQUAL(read_file(folder.file("a")), "one two three");
  GrowingFile full;
  full.open("/dev/full", /* keep */ true);
  BOOST_CHECK_THROW(full.append("x"), ComputationError);
}

BOOST_AUTO_TEST_CASE(reading_ends)
{
  const TemporaryFolder folder;
  BOOST_CHECK_THROW(read_file(folder.file("none")), InputError);
  BOOST_CHECK_THROW(read_file(folder.path.string()), InputError);
  BOOST_CHECK_THROW(read_file("/dev/zero", 1000), InputError);
}

// The check value of CRC-32, and that a text may come in pieces.
BOOST_AUTO_TEST_CASE(checksums)
{
  BOOST_CHECK_EQUAL(checksum("123456789"), 0xCBF43926u);
  BOOST_CHECK_EQUAL(checksum("6789", checksum("12345")), 0xCBF43926u);
}

BOOST_AUTO_TEST_CASE(files_to_be_read_count_from_the_file_that_names_them)
{
  const TemporaryFolder folder;
  fs::create_directory(folder.path / "sub");
  std::ofstream(folder.file("sub/inner.prm")) << "set Mesh = ../a.msh\n";
  std::ofstream(folder.file("outer.prm")) << "include sub/inner.prm\n";
  std::string              mesh;
  dealii::ParameterHandler parameters;
  parameters.add_parameter("Mesh", mesh, "", dealii::Patterns::FileName());
  const auto settings =
    read_parameter_file(folder.file("outer.prm"), parameters);
  BOOST_CHECK(fs::weakly_canonical(mesh) ==
              fs::weakly_canonical(folder.path / "a.msh"));
  BOOST_REQUIRE_EQUAL(settings.size(), 1);
  BOOST_CHECK(settings[0].where.find("inner.prm, line 1") != std::string::npos);
  BOOST_CHECK(settings[0].changes_default);
  // On the command line, from the working directory.
  set_parameter("Mesh=b.msh", parameters);
  BOOST_CHECK(mesh == (fs::current_path() / "b.msh").string());
  BOOST_CHECK_THROW(set_parameter("=1", parameters), InputError);
  BOOST_CHECK_THROW(set_parameter("/Mesh=1", parameters), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
