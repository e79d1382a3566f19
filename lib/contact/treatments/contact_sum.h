// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_contact_sum_h
#define ricochet_contact_treatments_contact_sum_h

#include <contact/treatments/pair_contact.h>

namespace Ricochet
{
  /**
   * Contact with rigid obstacles and contact of surfaces with each other, or with
   * themselves, in one computation.
   *
   * Active sets against obstacles take rows out of the equations of motion, whatever
   * stands in them; so the forces between surfaces come first.
   *
   * A boundary may take part in both. Summaries of contact between surfaces are under
   * id_between_surfaces() of their boundary ids.
   */
  template <int dim>
  class ContactSum : public ContactOperator
  {
  public:
    ContactSum(std::unique_ptr<ContactOperator>  obstacles,
               std::unique_ptr<PairContact<dim>> pairs,
               const MPI_Comm                    communicator);

    static dealii::types::boundary_id
    id_between_surfaces(const dealii::types::boundary_id boundary_id)
    {
      return (1U << 24) + boundary_id;
    }

    void
    begin_stage(const ContactStart &start, const double weight) override;

    void
    complete_residual(const Vector &solution, Vector &residual) override;

    void
    accept_iterate() override;

    bool
    next_pass() override;

    const Vector &
    contact_force() const override
    {
      return force;
    }

    const Vector *
    force_between_surfaces() const override
    {
      return &between_surfaces;
    }

    const Vector *
    friction_force() const override
    {
      return has_friction ? &friction : nullptr;
    }

    double
    friction_dissipation() const override;

    double
    linearisation_error() const override;

    double
    round_off() const override;

    const Vector &
    row_scaling() const override;

    std::string
    active_set_description() const override;

    void
    complete_tangent(Matrix &tangent) const override;

    void
    complete_open_tangent(Matrix &tangent) const override;

    ContactStructure
    tangent_structure() const override;

    const Couplings *
    couplings() override;

    std::optional<std::uint64_t>
    tangent_signature() const override;

    std::uint64_t
    active_set_signature() const override;

    void
    force_at(const Vector &solution, const double time, Vector &force) override;

    double
    potential(const Vector &solution, const double time) override;

    bool
    has_modified_energy() const override;

    bool
    has_moving_obstacles() const override;

    bool
    gaps_may_be_unknown() const override
    {
      return true;
    }

    bool
    knows_stress_pressure() const override
    {
      return false;
    }

    Vector
    pressure_field(const ContactInstant &instant) override;

    ContactSummaries
    summary(const ContactInstant &instant) override;

  private:
    const std::unique_ptr<ContactOperator>  obstacles;
    const std::unique_ptr<PairContact<dim>> pairs;
    const MPI_Comm                          communicator;
    const bool                              has_friction;
    Vector                                  force, between_surfaces, friction;
    /// What obstacles did to the bodies in the step before (N).
    Vector old_force_of_obstacles;
  };
} // namespace Ricochet

#endif
