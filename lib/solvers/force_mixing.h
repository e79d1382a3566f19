// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_force_mixing_h
#define ricochet_solvers_force_mixing_h

#include <base/types.h>

#include <vector>

namespace Ricochet
{
  /**
   * Anderson's acceleration (J. ACM 12, 1965; Walker and Ni, SIAM J. Numer. Anal. 49,
   * 2011, with the history in orthogonal form) of an iteration in the space of forces:
   * the iterate x(f) solves a system near the wanted one with the force f, and the
   * residual r(f) is what the wanted system leaves over. Plain steps are f - r; mixed
   * ones begin where the residual would be smallest if it were linear in what the last
   * steps span, as GMRES does.
   */
  class ForceMixing
  {
  public:
    /// @param n_kept how many steps are remembered; then it begins anew.
    explicit ForceMixing(const unsigned int n_kept)
      : n_kept(n_kept)
    {}

    /// Forget all steps.
    void
    restart();

    /// The step of the force from the iterate with this @p residual. @p step gets it.
    void
    next(const Vector &residual, Vector &step);

  private:
    // In single precision: what is forgotten by that, the next residual shows.
    using Column = std::vector<float>;

    /// The products of @p values with the changes kept, on all ranks.
    std::vector<double>
    products(const double *values) const;

    /// @p values += sum of @p factors times @p columns
    void
    add(const std::vector<double> &factors,
        const std::vector<Column> &columns,
        double                    *values) const;

    const unsigned int n_kept;
    // Orthonormal changes of the residual, and the steps of the force that make them.
    std::vector<Column> changes, steps;
    unsigned int        n_changes = 0;
    // Of the last call.
    bool                has_last = false;
    std::vector<double> last_residual, last_step;
    MPI_Comm            communicator = MPI_COMM_SELF;
  };
} // namespace Ricochet

#endif
