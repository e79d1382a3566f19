// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/treatments/active_set_signature.h>
#include <contact/treatments/contact_sum.h>

#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    Vector
    difference(const Vector &a, const Vector &b)
    {
      Vector result(a);
      result -= b;
      return result;
    }
  } // namespace



  template <int dim>
  ContactSum<dim>::ContactSum(std::unique_ptr<ContactOperator> obstacle_contact,
                              std::unique_ptr<PairContact<dim>> pair_contact,
                              const MPI_Comm                    communicator)
    : obstacles(std::move(obstacle_contact))
    , pairs(std::move(pair_contact))
    , communicator(communicator)
    , has_friction(obstacles->friction_force() || pairs->friction_force())
    , force(pairs->contact_force())
    , between_surfaces(pairs->contact_force())
    , friction(pairs->contact_force())
    , old_force_of_obstacles(pairs->contact_force())
  {}



  template <int dim>
  void
  ContactSum<dim>::begin_stage(const ContactStart &start, const double weight)
  {
    // Obstacles tell by the force in a node whether it was pressed.
    old_force_of_obstacles = start.contact_force;
    old_force_of_obstacles -= *start.force_between_surfaces;
    pairs->begin_stage({start.solution,
                        *start.force_between_surfaces,
                        start.mean_velocity,
                        start.time_step,
                        start.end_time},
                       weight);
    obstacles->begin_stage({start.solution,
                            old_force_of_obstacles,
                            start.mean_velocity,
                            start.time_step,
                            start.end_time},
                           weight);
  }



  template <int dim>
  void
  ContactSum<dim>::complete_residual(const Vector &solution, Vector &residual)
  {
    pairs->complete_residual(solution, residual);
    obstacles->complete_residual(solution, residual);
    between_surfaces = pairs->contact_force();
    force            = between_surfaces;
    force += obstacles->contact_force();
    if (!has_friction)
      return;
    friction = 0.;
    for (const Vector *part :
         {pairs->friction_force(), obstacles->friction_force()})
      if (part)
        friction += *part;
  }



  template <int dim>
  void
  ContactSum<dim>::accept_iterate()
  {
    pairs->accept_iterate();
    obstacles->accept_iterate();
  }



  template <int dim>
  bool
  ContactSum<dim>::next_pass()
  {
    // Both are of one treatment, and have as many passes.
    const bool of_pairs     = pairs->next_pass();
    const bool of_obstacles = obstacles->next_pass();
    return of_pairs || of_obstacles;
  }



  template <int dim>
  double
  ContactSum<dim>::friction_dissipation() const
  {
    return pairs->friction_dissipation() + obstacles->friction_dissipation();
  }



  template <int dim>
  double
  ContactSum<dim>::linearisation_error() const
  {
    return std::hypot(pairs->linearisation_error(),
                      obstacles->linearisation_error());
  }



  template <int dim>
  double
  ContactSum<dim>::round_off() const
  {
    return std::hypot(pairs->round_off(), obstacles->round_off());
  }



  template <int dim>
  const Vector &
  ContactSum<dim>::row_scaling() const
  {
    // Multipliers are those between surfaces.
    return pairs->row_scaling();
  }



  template <int dim>
  std::string
  ContactSum<dim>::active_set_description() const
  {
    return obstacles->active_set_description() + " and " +
      pairs->active_set_description();
  }



  template <int dim>
  void
  ContactSum<dim>::complete_tangent(Matrix &tangent) const
  {
    pairs->complete_tangent(tangent);
    obstacles->complete_tangent(tangent);
  }



  template <int dim>
  void
  ContactSum<dim>::complete_open_tangent(Matrix &tangent) const
  {
    pairs->complete_open_tangent(tangent);
  }



  template <int dim>
  ContactStructure
  ContactSum<dim>::tangent_structure() const
  {
    return pairs->tangent_structure();
  }



  template <int dim>
  const Couplings *
  ContactSum<dim>::couplings()
  {
    return pairs->couplings();
  }



  namespace
  {
    std::uint64_t
    hash_of_both(const std::uint64_t a, const std::uint64_t b)
    {
      return a * 0x9e3779b97f4a7c15ULL + b;
    }
  } // namespace



  template <int dim>
  std::optional<std::uint64_t>
  ContactSum<dim>::tangent_signature() const
  {
    const auto of_pairs     = pairs->tangent_signature();
    const auto of_obstacles = obstacles->tangent_signature();
    if (!of_pairs || !of_obstacles)
      return {};
    return hash_of_both(*of_pairs, *of_obstacles);
  }



  template <int dim>
  std::uint64_t
  ContactSum<dim>::active_set_signature() const
  {
    return hash_of_both(pairs->active_set_signature(),
                        obstacles->active_set_signature());
  }



  template <int dim>
  void
  ContactSum<dim>::force_at(const Vector &solution,
                            const double  time,
                            Vector       &result)
  {
    pairs->force_at(solution, time, between_surfaces);
    obstacles->force_at(solution, time, result);
    result += between_surfaces;
  }



  template <int dim>
  double
  ContactSum<dim>::potential(const Vector &solution, const double time)
  {
    return pairs->potential(solution, time) +
      obstacles->potential(solution, time);
  }



  template <int dim>
  bool
  ContactSum<dim>::has_modified_energy() const
  {
    return obstacles->has_modified_energy() && pairs->has_modified_energy();
  }



  template <int dim>
  bool
  ContactSum<dim>::has_moving_obstacles() const
  {
    return obstacles->has_moving_obstacles();
  }



  template <int dim>
  Vector
  ContactSum<dim>::pressure_field(const ContactInstant &instant)
  {
    const Vector of_obstacles =
      difference(instant.contact_force, *instant.force_between_surfaces);
    Vector sum =
      obstacles->pressure_field({instant.solution, of_obstacles, instant.time});
    sum += pairs->pressure_field(
      {instant.solution, *instant.force_between_surfaces, instant.time});
    return sum;
  }



  template <int dim>
  ContactSummaries
  ContactSum<dim>::summary(const ContactInstant &instant)
  {
    const Vector of_obstacles =
      difference(instant.contact_force, *instant.force_between_surfaces);
    ContactSummaries all =
      obstacles->summary({instant.solution, of_obstacles, instant.time});
    for (const auto &[id, summary] : pairs->summary(
           {instant.solution, *instant.force_between_surfaces, instant.time}))
      all[id_between_surfaces(id)] = summary;
    return all;
  }


  template class ContactSum<1>;
  template class ContactSum<2>;
  template class ContactSum<3>;
} // namespace Ricochet
