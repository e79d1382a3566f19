// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_contact_sum_h
#define ricochet_contact_treatments_contact_sum_h

#include <base/exceptions.h>
#include <contact/contact_operator.h>
#include <solvers/functional_products.h>

#include <memory>
#include <vector>

namespace Ricochet
{
  /**
   * Several contacts in one computation, each with a treatment of its own: with rigid
   * obstacles, of surfaces with each other, or of surfaces with themselves.
   *
   * Active sets against obstacles eliminate rows of the equations of motion, with
   * all forces in them; so the other contacts come first.
   *
   * A boundary may take part in several of them. Those that eliminate rows of the same node
   * know of each other, see ContactOperator::share_nodes(). Summaries are under id_of() of a contact
   * and its boundary ids. The state keeps the force of each (State::contact_shares),
   * from which a contact finds the points that were pressed in the step before.
   */
  class ContactSum : public ContactOperator
  {
  public:
    /// Bits for the boundary in a key of summaries; the others are for the contact.
    static constexpr unsigned int boundary_bits = 20;

    explicit ContactSum(std::vector<std::unique_ptr<ContactOperator>> contacts);

    /// The key in summaries of the boundary @p boundary_id in contact number @p
    /// contact. @throws InputError if there are too many of them.
    static dealii::types::boundary_id
    id_of(const unsigned int               contact,
          const dealii::types::boundary_id boundary_id)
    {
      constexpr unsigned int most_contacts   = (1U << (32 - boundary_bits)) - 1,
                             most_boundaries = 1U << boundary_bits;
      if (contact >= most_contacts || boundary_id >= most_boundaries)
        throw InputError("A run may have " + std::to_string(most_contacts) +
                         " contacts, one for each body and obstacle, and " +
                         std::to_string(most_boundaries) + " boundaries.");
      return (contact << boundary_bits) + boundary_id;
    }

    void
    begin_stage(const ContactStart &start, const double weight) override;

    void
    add_residual(const Vector &solution, Vector &residual) override;

    void
    accept_iterate() override;

    void
    forget_iterates() override;

    bool
    next_pass() override;

    std::vector<const Vector *>
    shares() const override;

    double
    friction_dissipation() const override;

    ContactSteps
    end_step(const Vector &begin,
             const Vector &end,
             const double  begin_time,
             const double  end_time) override;

    const EnergyPromise &
    promise_at(const dealii::types::boundary_id boundary_id) const override
    {
      return contacts[boundary_id >> boundary_bits]->promise_at(
        boundary_id & ((1U << boundary_bits) - 1));
    }

    double
    linearisation_error() const override;

    double
    round_off() const override;

    std::string
    active_set_description() const override;

    void
    add_tangent(Matrix &tangent) const override;

    void
    add_open_tangent(Matrix &tangent) const override;

    void
    differentiate_forces(
      std::vector<FunctionalRow> &with_values,
      std::vector<FunctionalRow> &with_residual) const override;

    void
    evaluate_at_increment(const std::vector<double> &change,
                          const std::vector<double> &excess) override;

    void
    forces_on_rows(std::vector<double> &coefficients) const override;

    const Couplings *
    couplings() override;

    ActiveSet
    active_set() const override;

    void
    force_at(const Vector &solution, const double time, Vector &force) override;

    double
    potential(const Vector &solution, const double time) override;

    Vector
    pressure_field(const ContactInstant &instant) override;

    ContactSummaries
    summary(const ContactInstant &instant) override;

  private:
    /// Whether rows that a contact eliminates have no other contact.
    static bool
    keeps_rows_apart(const std::vector<ContactStructure> &structures,
                     const MPI_Comm                       communicator);

    /// The structure and the properties of all contacts. The rows of the contact
    /// Jacobian (functionals) are those of all, one contact after the other; there are
    /// none if one of them has none, if two eliminate rows of the same node, or, on several
    /// ranks, if one eliminates rows in which another acts.
    void
    set_structure();

    /// The force of contact @p k at an instant.
    static const Vector &
    share(const ContactInstant &instant, const unsigned int k)
    {
      return (*instant.shares)[k];
    }

    const std::vector<std::unique_ptr<ContactOperator>> contacts;
    // The same contacts; those that eliminate rows are last.
    std::vector<ContactOperator *> in_order;
    // Indices of the first row of the contact Jacobian of each of these on this
    // rank, and of the end of the last one; empty without such rows.
    std::vector<unsigned int> first_functional;
    // Products of rows, for contacts that eliminate rows in which others act.
    mutable std::optional<FunctionalProducts> products;
    // The forces of the contacts after force_at(); otherwise contacts have
    // them.
    std::vector<Vector> instant_forces;
    bool                at_instant = false;
    Couplings           all_couplings;
  };
} // namespace Ricochet

#endif
