// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/commit.h>

// Written by the build, see cmake/commit.cmake.
#include <ricochet_commit.h>

namespace Ricochet
{
  const char *
  commit()
  {
    return RICOCHET_COMMIT;
  }
} // namespace Ricochet
