// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_ghosted_vector_h
#define ricochet_base_ghosted_vector_h

#include <base/types.h>

#include <memory>

class Epetra_Import;

namespace Ricochet
{
  /**
   * Values of a vector on this rank, those of other ranks that it needs included. What
   * is exchanged between ranks is found out once, and not with each vector.
   */
  class GhostedVector
  {
  public:
    GhostedVector() = default;

    /// @param layout a vector with ghost values.
    explicit GhostedVector(Vector layout)
      : ghosted(std::move(layout))
    {}

    /// Take all values from @p vector, which has no ghost values and always the same
    /// layout. Collective.
    void
    import(const Vector &vector);

    /// Place of the unknown @p index among the values(); -1 if it is not known here.
    int
    local_index(const dealii::types::global_dof_index index) const;

    const double *
    values() const
    {
      return ghosted.trilinos_vector()[0];
    }

    const Vector &
    vector() const
    {
      return ghosted;
    }

  private:
    Vector ghosted;
    // None where all values are this rank's, in the same order.
    std::shared_ptr<const Epetra_Import> exchange;
    bool                                 knows_exchange = false;
  };
} // namespace Ricochet

#endif
