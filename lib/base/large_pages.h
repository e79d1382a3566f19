// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_large_pages_h
#define ricochet_base_large_pages_h

#include <cstddef>
#include <limits>
#include <new>
#include <vector>

#ifdef __linux__
#  include <sys/mman.h>
#endif

namespace Ricochet
{
  /**
   * Memory of arrays that are read from end to end again and again, as factors are:
   * where the system has pages of 2 MB it is asked for them. With pages of 4 kB
   * the time goes into address translation, and the hardware prefetcher stops
   * at the end of each page.
   *
   * Small arrays are those of the standard allocator.
   */
  template <typename T>
  class LargePages
  {
  public:
    using value_type = T;

    LargePages() = default;

    template <typename U>
    LargePages(const LargePages<U> & /*other*/)
    {}

    /// @throws std::bad_alloc
    T *
    allocate(const std::size_t n)
    {
      if (n > std::numeric_limits<std::size_t>::max() / sizeof(T))
        throw std::bad_array_new_length();
      const std::size_t n_bytes = n * sizeof(T);
      if (n_bytes < page_size)
        return static_cast<T *>(::operator new(n_bytes));
      void *const memory = ::operator new(n_bytes, std::align_val_t(page_size));
#ifdef MADV_HUGEPAGE
      // The request is a hint; without it only speed is lost.
      madvise(memory, n_bytes, MADV_HUGEPAGE);
#endif
      return static_cast<T *>(memory);
    }

    void
    deallocate(T *const memory, const std::size_t n)
    {
      if (n * sizeof(T) < page_size)
        ::operator delete(memory);
      else
        ::operator delete(memory, std::align_val_t(page_size));
    }

    template <typename U>
    bool
    operator==(const LargePages<U> & /*other*/) const
    {
      return true;
    }

    template <typename U>
    bool
    operator!=(const LargePages<U> & /*other*/) const
    {
      return false;
    }

  private:
    // Bytes.
    static constexpr std::size_t page_size = std::size_t(1) << 21;
  };

  template <typename T>
  using LargeVector = std::vector<T, LargePages<T>>;
} // namespace Ricochet

#endif
