// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <output/part_columns.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// 0, 1, ... before @p n.
    std::vector<unsigned int>
    counting(const unsigned int n)
    {
      std::vector<unsigned int> list(n);
      std::iota(list.begin(), list.end(), 0U);
      return list;
    }

    /// The body of each owned unknown.
    template <int dim>
    std::vector<unsigned int>
    bodies_of_unknowns(const Body<dim>                 &body,
                       const std::vector<unsigned int> &first_part)
    {
      std::vector<unsigned int> list =
        body.parts_of_unknowns(first_part.back());
      for (unsigned int &entry : list)
        entry = std::upper_bound(first_part.begin(), first_part.end(), entry) -
          first_part.begin() - 1;
      return list;
    }
  } // namespace



  template <int dim>
  std::vector<typename PartColumns<dim>::Run>
  PartColumns<dim>::runs_of(const std::vector<unsigned int> &body_of_unknown)
  {
    std::vector<Run> runs;
    for (unsigned int i = 0; i < body_of_unknown.size(); ++i)
      if (!runs.empty() && runs.back().body == body_of_unknown[i])
        runs.back().end = i + 1;
      else
        runs.push_back({body_of_unknown[i], i, i + 1});
    return runs;
  }



  template <int dim>
  PartColumns<dim>::PartColumns(const Body<dim>                &body,
                                SemiDiscreteSystem             &system,
                                const bool                      small_strains,
                                const std::vector<std::string> &names,
                                std::vector<unsigned int>       given_parts)
    : system(system)
    , communicator(body.communicator)
    , names(names)
    , first_part(given_parts.empty() ? counting(names.size() + 1)
                                     : std::move(given_parts))
    , runs(runs_of(bodies_of_unknowns(body, first_part)))
    , momenta_of_all(body, system.mass_matrix(), small_strains)
    , momentum(body.make_vector())
  {
    for (unsigned int p = 0; p < names.size(); ++p)
      momenta_of_parts.emplace_back(body,
                                    system.mass_matrix(),
                                    small_strains,
                                    first_part.back(),
                                    first_part[p],
                                    first_part[p + 1]);
  }



  template <int dim>
  typename PartColumns<dim>::Energies
  PartColumns<dim>::energies(const State &state) const
  {
    Energies result;
    // Masses do not couple bodies.
    system.mass_matrix().vmult(momentum, state.velocity);
    const auto momenta    = entries(momentum);
    const auto velocities = entries(state.velocity);
    result.kinetic.resize(names.size(), 0.);
    for (const Run &run : runs)
      result.kinetic[run.body] +=
        momenta.segment(run.begin, run.size())
          .dot(velocities.segment(run.begin, run.size()));
    Utilities::MPI::sum(result.kinetic, communicator, result.kinetic);
    for (double &energy : result.kinetic)
      energy *= .5;

    const std::vector<double> of_parts =
      system.bulk.energies_of_parts(state.solution);
    for (unsigned int p = 0; p < names.size(); ++p)
      result.elastic.push_back(
        std::accumulate(of_parts.begin() + first_part[p],
                        of_parts.begin() + first_part[p + 1],
                        0.));
    return result;
  }



  template <int dim>
  std::vector<double>
  PartColumns<dim>::works(const Vector &force,
                          const Vector &begin,
                          const Vector &end) const
  {
    std::vector<double> sums(names.size(), 0.);
    for (const Run &run : runs)
      sums[run.body] += entries(force)
                          .segment(run.begin, run.size())
                          .dot(entries(end).segment(run.begin, run.size()) -
                               entries(begin).segment(run.begin, run.size()));
    Utilities::MPI::sum(sums, communicator, sums);
    return sums;
  }



  template <int dim>
  void
  PartColumns<dim>::add_to(TimeLoop &loop) const
  {
    const auto add_momenta = [&](const std::string  &suffix,
                                 const Momenta<dim> &momenta_of) {
      std::vector<std::string> linear, angular;
      for (unsigned int c = 0; c < dim; ++c)
        linear.push_back(std::string("momentum_") + "xyz"[c] + suffix);
      for (unsigned int c = dim == 2 ? 2 : 0; c < 3; ++c)
        angular.push_back("angular_momentum" +
                          (dim == 2 ? "" : std::string("_") + "xyz"[c]) +
                          suffix);
      loop.add_columns(linear, "kg m/s", [&momenta_of](const State &state) {
        const Tensor<1, dim> sum = momenta_of.linear(state.velocity);
        return std::vector<double>(sum.begin_raw(), sum.end_raw());
      });
      loop.add_columns(angular, "kg m^2/s", [&momenta_of](const State &state) {
        const Tensor<1, 3> sum =
          momenta_of.angular(state.solution, state.velocity);
        return std::vector<double>(sum.begin_raw() + (dim == 2 ? 2 : 0),
                                   sum.end_raw());
      });
    };
    if (names.size() > 1)
      system.works_of_bodies =
        [this](const Vector &force, const Vector &begin, const Vector &end) {
          return works(force, begin, end);
        };
    // The first column of a row makes the energies of all bodies, for those after it.
    const auto of_row = std::make_shared<Energies>();
    // One part is all.
    for (unsigned int p = 0; p < names.size() && names.size() > 1; ++p)
      {
        loop.add_column("kinetic_energy_" + names[p],
                        "J",
                        [this, of_row, p](const State &state) {
                          if (p == 0)
                            *of_row = energies(state);
                          return of_row->kinetic[p];
                        });
        loop.add_column("elastic_energy_" + names[p],
                        "J",
                        [of_row, p](const State &) {
                          return of_row->elastic[p];
                        });
        loop.add_reported_sum("contact_work_" + names[p],
                              "J",
                              [p](const StepReport &report) {
                                return report.works_of_bodies.empty()
                                  ? std::numeric_limits<double>::quiet_NaN()
                                  : report.works_of_bodies[p];
                              });
        add_momenta("_" + names[p], momenta_of_parts[p]);
      }
    add_momenta("", momenta_of_all);
  }


  template class PartColumns<2>;
  template class PartColumns<3>;
} // namespace Ricochet
