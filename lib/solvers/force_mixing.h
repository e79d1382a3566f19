// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_force_mixing_h
#define ricochet_solvers_force_mixing_h

#include <base/types.h>

#include <functional>
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
   *
   * What is remembered, and all that is done with it, is in single precision: what is
   * lost by that, the next residual shows.
   */
  class ForceMixing
  {
  public:
    /// @param n_kept how many steps are remembered; then the oldest one is forgotten.
    explicit ForceMixing(const unsigned int n_kept)
      : n_kept(n_kept)
    {}

    /// Forget all steps.
    void
    restart();

    /// The step of the force from the iterate with this @p residual. @p step gets it.
    /// @param complete makes a plain step, in its place, a better one: a
    /// linear function, if any.
    void
    next(const Vector                                     &residual,
         Vector                                           &step,
         const std::function<void(std::vector<double> &)> &complete = nullptr);

  private:
    using Column = std::vector<float>;

    /// The products of the changes from number @p first on with @p vector.
    std::vector<double>
    products(const std::vector<double> &vector, const unsigned int first) const;

    /// Add the sums of @p columns with two sets of factors to two vectors: what is
    /// read once serves both.
    void
    add(const std::vector<Column> &columns,
        const std::vector<double> &factors,
        std::vector<double>       &vector,
        const std::vector<double> &other_factors,
        std::vector<double>       &other_vector) const;

    const unsigned int n_kept;
    // Orthonormal changes of the residual, and the steps of the force that make them.
    std::vector<Column> changes, steps;
    unsigned int        n_changes = 0;
    // Of the last call, and what the changes have of the residual.
    bool                has_last = false;
    std::vector<double> last_residual, last_step, last_products;
    // Work space.
    std::vector<double> residual_now, step_now, known_step;
  };
} // namespace Ricochet

#endif
