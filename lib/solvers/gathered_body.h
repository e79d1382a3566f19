// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_gathered_body_h
#define ricochet_solvers_gathered_body_h

#include <solvers/first_rank.h>
#include <solvers/nearby_body.h>

namespace Ricochet
{
  /// A NearbyBody on the first rank, of a body that is on several ranks.
  class GatheredBody : public FactoredBody
  {
  public:
    /// @param factorisation on one rank; else as for NearbyBody.
    GatheredBody(std::unique_ptr<Factorisation>       factorisation,
                 const ContactStructure::ActsThrough &contact,
                 TangentSolver::Costs                &spent);

    bool
    factorise(const Tangent &tangent) override;

    unsigned int
    n_functionals() const override
    {
      return places.place_of_number.size();
    }

    unsigned int
    place(const unsigned int f) const override
    {
      return places.place(f);
    }

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
    /// Gather the functionals of all ranks.
    void
    make_nearby();

    // Until there is a NearbyBody.
    std::unique_ptr<Factorisation> factorisation;
    TangentSolver::Costs          &spent;
    FirstRank                      first_rank;
    FunctionalPlaces               places;
    // The functionals of all ranks by number; and on the first rank, the body.
    ContactStructure::ActsThrough all_contact;
    std::unique_ptr<NearbyBody>   nearby;
  };
} // namespace Ricochet

#endif
