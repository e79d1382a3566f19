// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_active_set_signature_h
#define ricochet_contact_treatments_active_set_signature_h

#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace Ricochet
{
  /// "3 of 20": the number of entries of @p values that are not zero, and of
  /// all, on all ranks.
  std::string
  count_active(const std::vector<int> &values, const MPI_Comm communicator);

  /// Hash of a sequence of small integers on all ranks, the same on all.
  std::uint64_t
  global_hash(const std::vector<int> &values, const MPI_Comm communicator);

  /// Patterns of former iterates, by their hashes.
  struct FormerPatterns
  {
    std::vector<std::uint64_t> seen;

    /// Whether @p pattern has returned after another one.
    bool
    returns(const std::uint64_t pattern)
    {
      if (!seen.empty() && seen.back() == pattern)
        return false;
      const bool known =
        std::find(seen.begin(), seen.end(), pattern) != seen.end();
      seen.push_back(pattern);
      return known;
    }
  };
} // namespace Ricochet

#endif
