// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_commit_h
#define ricochet_base_commit_h

#include <string>

namespace Ricochet
{
  /// The commit that the library was built from, with a + if files differed from it; "unknown"
  /// outside of a repository.
  const char *
  commit();

  /// The checksum of the library's contents that the linker has put into it (build ID); empty
  /// where it puts none. The file, of some ten megabytes, is not read.
  std::string
  checksum_of_library();
} // namespace Ricochet

#endif
