// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/stopwatch.h>
#include <solvers/krylov_solver.h>

#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>

#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  void
  KrylovSolver::forget_condensed()
  {
    has_condensed = false;
  }



  std::unique_ptr<FactoredBody>
  KrylovSolver::make_nearby()
  {
    if (factorisations.is_gathered(true))
      return std::make_unique<GatheredBody>(make_cholesky_factorisation(true),
                                            *contact.functionals,
                                            spent);
    return std::make_unique<NearbyBody>(factorisations.make(true, true),
                                        *contact.functionals,
                                        spent);
  }



  CondensedSystem &
  KrylovSolver::condensed(const Tangent &tangent)
  {
    const bool is_new = !has_condensed;
    has_condensed     = false;
    if (!body)
      {
        if (!nearby)
          nearby = make_nearby();
        if (!is_new || nearby->factorise(tangent))
          {
            has_condensed = true;
            return *nearby;
          }
        nearby.reset();
      }

    if (!body)
      {
        LowRankCorrection::Options options;
        options.is_symmetric =
          !contact.is_clamped && factorisations.name(true) == "CHOLMOD";
        body = std::make_unique<CorrectedFactorisation>(
          factorisations.make(true, true),
          CorrectedFactorisation::Correction::functionals,
          contact,
          options,
          spent);
      }
    if (is_new)
      {
        body->set_body(tangent);
        ++spent.n_factorisations;
        if (!body->factorise())
          throw NewtonFailure("The tangent of the body cannot be factored.");
      }
    has_condensed = true;
    return *body;
  }



  bool
  KrylovSolver::solve(const Tangent &tangent,
                      const Vector  &right_hand_side,
                      Vector        &solution,
                      const bool     may_reuse,
                      const double   tolerance)
  {
    if (!factorisation)
      {
        // Symmetric contact is factored together with the body.
        factorisation = std::make_unique<CorrectedFactorisation>(
          factorisations.make(true, true),
          contact.is_nearly_symmetric
            ? CorrectedFactorisation::Correction::none
            : CorrectedFactorisation::Correction::rows,
          contact,
          LowRankCorrection::Options{0, false},
          spent);
        stage_begins = true;
      }
    // An older tangent only serves after it was set up once in this stage.
    const bool new_tangent = stage_begins || !may_reuse;
    if (new_tangent)
      factorisation->set_body(tangent);

    struct Preconditioner
    {
      CorrectedFactorisation &factorisation;

      void
      vmult(Vector &result, const Vector &vector) const
      {
        factorisation.solve(vector, result);
      }
    };
    solution = 0.;
    // Within a stage tangents resemble each other, but for the first ones: the
    // last factorisation serves while GMRES does not need many more iterations
    // than with a new one (some two for each decade).
    for (const bool factorise : {false, true})
      {
        if (!factorise && stage_begins)
          continue;
        if (factorise)
          {
            ++spent.n_factorisations;
            stage_begins = false;
            if (!factorisation->factorise())
              break;
          }
        if (new_tangent || factorise)
          factorisation->set_contact(tangent);
        const Stopwatch    stopwatch(spent.substituting);
        const unsigned int max_iterations =
          factorise ? 60 : 2 + std::lround(-2.5 * std::log10(tolerance));
        SolverControl                       control(max_iterations,
                              tolerance * right_hand_side.l2_norm());
        SolverGMRES<Vector>::AdditionalData data(max_iterations + 2, true);
        SolverGMRES<Vector>                 gmres(control, data);
        try
          {
            gmres.solve(factorisation->matrix(),
                        solution,
                        right_hand_side,
                        Preconditioner{*factorisation});
            return true;
          }
        catch (const SolverControl::NoConvergence &)
          {}
      }
    factorisation.reset();
    return false;
  }
} // namespace Ricochet
