// SPDX-License-Identifier: LGPL-2.1-or-later
#ifdef __AVX2__

#  include <unistd.h>

namespace
{
  /// A library that was compiled for another processor says so, instead of
  /// ending with an illegal instruction. This check runs before the rest of the
  /// library and has no such instruction itself.
  [[gnu::constructor(101), gnu::target("no-avx")]] void
  check_processor()
  {
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2"))
      return;
    constexpr char message[] =
      "Error: Ricochet was compiled for processors with AVX2, which this one does "
      "not have. Configure it with -D RICOCHET_AVX2=OFF.\n";
    [[maybe_unused]] const ssize_t n_written =
      write(STDERR_FILENO, message, sizeof(message) - 1);
    _exit(1);
  }
} // namespace

#endif
