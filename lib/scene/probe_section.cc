// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <output/momenta.h>
#include <output/node_probe.h>
#include <output/stress_probe.h>
#include <scene/probe_section.h>

#include <memory>

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
      "What to write: displacement or velocity, or the elastic Cauchy stress.",
      Patterns::Selection("displacement|velocity|stress"));
    parameters.add_parameter("Body",
                             body,
                             "Of which body.",
                             Patterns::Anything());
    parameters.add_parameter(
      "Point",
      point,
      "Where, at the start (m): displacement and velocity in the nearest vertex, "
      "stress in the point. Empty: the mean over the body, of displacement and "
      "velocity by mass, of stress by volume.",
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
    if (body.find_first_of(":;") != std::string::npos)
      throw InputError(name_of("Body") + ": '" + body.substr(0, 100) +
                       "' is not the name of one body.");
    return surfaces.find(body, name_of("Body")).front().body;
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
        std::vector<Material<dim>> materials;
        for (const Part<dim> &part : impact.parts)
          materials.push_back(part.material);
        const auto probe =
          std::make_shared<const StressProbe<dim>>(impact.body,
                                                   materials,
                                                   begin,
                                                   end,
                                                   point.empty() ? nullptr
                                                                 : &place);
        if (!probe->is_in_body())
          throw InputError(name_of("Point") + " is not within the body '" +
                           body + "'.");
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

    const std::string unit      = quantity == "velocity" ? "m/s" : "m";
    const auto        vector_of = [of_velocity = quantity == "velocity"](
                             const State &state) -> const Vector        &{
      return of_velocity ? state.velocity : state.solution;
    };
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
                      [value, vector_of, c](const State &state) {
                        return value(vector_of(state), c);
                      });
  }


  template struct ProbeSection<2>;
  template struct ProbeSection<3>;
} // namespace Ricochet
