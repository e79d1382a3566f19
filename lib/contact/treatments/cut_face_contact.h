// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_cut_face_contact_h
#define ricochet_contact_treatments_cut_face_contact_h

#include <contact/treatments/pointwise_contact.h>

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace Ricochet
{
  /**
   * Pointwise contact of two bodies on the cut faces between them: it couples
   * unknowns that the bodies do not, with a constant pattern.
   *
   * Multipliers of nodes opposite to no facet are zero.
   */
  class CutFaceContact : public PointwiseContact
  {
  public:
    /// The parameters are those of PointwiseContact.
    /// @param slave_area by boundary id (m^(dim-1)).
    template <int dim>
    CutFaceContact(
      const Body<dim>                                    &body,
      std::unique_ptr<ContactLaw>                         law,
      const ContactPoints                                &points,
      const std::map<dealii::types::boundary_id, double> &slave_area,
      const RegularisedFriction                          &friction,
      const double                                        augmentation,
      const bool                                          modified_energy)
      : PointwiseContact(body,
                         std::move(law),
                         points,
                         points,
                         friction,
                         augmentation,
                         modified_energy)
      , slave_area(slave_area)
    {
      find_couplings(points);
      find_free_multipliers(points,
                            body.multiplier_indices(),
                            body.communicator);
      // The structure is not that of contact with an obstacle, as the rows are
      // on both bodies.
      own_structure                  = {};
      own_structure.has_multipliers  = traits_of_law().needs_multiplier;
      own_structure.couplings_change = true;
      // A slave with no part in front of the master has no gap.
      own_traits.gaps_may_be_unknown = true;
    }

    void
    add_residual(const Vector &solution, Vector &residual) override;

    void
    add_tangent(Matrix &tangent) const override;

    /// Areas and mean pressures are those of the whole slave, mean gaps those of its
    /// cut faces.
    ContactSummaries
    summary(const ContactInstant &instant) override;

    const Couplings *
    couplings() override
    {
      return &constant_couplings;
    }

  private:
    void
    find_couplings(const ContactPoints &points);

    void
    find_free_multipliers(const ContactPoints    &points,
                          const dealii::IndexSet &owned_multipliers,
                          const MPI_Comm          communicator);

    void
    add_free_multipliers(Matrix &tangent) const;

    const std::map<dealii::types::boundary_id, double> slave_area;
    Couplings                                          constant_couplings;
    // Multipliers of this rank on which no cut face depends.
    std::vector<dealii::types::global_dof_index> free_multipliers;
  };
} // namespace Ricochet

#endif
