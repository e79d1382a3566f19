// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/gathered_factorisation.h>

namespace Ricochet
{
  GatheredFactorisation::GatheredFactorisation(
    std::unique_ptr<Factorisation> on_one_rank)
    : factorisation(std::move(on_one_rank))
  {}



  bool
  GatheredFactorisation::factorise(const Epetra_CrsMatrix &matrix,
                                   const bool              keep_pivots)
  {
    const Epetra_CrsMatrix &all_rows    = first_rank.gather(matrix);
    bool                    is_factored = false;
    if (first_rank.is_here())
      is_factored = factorisation->factorise(all_rows, keep_pivots);
    halves = first_rank.knows(is_factored && factorisation->has_halves());
    return first_rank.knows(is_factored);
  }



  void
  GatheredFactorisation::solve(const Vector &right_hand_side, Vector &solution)
  {
    const Vector &all = first_rank.gather(right_hand_side);
    if (first_rank.is_here())
      factorisation->solve(all, first_rank.result());
    first_rank.scatter_result(solution);
  }



  void
  GatheredFactorisation::solve(const std::vector<Vector> &right_hand_sides,
                               std::vector<Vector>       &solutions)
  {
    std::vector<Vector> all,
      all_solutions(solutions.size(), first_rank.result());
    for (const Vector &right_hand_side : right_hand_sides)
      all.push_back(first_rank.gather(right_hand_side));
    if (first_rank.is_here())
      factorisation->solve(all, all_solutions);
    for (unsigned int c = 0; c < solutions.size(); ++c)
      {
        first_rank.result().swap(all_solutions[c]);
        first_rank.scatter_result(solutions[c]);
      }
  }



  void
  GatheredFactorisation::go_forwards(const Vector        &right_hand_side,
                                     std::vector<double> &half)
  {
    const Vector &all = first_rank.gather(right_hand_side);
    if (first_rank.is_here())
      factorisation->go_forwards(all, half);
  }



  Factorisation::HalfColumns
  GatheredFactorisation::go_forwards(const Functionals &right_hand_sides)
  {
    if (first_rank.is_here())
      return factorisation->go_forwards(right_hand_sides);
    HalfColumns none;
    none.n_columns = right_hand_sides.size();
    return none;
  }



  void
  GatheredFactorisation::multiply(const HalfColumns   &left,
                                  const HalfColumns   &right,
                                  std::vector<double> &products) const
  {
    products.resize(static_cast<std::size_t>(left.n_columns) * right.n_columns);
    if (first_rank.is_here())
      factorisation->multiply(left, right, products);
    first_rank.broadcast(products.data(), products.size());
  }



  void
  GatheredFactorisation::observe(const HalfColumns         &columns,
                                 const std::vector<double> &half,
                                 double                    *values) const
  {
    if (first_rank.is_here())
      factorisation->observe(columns, half, values);
    first_rank.broadcast(values, columns.n_columns);
  }



  void
  GatheredFactorisation::subtract(const HalfColumns   &columns,
                                  const double        *coefficients,
                                  std::vector<double> &half) const
  {
    if (first_rank.is_here())
      factorisation->subtract(columns, coefficients, half);
  }



  void
  GatheredFactorisation::go_backwards(const std::vector<double> &half,
                                      Vector                    &solution)
  {
    if (first_rank.is_here())
      factorisation->go_backwards(half, first_rank.result());
    first_rank.scatter_result(solution);
  }
} // namespace Ricochet
