// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_factorisation_h
#define ricochet_solvers_factorisation_h

#include <base/types.h>

#include <memory>
#include <string>

namespace Ricochet
{
  /**
   * LU factorisation of one matrix, which may be repeated with other values on the same
   * pattern, by KLU or MUMPS of Trilinos' Amesos.
   */
  class Factorisation
  {
  public:
    /// @param package "KLU" or "MUMPS".
    explicit Factorisation(const std::string &package);

    ~Factorisation();

    /**
     * Factor @p matrix, the same object each time: another object needs a new
     * factorisation.
     *
     * @param keep_pivots use the pivots of the last factorisation, which is
     * faster; without it, the result does not depend on the history.
     * @return whether it succeeded; if not, the matrix is singular.
     */
    bool
    factorise(const Matrix &matrix, const bool keep_pivots);

    /// Solve matrix * @p solution = @p right_hand_side. @throws NewtonFailure
    void
    solve(const Vector &right_hand_side, Vector &solution);

  private:
    /// The linear system and its solver as Amesos has them.
    struct Amesos;

    const std::string       package;
    const double           *values = nullptr;
    std::unique_ptr<Amesos> amesos;
  };
} // namespace Ricochet

#endif
