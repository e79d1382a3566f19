// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/ghosted_vector.h>

#include <Epetra_Import.h>

#include <algorithm>

namespace Ricochet
{
  GhostedVector::GhostedVector(const Vector &layout)
    : ghosted(std::make_unique<Epetra_Vector>(layout.trilinos_vector().Map()))
  {}



  GhostedVector::GhostedVector(const dealii::IndexSet &indices,
                               const MPI_Comm          communicator)
    : ghosted(std::make_unique<Epetra_Vector>(
        indices.make_trilinos_map(communicator, true)))
  {}



  void
  GhostedVector::import(const Vector &vector)
  {
    const auto &from = vector.trilinos_vector();
    if (!knows_exchange)
      {
        const auto &map = ghosted->Map();
        takes_all       = map.SameAs(from.Map());
        if (!takes_all && map.Comm().NumProc() == 1)
          for (int i = 0; i < map.NumMyElements(); ++i)
            places.push_back(from.Map().LID(
              static_cast<dealii::TrilinosWrappers::types::int_type>(
                map.GID64(i))));
        else if (!takes_all)
          exchange = std::make_shared<const Epetra_Import>(map, from.Map());
        knows_exchange = true;
      }
    if (exchange)
      {
        const int error = ghosted->Import(from, *exchange, Insert);
        AssertThrow(error == 0, dealii::ExcTrilinosError(error));
      }
    else if (takes_all)
      std::copy_n(from[0], ghosted->MyLength(), ghosted->Values());
    else
      for (std::size_t i = 0; i < places.size(); ++i)
        ghosted->Values()[i] = from[0][places[i]];
  }



  int
  GhostedVector::local_index(const dealii::types::global_dof_index index) const
  {
    return ghosted->Map().LID(
      static_cast<dealii::TrilinosWrappers::types::int_type>(index));
  }
} // namespace Ricochet
