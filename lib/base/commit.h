// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_commit_h
#define ricochet_base_commit_h

namespace Ricochet
{
  /// The commit that the library was built from, with a + if files differed from it; "unknown"
  /// outside of a repository.
  const char *
  commit();
} // namespace Ricochet

#endif
