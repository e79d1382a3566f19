// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_direct_solver_h
#define ricochet_solvers_direct_solver_h

#include <solvers/factorisation.h>
#include <solvers/tangent_solver.h>

#include <cstdint>
#include <list>
#include <memory>
#include <optional>
#include <string>

namespace Ricochet
{
  /// Factorisation of the tangent for each state of contact, of which the last
  /// few are kept; tangents without a cache key are factored one by one.
  class DirectSolver : public TangentSolver
  {
  public:
    /// @param package see Factorisation.
    DirectSolver(const std::string &package, const unsigned int n_kept)
      : package(package)
      , n_kept(n_kept)
    {}

    SolverReport::Strategy
    strategy() const override
    {
      return SolverReport::direct;
    }

    /// @return true.
    /// @throws NewtonFailure when the matrix cannot be factored.
    bool
    solve(const Tangent &tangent,
          const Vector  &right_hand_side,
          Vector        &solution,
          const bool     may_reuse,
          const double   tolerance) override;

  private:
    /// A factored tangent and its cache key.
    struct Factored
    {
      std::optional<BodyKey>         body;
      std::uint64_t                  contact = 0;
      std::uint64_t                  pattern = 0;
      Matrix                         matrix;
      std::unique_ptr<Factorisation> factorisation;
    };

    void
    factorise(const Tangent &tangent, const bool keep_pivots, Factored &entry);

    const std::string                    package;
    const unsigned int                   n_kept;
    std::list<std::unique_ptr<Factored>> kept;
    Factored                             changing;
  };
} // namespace Ricochet

#endif
