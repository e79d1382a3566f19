// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_ghosted_vector_h
#define ricochet_base_ghosted_vector_h

#include <base/types.h>

#include <deal.II/base/index_set.h>

#include <Epetra_Vector.h>

#include <memory>
#include <vector>

class Epetra_Import;

namespace Ricochet
{
  /**
   * Values of a vector on this rank, including those of other ranks that it
   * needs. The communication pattern is set up once, and not for each vector.
   */
  class GhostedVector
  {
  public:
    GhostedVector() = default;

    /// @param layout a vector with ghost values.
    explicit GhostedVector(const Vector &layout);

    /// The values of @p indices alone, whoever owns them. Collective.
    GhostedVector(const dealii::IndexSet &indices, const MPI_Comm communicator);

    /// Take all values from @p vector, which has no ghost values and always the same
    /// layout. Collective.
    void
    import(const Vector &vector);

    /// Number of the values().
    unsigned int
    size() const
    {
      return ghosted->MyLength();
    }

    /// Position of the unknown @p index among the values(); -1 if it is not on
    /// this rank.
    int
    local_index(const dealii::types::global_dof_index index) const;

    /// The unknown at a position among the values().
    dealii::types::global_dof_index
    index(const int local_index) const
    {
      return ghosted->Map().GID(local_index);
    }

    const double *
    values() const
    {
      return ghosted->Values();
    }

    /// The value of the unknown @p index, which must be on this rank.
    double
    operator()(const dealii::types::global_dof_index index) const
    {
      return values()[local_index(index)];
    }

  private:
    std::unique_ptr<Epetra_Vector> ghosted;
    // Whether all values are this rank's, in the same order. Otherwise several ranks have
    // an exchange, and one takes values from their places in the vector.
    bool knows_exchange = false, takes_all = false;
    std::shared_ptr<const Epetra_Import> exchange;
    std::vector<int>                     places;
  };
} // namespace Ricochet

#endif
