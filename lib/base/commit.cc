// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/commit.h>

// Written by the build, see cmake/commit.cmake.
#include <ricochet_commit.h>

#include <elf.h>
#include <link.h>

#include <cstdint>
#include <cstdio>

namespace Ricochet
{
  namespace
  {
    /// The build ID in the notes of a library from @p begin to before @p end; empty without.
    std::string
    build_id_in(const std::uintptr_t begin, const std::uintptr_t end)
    {
      const auto padded = [](const std::size_t size) {
        return (size + 3) / 4 * 4;
      };
      for (std::uintptr_t at = begin; at + sizeof(ElfW(Nhdr)) <= end;)
        {
          const auto       &note  = *reinterpret_cast<const ElfW(Nhdr) *>(at);
          const auto *const bytes = reinterpret_cast<const unsigned char *>(
            at + sizeof(note) + padded(note.n_namesz));
          if (note.n_type == NT_GNU_BUILD_ID)
            {
              std::string text;
              char        digits[4];
              for (unsigned int k = 0; k < note.n_descsz; ++k)
                {
                  std::snprintf(digits, sizeof(digits), "%02x", bytes[k]);
                  text += digits;
                }
              return text;
            }
          at += sizeof(note) + padded(note.n_namesz) + padded(note.n_descsz);
        }
      return {};
    }

    /// For dl_iterate_phdr(): look for the build ID of the library that this function is in.
    int
    find_build_id(dl_phdr_info *const library, std::size_t, void *const result)
    {
      const auto  here   = reinterpret_cast<std::uintptr_t>(&find_build_id);
      bool        is_own = false;
      std::string id;
      for (unsigned int k = 0; k < library->dlpi_phnum; ++k)
        {
          const auto          &segment = library->dlpi_phdr[k];
          const std::uintptr_t begin   = library->dlpi_addr + segment.p_vaddr,
                               end     = begin + segment.p_memsz;
          if (segment.p_type == PT_LOAD && begin <= here && here < end)
            is_own = true;
          if (segment.p_type == PT_NOTE && id.empty())
            id = build_id_in(begin, end);
        }
      if (is_own)
        *static_cast<std::string *>(result) = id;
      return is_own;
    }
  } // namespace



  const char *
  commit()
  {
    return RICOCHET_COMMIT;
  }



  std::string
  checksum_of_library()
  {
    std::string id;
    dl_iterate_phdr(&find_build_id, &id);
    return id;
  }
} // namespace Ricochet
