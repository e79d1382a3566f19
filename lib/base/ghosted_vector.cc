// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/ghosted_vector.h>
#include <base/vector_operations.h>

#include <algorithm>

namespace Ricochet
{
  void
  GhostedVector::import(const Vector &vector)
  {
    const double *from = local_values(vector);
    if (!knows_exchange)
      {
        const dealii::IndexSet owned = vector.locally_owned_elements();
        is_alone                     = dealii::Utilities::MPI::n_mpi_processes(
                     vector.get_mpi_communicator()) == 1;
        takes_all = is_alone && owned == indices();
        if (is_alone && !takes_all)
          for (const auto index : indices())
            places.push_back(owned.index_within_set(index));
        knows_exchange = true;
      }
    if (takes_all)
      std::copy_n(from, size(), ghosted->begin());
    else if (is_alone)
      for (std::size_t i = 0; i < places.size(); ++i)
        ghosted->begin()[i] = from[places[i]];
    else
      ghosted->import(vector, dealii::VectorOperation::insert);
  }
} // namespace Ricochet
