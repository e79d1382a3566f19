// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_gathered_factorisation_h
#define ricochet_solvers_gathered_factorisation_h

#include <solvers/factorisation.h>
#include <solvers/first_rank.h>

namespace Ricochet
{
  /**
   * The factorisation of a matrix whose rows are on several ranks, by a package that
   * works on one: the first rank gets the matrix, factors it, and solves for right hand
   * sides that it gets from all ranks.
   *
   * Half solutions and columns of them (see Factorisation) lie on the first rank; on the
   * others they are empty. All functions are collective.
   */
  class GatheredFactorisation : public Factorisation
  {
  public:
    explicit GatheredFactorisation(std::unique_ptr<Factorisation> on_one_rank);

    using Factorisation::factorise;

    bool
    factorise(const Epetra_CrsMatrix &matrix, const bool keep_pivots) override;

    void
    solve(const Vector &right_hand_side, Vector &solution) override;

    void
    solve(const std::vector<Vector> &right_hand_sides,
          std::vector<Vector>       &solutions) override;

    bool
    has_halves() const override
    {
      return halves;
    }

    void
    go_forwards(const Vector        &right_hand_side,
                std::vector<double> &half) override;

    /// @param right_hand_sides the same on all ranks.
    HalfColumns
    go_forwards(const Functionals &right_hand_sides) override;

    void
    multiply(const HalfColumns   &left,
             const HalfColumns   &right,
             std::vector<double> &products) const override;

    void
    observe(const HalfColumns         &columns,
            const std::vector<double> &half,
            double                    *values) const override;

    void
    subtract(const HalfColumns   &columns,
             const double        *coefficients,
             std::vector<double> &half) const override;

    void
    go_backwards(const std::vector<double> &half, Vector &solution) override;

  private:
    const std::unique_ptr<Factorisation> factorisation;
    FirstRank                            first_rank;
    bool                                 halves = false;
  };
} // namespace Ricochet

#endif
