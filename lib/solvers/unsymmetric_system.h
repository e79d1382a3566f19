// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_unsymmetric_system_h
#define ricochet_solvers_unsymmetric_system_h

#include <solvers/dense_factors.h>
#include <solvers/functionals.h>

#include <deal.II/lac/vector.h>

#include <vector>

namespace Ricochet
{
  /// Add @p factor times the sum of the @p columns at @p places, with a coefficient for
  /// each of these places, to @p values, which may be as many as the first rows only.
  void
  add_columns(const double                            factor,
              const std::vector<std::vector<double>> &columns,
              const std::vector<unsigned int>        &places,
              const std::vector<double>              &coefficients,
              std::vector<double>                    &values);

  /**
   * Dense systems of contact that are not symmetric,
   *
   *     (1 + E + C F) z = b,
   *
   * with sparse rows E and C, and columns F of compliances.
   *
   * They may be factored in single precision, which takes half of the time; solutions
   * are those of the system in double precision nevertheless: what the factors leave of
   * the right-hand side is solved for once more, until it is small (iterative
   * refinement). Where that does not help, as the system is too near to a singular one,
   * it is factored in double precision.
   */
  class UnsymmetricSystem
  {
  public:
    /// What the matrix is made of. It is not copied.
    struct Terms
    {
      /// Of the unknowns, ascending.
      const std::vector<unsigned int> &places;
      /// E and C, a row for each unknown; those of E look at places, those of C at rows
      /// of F.
      const std::vector<FunctionalRow> &on_places, &on_values;
      /// F, by place.
      const std::vector<std::vector<double>> &columns;
    };

    /// @param may_be_single the unknowns are of one kind, so that one norm can
    /// tell of all of them how good they are.
    /// @throws NewtonFailure if the matrix is singular.
    void
    factorise(const Terms &terms, const bool may_be_single);

    /// @param vector b, becomes z, in the order of the places.
    /// @param terms those that were factored.
    /// @throws NewtonFailure if the matrix is singular.
    void
    solve(const Terms &terms, dealii::Vector<double> &vector);

    /// Whether the factors are: solve() may have made others.
    bool
    is_in_single_precision() const
    {
      return is_single;
    }

    /// Whether solve() has made others than factorise() did.
    bool
    is_made_again() const
    {
      return made_again;
    }

  private:
    /// @return whether refinement has led to a solution.
    bool
    solve_with_refinement(const Terms &terms, dealii::Vector<double> &vector);

    bool                 is_single = false, made_again = false;
    DenseFactors<double> factors;
    DenseFactors<float>  single_factors;
  };
} // namespace Ricochet

#endif
