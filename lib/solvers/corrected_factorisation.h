// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_corrected_factorisation_h
#define ricochet_solvers_corrected_factorisation_h

#include <base/types.h>
#include <solvers/factorisation.h>
#include <solvers/condensed_system.h>
#include <solvers/low_rank_correction.h>
#include <solvers/tangent.h>
#include <solvers/tangent_solver.h>

#include <memory>
#include <vector>

namespace Ricochet
{
  /**
   * A factorisation of the matrix of a body, and solutions with that matrix
   * after contact was added to it: a LowRankCorrection, either by the rows that
   * contact changes or by the functionals through which it acts.
   *
   * The matrix of the body is that with open contact, which is the matrix of the
   * body alone for most treatments.
   */
  class CorrectedFactorisation : public CondensedSystem
  {
  public:
    using Index = Factorisation::Index;

    /// How contact enters.
    enum class Correction
    {
      /// Not at all: what is factored holds it.
      none,
      /// By the rows that it changes, whatever it does there.
      rows,
      /// By the functionals through which it acts: fewer, where points know many
      /// unknowns.
      functionals
    };

    /**
     * @param factorisation of the body's matrix.
     * @param contact rows and functionals.
     * @param options of the correction.
     * @param spent gets what it takes to factor and to solve for columns added, and
     * the number of solutions.
     */
    CorrectedFactorisation(std::unique_ptr<Factorisation>    factorisation,
                           const Correction                  correction,
                           const ContactStructure           &contact,
                           const LowRankCorrection::Options &options,
                           TangentSolver::Costs             &spent);

    ~CorrectedFactorisation() override;

    /**
     * A new matrix of the body, that of @p tangent with open contact. It is not
     * factored yet: until factorise() is called, an older factorisation serves
     * as that of a nearby matrix.
     */
    void
    set_body(const Tangent &tangent);

    /// Factor the matrix of the body. @return whether it could be done.
    bool
    factorise();

    /// A new state of contact, that of @p tangent.
    void
    set_contact(const Tangent &tangent);

    void
    solve(const Vector &right_hand_side, Vector &solution);

    // As a system condensed to functionals, if contact enters by them; the body
    // has to be factored.
    const Matrix &
    body_matrix() const override
    {
      return tangent_matrix;
    }

    const ContactStructure::ActsThrough &
    acts_through() const override
    {
      return *contact.functionals;
    }

    unsigned int
    n_functionals() const override
    {
      return correction->n_places();
    }

    unsigned int
    n_known() const override
    {
      return contact.functionals->n_known();
    }

    unsigned int
    place(const unsigned int f) const override
    {
      return correction->place(f);
    }

    void
    begin(const Vector &right_hand_side) override;

    void
    observe(std::vector<double> &values) override;

    void
    finish(const std::vector<double> &coefficients, Vector &solution) override;

    std::vector<double>
    along_functionals(const Vector &vector) override;

    void
    add_functionals(const std::vector<double> &coefficients,
                    Vector                    &vector) const override
    {
      correction->add_directions(coefficients, vector);
    }

    void
    add_compliance(const double               factor,
                   const std::vector<double> &coefficients,
                   std::vector<double>       &values) override;

    void
    solve_contact(const std::vector<FunctionalRow> &change,
                  const std::vector<FunctionalRow> &excess_change,
                  std::vector<double>              &coefficients,
                  const std::vector<double>        &values) override;

    /// The tangent of the last set_contact(), unless contact enters by
    /// functionals.
    const Matrix &
    matrix() const
    {
      return tangent_matrix;
    }

  private:
    /// A row that contact changes, in the order of the directions.
    struct OwnedRow
    {
      int     local;
      int     n_entries;
      double *values;
      /// Of the body alone and with open contact.
      std::vector<double> body, open;
      /// Place among the observables of each entry.
      std::vector<unsigned int> observable;
    };

    void
    make_row_correction();

    /// The rows of #change and #excess_change are those between the functionals that this
    /// rank knows; give them to the correction.
    void
    set_change_of_functionals(const bool may_update);

    void
    save_rows(std::vector<double> OwnedRow::*copy);

    void
    restore_rows(const std::vector<double> OwnedRow::*copy);

    // Before the factorisation, which refers to it to its end.
    Matrix                               tangent_matrix;
    const std::unique_ptr<Factorisation> factorisation;
    const Correction                     kind;
    const ContactStructure              &contact;
    const LowRankCorrection::Options     options;
    TangentSolver::Costs                &spent;
    std::vector<OwnedRow>                rows;
    std::vector<LowRankCorrection::Row>  change, excess_change;
    std::unique_ptr<LowRankCorrection>   correction;
    // The solution of begin(), or half of it.
    Vector body_solution, work;
    // Whether there was a state of contact since begin().
    bool                has_seen_contact = false;
    std::vector<double> half;
  };
} // namespace Ricochet

#endif
