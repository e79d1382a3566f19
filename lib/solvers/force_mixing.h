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
   * the iterate x(f) solves an approximate system with the force f, and r(f) is the
   * residual of the exact system. Plain steps are f - r; accelerated ones begin where
   * the residual would be smallest if it were linear in the span of the last steps, as
   * in GMRES.
   *
   * The history, and all operations with it, are in single precision: the next
   * residual includes the error of that.
   */
  class ForceMixing
  {
  public:
    /// @param n_kept number of steps in the history; after that the oldest one is
    /// dropped.
    explicit ForceMixing(const unsigned int n_kept)
      : n_kept(n_kept)
    {}

    /// Drop the history.
    void
    restart();

    /// The step of the force from the iterate with this @p residual, written to
    /// @p step.
    void
    next(const Vector &residual, Vector &step);

  private:
    using Column = std::vector<float>;

    /// The products of the changes from index @p first on with @p vector.
    std::vector<double>
    products(const std::vector<double> &vector, const unsigned int first) const;

    /// Add the sums of @p columns with two sets of factors to two vectors, so that
    /// columns are read once for both.
    void
    add(const std::vector<Column> &columns,
        const std::vector<double> &factors,
        std::vector<double>       &vector,
        const std::vector<double> &other_factors,
        std::vector<double>       &other_vector) const;

    const unsigned int n_kept;
    // Orthonormal changes of the residual, and the steps of the force that cause
    // them.
    std::vector<Column> changes, steps;
    unsigned int        n_changes = 0;
    // Residual and step of the last call, and the products of that residual
    // with the changes.
    bool                has_last = false;
    std::vector<double> last_residual, last_step, last_products;
    // Work space.
    std::vector<double> residual_now, step_now;
  };
} // namespace Ricochet

#endif
