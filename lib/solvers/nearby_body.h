// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_nearby_body_h
#define ricochet_solvers_nearby_body_h

#include <solvers/condensed_system.h>
#include <solvers/functional_places.h>
#include <solvers/functional_products.h>
#include <solvers/factorisation.h>
#include <solvers/tangent_solver.h>
#include <solvers/triangular_factor.h>

#include <memory>
#include <vector>

namespace Ricochet
{
  /// A condensed system of a tangent that is factored when asked for.
  class FactoredBody : public CondensedSystem
  {
  public:
    /// @param contact functionals, which are not copied.
    explicit FactoredBody(const ContactStructure::ActsThrough &contact)
      : contact(contact)
    {}

    /// Factor the tangent but for Tangent::contact_change. @return whether the factors are at hand,
    /// which is the same each time; if not, this cannot be used. Collective.
    /// @throws NewtonFailure when it is singular.
    virtual bool
    factorise(const Tangent &tangent) = 0;

    const Matrix &
    body_matrix() const override
    {
      return matrix;
    }

    const ContactStructure::ActsThrough &
    acts_through() const override
    {
      return contact;
    }

    unsigned int
    n_known() const override
    {
      return contact.n_known();
    }

  protected:
    /// Make #matrix what factorise() factors.
    void
    assemble(const Tangent &tangent)
    {
      tangent.assemble_body(matrix);
      tangent.complete_constant_contact(matrix);
    }

    const ContactStructure::ActsThrough &contact;
    Matrix                               matrix;
  };

  /**
   * The symmetric part of the tangent of a body, factored, which is near that of the
   * same body in other states; condensed to the functionals f_i of contact. With the
   * halves y_i = L^{-1} P f_i the compliance is y_i D^{-1} y_j. A half is made of the few
   * columns of L on the way from its unknowns to the last one, and costs next to
   * nothing; so factors can be made anew in each step. On one rank; see GatheredBody.
   */
  class NearbyBody : public FactoredBody
  {
  public:
    /**
     * @param factorisation of symmetric parts.
     * @param contact functionals, none of which has unknowns with equations of their
     * own (clamped ones); multipliers are coupled to nothing while contact is open.
     */
    NearbyBody(std::unique_ptr<Factorisation>       factorisation,
               const ContactStructure::ActsThrough &contact,
               TangentSolver::Costs                &spent);

    bool
    factorise(const Tangent &tangent) override;

    /// The same for a matrix that is at hand, whose time the caller takes.
    bool
    factorise(const Epetra_CrsMatrix &tangent_matrix);

    unsigned int
    n_functionals() const override
    {
      return functionals.size();
    }

    unsigned int
    place(const unsigned int f) const override
    {
      return places[f];
    }

    /// @p right_hand_side is zero where unknowns are clamped.
    void
    begin(const Vector &right_hand_side) override;

    void
    observe(std::vector<double> &values) override;

    void
    finish(const std::vector<double> &coefficients, Vector &solution) override;

    void
    add_functionals(const std::vector<double> &coefficients,
                    Vector                    &vector) const override;

    std::vector<double>
    along_functionals(const Vector &vector) override;

    void
    add_compliance(const double               factor,
                   const std::vector<double> &coefficients,
                   std::vector<double>       &values) override;

    void
    solve_contact(const std::vector<FunctionalRow> &change,
                  const std::vector<FunctionalRow> &excess_change,
                  std::vector<double>              &coefficients,
                  const std::vector<double>        &values) override;

  private:
    /// That of the functional at this place.
    const TriangularFactor<float>::Half &
    half_at(const unsigned int place);

    /// The first @p n_rows entries at least of a column of the compliance.
    const std::vector<double> &
    column(const unsigned int place, const unsigned int n_rows);

    const std::unique_ptr<Factorisation> factorisation;
    const Functionals                   &functionals;
    FunctionalProducts                   products;
    TangentSolver::Costs                &spent;
    const TriangularFactor<float>       *factor = nullptr;
    // Of each functional, and the other way round.
    std::vector<unsigned int> places, functional_at;
    // By place; empty where not asked for yet.
    std::vector<TriangularFactor<float>::Half> halves;
    std::vector<std::vector<double>>           columns;
    // Of the right hand side; work space that is zero between calls.
    std::vector<double> half, dense;
    // What observe() needs of the factor for so many places, and what it finds there.
    std::vector<int>    region;
    unsigned int        region_places = 0;
    std::vector<double> partial_solution;
  };
} // namespace Ricochet

#endif
