// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_active_set_signature_h
#define ricochet_contact_treatments_active_set_signature_h

#include <mpi.h>

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
} // namespace Ricochet

#endif
