// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_vector_operations_h
#define ricochet_base_vector_operations_h

#include <base/types.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  /// The values of @p vector on this rank, its ghost values included.
  inline double *
  local_values(Vector &vector)
  {
    return vector.trilinos_vector()[0];
  }

  inline const double *
  local_values(const Vector &vector)
  {
    return vector.trilinos_vector()[0];
  }

  /// @p to = @p from, two vectors of one layout without ghost values, or @p to has no
  /// size yet. deal.II's assignment asks each time how two layouts go together, which
  /// in a time step takes longer than to copy.
  inline void
  copy_values(const Vector &from, Vector &to)
  {
    if (to.size() != from.size() || to.has_ghost_elements() ||
        to.locally_owned_size() != from.locally_owned_size())
      to = from;
    else
      std::copy_n(local_values(from),
                  from.locally_owned_size(),
                  local_values(to));
  }

  /// The values of a rank, without ghost values, for expressions that go through them
  /// once; operators of vectors make a pass, and a few checks, for each operation.
  inline Eigen::Map<const Eigen::VectorXd>
  entries(const Vector &vector)
  {
    return {local_values(vector),
            static_cast<Eigen::Index>(vector.locally_owned_size())};
  }

  inline Eigen::Map<Eigen::VectorXd>
  entries(Vector &vector)
  {
    return {local_values(vector),
            static_cast<Eigen::Index>(vector.locally_owned_size())};
  }

  /// The l2 norm of the first @p n values of each rank of @p vector, with
  /// several partial sums at a time, for speed, unlike that of Trilinos.
  /// Collective.
  inline double
  l2_norm(const Vector &vector, const unsigned int n)
  {
    const double square =
      Eigen::Map<const Eigen::VectorXd>(local_values(vector), n).squaredNorm();
    return std::sqrt(
      dealii::Utilities::MPI::sum(square, vector.get_mpi_communicator()));
  }

  /// As above, for all values.
  inline double
  l2_norm(const Vector &vector)
  {
    return l2_norm(vector, vector.locally_owned_size());
  }

  /// The product of two expressions of entries(), summed over all ranks. Collective.
  template <typename Left, typename Right>
  double
  product(const Eigen::MatrixBase<Left>  &left,
          const Eigen::MatrixBase<Right> &right,
          const MPI_Comm                  communicator)
  {
    return dealii::Utilities::MPI::sum(left.dot(right), communicator);
  }
} // namespace Ricochet

#endif
