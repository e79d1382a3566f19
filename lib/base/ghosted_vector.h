// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_ghosted_vector_h
#define ricochet_base_ghosted_vector_h

#include <base/types.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/read_write_vector.h>

#include <memory>
#include <vector>

namespace Ricochet
{
  /**
   * Values of a vector on this rank, including those of other ranks that it
   * needs, in the order of their indices. The communication pattern is set up
   * once, and not for each vector.
   */
  class GhostedVector
  {
  public:
    GhostedVector() = default;

    /// @param layout a vector with ghost values.
    explicit GhostedVector(const Vector &layout)
      : GhostedVector(dealii::IndexSet(layout.trilinos_partitioner()))
    {}

    /// The values of @p indices alone, whoever owns them.
    explicit GhostedVector(const dealii::IndexSet &indices)
      : ghosted(std::make_unique<Values>(indices))
    {}

    /// Take all values from @p vector, which has no ghost values and always the same
    /// layout. Collective.
    void
    import(const Vector &vector);

    /// Number of the values().
    unsigned int
    size() const
    {
      return ghosted->locally_owned_size();
    }

    /// Position of the unknown @p index among the values(); -1 if it is not on
    /// this rank.
    int
    local_index(const dealii::types::global_dof_index index) const
    {
      return index < indices().size() && indices().is_element(index)
        ? static_cast<int>(indices().index_within_set(index))
        : -1;
    }

    /// The unknown at a position among the values().
    dealii::types::global_dof_index
    index(const int local_index) const
    {
      return indices().nth_index_in_set(local_index);
    }

    const double *
    values() const
    {
      return ghosted->begin();
    }

    /// The value of the unknown @p index, which must be on this rank.
    double
    operator()(const dealii::types::global_dof_index index) const
    {
      return values()[local_index(index)];
    }

  private:
    using Values = dealii::LinearAlgebra::ReadWriteVector<double>;

    const dealii::IndexSet &
    indices() const
    {
      return ghosted->get_stored_elements();
    }

    std::unique_ptr<Values> ghosted;
    // Whether there is one rank, and whether it takes all values in their order; otherwise
    // it takes them from their places in the vector. Several ranks exchange them.
    bool knows_exchange = false, is_alone = false, takes_all = false;
    std::vector<int> places;
  };
} // namespace Ricochet

#endif
