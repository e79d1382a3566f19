// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_memory_h
#define ricochet_base_memory_h

#include <cstdlib>
#ifdef __GLIBC__
#  include <malloc.h>
#endif

namespace Ricochet
{
  /// Return freed memory to the system. The GNU C library keeps it, in pieces
  /// that large matrices and vectors do not fit in: after the set-up of a large
  /// body, half a kilobyte for each unknown.
  inline void
  return_freed_memory()
  {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
  }
} // namespace Ricochet

#endif
