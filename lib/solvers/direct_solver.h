// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_direct_solver_h
#define ricochet_solvers_direct_solver_h

#include <base/types.h>

#include <deal.II/base/parameter_handler.h>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>

class Amesos_BaseSolver;
class Epetra_LinearProblem;

namespace Ricochet
{
  /**
   * A sparse direct solver that keeps its last few factorisations.
   *
   * While a linear body moves with a constant time step, its tangent changes
   * only when a contact point opens or closes. A caller that can name its
   * tangent by a key gets a kept factorisation back when the key returns; the
   * least recently used one makes room for a new one.
   */
  class DirectSolver
  {
  public:
    struct Parameters
    {
      /// "automatic", "KLU" or "MUMPS".
      std::string  type   = "automatic";
      unsigned int n_kept = 8;

      void
      add_parameters(dealii::ParameterHandler &parameters);
    };

    /// What names a tangent: numbers that it depends on, and a hash of the
    /// state of contact.
    struct Key
    {
      double        inertia;
      double        bulk_weight;
      double        contact_weight;
      std::uint64_t contact_signature;

      bool
      operator==(const Key &other) const
      {
        return inertia == other.inertia && bulk_weight == other.bulk_weight &&
          contact_weight == other.contact_weight &&
          contact_signature == other.contact_signature;
      }
    };

    explicit DirectSolver(const Parameters &parameters);

    ~DirectSolver();

    /**
     * Solve matrix * solution = right_hand_side.
     *
     * @param key names the matrix; without it the matrix is factored afresh,
     * unless @p may_reuse and there is an older one without a key.
     * @param assemble called with an empty matrix when there is no kept
     * factorisation for @p key.
     * @throws NewtonFailure when the matrix cannot be factored.
     */
    void
    solve(const std::optional<Key>            &key,
          const std::function<void(Matrix &)> &assemble,
          const Vector                        &right_hand_side,
          Vector                              &solution,
          const bool                           may_reuse = false);

    /// Choose pivots anew in the next factorisation without a key. Between two
    /// calls pivots are kept, which is faster; after one, results do not depend
    /// on what came before, so that a resumed run repeats them digit for digit.
    void
    begin_stage()
    {
      new_pivots = true;
    }

    /// Number of factorisations made so far.
    unsigned int
    n_factorisations() const
    {
      return factorisation_count;
    }

    /// Time spent in factorising (s).
    double
    factorisation_seconds() const
    {
      return factorising;
    }

    /// Time spent in solving with factorisations (s).
    double
    back_substitution_seconds() const
    {
      return substituting;
    }

    /// The solver that is used for @p n_unknowns, "KLU" or "MUMPS".
    std::string
    chosen_type(const std::size_t n_unknowns) const;

  private:
    // The entry owns its matrix because the solver refers to it.
    struct Factorisation
    {
      std::optional<Key>                    key;
      Matrix                                matrix;
      std::unique_ptr<Epetra_LinearProblem> problem;
      std::unique_ptr<Amesos_BaseSolver>    solver;

      Factorisation();
      ~Factorisation();
    };

    /// Factor the matrix of @p entry, with the pivots of the last time if @p
    /// keep_pivots.
    void
    factorise(Factorisation &entry, const bool keep_pivots);

    const Parameters         parameters;
    std::list<Factorisation> kept;
    Factorisation            changing;
    bool                     new_pivots          = true;
    unsigned int             factorisation_count = 0;
    double                   factorising = 0., substituting = 0.;
  };
} // namespace Ricochet

#endif
