// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <output/mean_rotation.h>
#include <output/momenta.h>
#include <output/node_probe.h>
#include <scene/probe_section.h>

#include <limits>
#include <map>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  void
  ProbeSection<dim>::add_parameters(ParameterHandler &parameters)
  {
    parameters.enter_subsection(section.full_name());
    parameters.add_parameter(
      "Quantity",
      quantity,
      "What to write: displacement, velocity or acceleration (with the midpoint "
      "scheme its mean over the last step); the elastic Cauchy stress; the "
      "rotation of the whole body (rad, from -pi to pi; in 3D a vector along its "
      "axis); the force of what holds or moves a boundary, with the midpoint scheme "
      "(mean over the last step) or static; or, with the midpoint scheme, its impulse "
      "(force times time, since the start).",
      Patterns::Selection(
        "displacement|velocity|acceleration|stress|rotation|force|impulse"));
    parameters.add_parameter("Body",
                             body,
                             "Of which body; for force and impulse of which "
                             "boundaries, 'beam: foot'.",
                             Patterns::Anything());
    parameters.add_parameter(
      "Point",
      point,
      "Where, at the start (m): displacement, velocity and acceleration in the nearest "
      "vertex, stress in the point. Empty: the mean over the body, of stress by volume, "
      "of the others by mass.",
      Patterns::List(Patterns::Double(), 0, dim));
    parameters.leave_subsection();
  }



  template <int dim>
  unsigned int
  ProbeSection<dim>::find_body(const SurfaceNames &surfaces) const
  {
    if (!point.empty() && point.size() != dim)
      throw InputError(name_of("Point") + " needs " + std::to_string(dim) +
                       " coordinates, separated by commas.");
    const bool of_boundary = quantity == "force" || quantity == "impulse";
    if ((of_boundary || quantity == "rotation") && !point.empty())
      throw InputError(name_of("Point") + " has no meaning for the " +
                       quantity + ", which is that of a whole " +
                       (of_boundary ? "boundary." : "body."));
    if (!of_boundary && body.find_first_of(":;") != std::string::npos)
      throw InputError(name_of("Body") + ": '" + body.substr(0, 100) +
                       "' is not the name of one body.");
    return surfaces.find(body, name_of("Body")).front().body;
  }



  template <int dim>
  std::array<IndexSet, dim>
  ProbeSection<dim>::held_unknowns(const Impact<dim>  &impact,
                                   const SurfaceNames &surfaces) const
  {
    if (!impact.scheme->contact_force_is_of_step() &&
        (impact.has_inertia || quantity != "force"))
      throw InputError(name_of("Quantity") + ": the " + quantity +
                       " is known with the midpoint scheme" +
                       (quantity == "force" ? " or static only." : " only."));
    std::array<IndexSet, dim> held;
    types::global_dof_index   n = 0;
    for (unsigned int c = 0; c < dim; ++c)
      {
        held[c] = IndexSet(impact.body.owned_indices().size());
        for (const auto &surface : surfaces.find(body, name_of("Body")))
          for (const auto id : surface.ids)
            held[c].add_indices(
              constrained_indices(impact.body.constraints(),
                                  impact.body.boundary_displacements(id, c)));
        n += held[c].n_elements();
      }
    if (Utilities::MPI::sum(n, impact.body.communicator) == 0)
      throw InputError(name_of("Body") + ": no condition holds or moves '" +
                       body.substr(0, 100) + "'.");
    return held;
  }



  template <int dim>
  void
  ProbeSection<dim>::add_reaction_to(TimeLoop           &loop,
                                     const Impact<dim>  &impact,
                                     const SurfaceNames &surfaces) const
  {
    const std::array<IndexSet, dim> held = held_unknowns(impact, surfaces);
    for (unsigned int c = 0; c < dim; ++c)
      {
        const std::string name =
          section.column_name() + "_" + quantity + "_" + "xyz"[c];
        if (!impact.has_inertia)
          {
            loop.add_column(
              name,
              "N",
              [&impact, held = held[c], forces = Vector()](
                const State &state) mutable {
                impact.system.static_reactions(state, forces);
                double sum = 0.;
                for (const auto i : held)
                  sum += forces(i);
                return Utilities::MPI::sum(sum, impact.body.communicator);
              });
            continue;
          }
        const auto impulse_of_step =
          [&impact, held = held[c]](const State &begin, const State &end) {
            const Vector &forces = impact.system.reaction_forces();
            double        sum    = 0.;
            for (const auto i : held)
              sum += forces(i);
            return Utilities::MPI::sum(sum, impact.body.communicator) *
              (end.time - begin.time);
          };
        if (quantity == "force")
          loop.add_mean(name, "N", impulse_of_step);
        else
          loop.add_sum(name, "N s", impulse_of_step);
      }
  }



  template <int dim>
  void
  ProbeSection<dim>::add_rotation_to(TimeLoop          &loop,
                                     const Impact<dim> &impact,
                                     const unsigned int begin,
                                     const unsigned int end) const
  {
    const auto rotation =
      std::make_shared<const MeanRotation<dim>>(impact.body,
                                                impact.consistent_mass,
                                                impact.parts.size(),
                                                begin,
                                                end);
    const std::string name = section.column_name() + "_rotation";
    if (dim == 2)
      loop.add_column(name, "rad", [rotation](const State &state) {
        return rotation->vector(state.solution)[2];
      });
    else
      for (unsigned int c = 0; c < 3; ++c)
        loop.add_column(name + "_" + "xyz"[c],
                        "rad",
                        [rotation, c](const State &state) {
                          return rotation->vector(state.solution)[c];
                        });
  }



  template <int dim>
  std::shared_ptr<const StressProbe<dim>>
  ProbeSection<dim>::stress_probe(
    const Impact<dim>               &impact,
    const SurfaceNames              &surfaces,
    const std::vector<unsigned int> &first_part) const
  {
    const unsigned int         b = find_body(surfaces);
    std::vector<Material<dim>> materials;
    for (const Part<dim> &part : impact.parts)
      materials.push_back(part.material);
    Point<dim> place;
    for (unsigned int c = 0; c < point.size(); ++c)
      place[c] = point[c];
    auto probe =
      std::make_shared<const StressProbe<dim>>(impact.body,
                                               materials,
                                               first_part[b],
                                               first_part[b + 1],
                                               point.empty() ? nullptr
                                                             : &place);
    if (!probe->is_in_body())
      throw InputError(name_of("Point") + " is not within the body '" + body +
                       "'.");
    return probe;
  }



  template <int dim>
  void
  ProbeSection<dim>::check(const Impact<dim>               &impact,
                           const SurfaceNames              &surfaces,
                           const std::vector<unsigned int> &first_part) const
  {
    if (quantity == "stress")
      stress_probe(impact, surfaces, first_part);
    if (quantity == "force" || quantity == "impulse")
      held_unknowns(impact, surfaces);
  }



  template <int dim>
  void
  ProbeSection<dim>::add_to(TimeLoop                        &loop,
                            const Impact<dim>               &impact,
                            const SurfaceNames              &surfaces,
                            const std::vector<unsigned int> &first_part) const
  {
    const unsigned int b     = find_body(surfaces);
    const unsigned int begin = first_part[b], end = first_part[b + 1],
                       n_parts = impact.parts.size();
    Point<dim> place;
    for (unsigned int c = 0; c < point.size(); ++c)
      place[c] = point[c];
    const std::string name = section.column_name() + "_";

    if (quantity == "stress")
      {
        const auto probe = stress_probe(impact, surfaces, first_part);
        // The stress is evaluated once for all its components.
        const auto known =
          std::make_shared<std::pair<double, SymmetricTensor<2, dim>>>(
            std::numeric_limits<double>::quiet_NaN(),
            SymmetricTensor<2, dim>());
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = i; j < dim; ++j)
            loop.add_column(
              name + "stress_" + "xyz"[i] + "xyz"[j],
              "Pa",
              [probe, known, i, j](const State &state) {
                if (known->first != state.time)
                  *known = {state.time, probe->stress(state.solution)};
                return known->second[i][j];
              });
        return;
      }

    if (quantity == "force" || quantity == "impulse")
      return add_reaction_to(loop, impact, surfaces);
    if (quantity == "rotation")
      return add_rotation_to(loop, impact, begin, end);

    // The vector of a state that is observed, and its unit.
    static const std::map<std::string, std::pair<Vector State::*, std::string>>
      quantities                  = {{"displacement", {&State::solution, "m"}},
                                     {"velocity", {&State::velocity, "m/s"}},
                                     {"acceleration", {&State::acceleration, "m/s^2"}}};
    const auto &[vector_of, unit] = quantities.at(quantity);
    std::function<double(const Vector &, const unsigned int)> value;
    if (!point.empty())
      {
        const auto probe = std::make_shared<const NodeProbe<dim>>(impact.body,
                                                                  place,
                                                                  n_parts,
                                                                  begin,
                                                                  end);
        value            = [probe](const Vector &vector, const unsigned int c) {
          return probe->value(vector, c);
        };
      }
    else
      {
        const auto momenta =
          std::make_shared<const Momenta<dim>>(impact.body,
                                               impact.consistent_mass,
                                               /* small strains */ true,
                                               n_parts,
                                               begin,
                                               end);
        Tensor<1, dim> along;
        along[0]          = 1.;
        const double mass = momenta->linear(impact.uniform(along))[0];
        value = [momenta, mass](const Vector &vector, const unsigned int c) {
          return momenta->linear(vector)[c] / mass;
        };
      }
    for (unsigned int c = 0; c < dim; ++c)
      loop.add_column(name + quantity + "_" + "xyz"[c],
                      unit,
                      [value, vector = vector_of, c](const State &state) {
                        return value(state.*vector, c);
                      });
  }


  template struct ProbeSection<2>;
  template struct ProbeSection<3>;
} // namespace Ricochet
