// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <output/part_columns.h>
#include <solvers/body_matrix.h>

#include <algorithm>
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
  PartColumns<dim>::PartColumns(const Body<dim>                &body,
                                const BulkOperator             &bulk,
                                const BodyMatrix               &mass,
                                const bool                      small_strains,
                                const std::vector<std::string> &names,
                                std::vector<unsigned int>       given_parts)
    : bulk(bulk)
    , mass(mass)
    , communicator(body.communicator)
    , names(names)
    , first_part(given_parts.empty() ? counting(names.size() + 1)
                                     : std::move(given_parts))
    , part_of_unknown(bodies_of_unknowns(body, first_part))
    , momenta_of_all(body, mass, small_strains)
    , momentum(body.make_vector())
  {
    for (unsigned int p = 0; p < names.size(); ++p)
      momenta_of_parts.emplace_back(body,
                                    mass,
                                    small_strains,
                                    first_part.back(),
                                    first_part[p],
                                    first_part[p + 1]);
  }



  template <int dim>
  const std::vector<double> &
  PartColumns<dim>::kinetic_energies(const Vector &velocity) const
  {
    const unsigned int  n      = velocity.locally_owned_size();
    const double *const values = velocity.trilinos_vector()[0];
    // To the last digit, so that it makes no difference to know them.
    const bool is_known = !known_energies.empty() &&
      std::equal(values, values + n, known_velocity.trilinos_vector()[0]);
    if (Utilities::MPI::min(is_known ? 1 : 0, communicator) == 1)
      return known_energies;
    // Masses do not couple bodies.
    mass.vmult(momentum, velocity);
    std::vector<double> my_energies(names.size(), 0.);
    for (unsigned int i = 0; i < part_of_unknown.size(); ++i)
      if (part_of_unknown[i] < names.size())
        my_energies[part_of_unknown[i]] +=
          .5 * momentum.trilinos_vector()[0][i] * values[i];
    known_energies.resize(names.size());
    Utilities::MPI::sum(my_energies, communicator, known_energies);
    copy_values(velocity, known_velocity);
    return known_energies;
  }



  template <int dim>
  double
  PartColumns<dim>::kinetic_energy(const unsigned int p,
                                   const Vector      &velocity) const
  {
    return kinetic_energies(velocity)[p];
  }



  template <int dim>
  double
  PartColumns<dim>::work(const unsigned int p,
                         const Vector      &force,
                         const Vector      &begin,
                         const Vector      &end) const
  {
    const double *f   = force.trilinos_vector()[0];
    const double *a   = begin.trilinos_vector()[0];
    const double *b   = end.trilinos_vector()[0];
    double        sum = 0.;
    for (unsigned int i = 0; i < part_of_unknown.size(); ++i)
      if (part_of_unknown[i] == p)
        sum += f[i] * (b[i] - a[i]);
    return Utilities::MPI::sum(sum, communicator);
  }



  template <int dim>
  void
  PartColumns<dim>::add_to(TimeLoop &loop) const
  {
    const auto add_momenta = [&](const std::string  &suffix,
                                 const Momenta<dim> &momenta_of) {
      for (unsigned int c = 0; c < dim; ++c)
        loop.add_column(std::string("momentum_") + "xyz"[c] + suffix,
                        "kg m/s",
                        [&momenta_of, c](const State &state) {
                          return momenta_of.linear(state.velocity)[c];
                        });
      for (unsigned int c = dim == 2 ? 2 : 0; c < 3; ++c)
        loop.add_column("angular_momentum" +
                          (dim == 2 ? "" : std::string("_") + "xyz"[c]) +
                          suffix,
                        "kg m^2/s",
                        [&momenta_of, c](const State &state) {
                          return momenta_of.angular(state.solution,
                                                    state.velocity)[c];
                        });
    };
    // One part is all.
    for (unsigned int p = 0; p < names.size() && names.size() > 1; ++p)
      {
        loop.add_column("kinetic_energy_" + names[p],
                        "J",
                        [this, p](const State &state) {
                          return kinetic_energy(p, state.velocity);
                        });
        loop.add_column("elastic_energy_" + names[p],
                        "J",
                        [this, p](const State &state) {
                          const std::vector<double> energies =
                            bulk.energies_of_parts(state.solution);
                          return std::accumulate(energies.begin() +
                                                   first_part[p],
                                                 energies.begin() +
                                                   first_part[p + 1],
                                                 0.);
                        });
        // The force of a state is that over the step that leads to it.
        loop.add_sum("contact_work_" + names[p],
                     "J",
                     [this, p](const State &begin, const State &end) {
                       return work(p,
                                   end.contact_force,
                                   begin.solution,
                                   end.solution);
                     });
        add_momenta("_" + names[p], momenta_of_parts[p]);
      }
    add_momenta("", momenta_of_all);
  }


  template class PartColumns<2>;
  template class PartColumns<3>;
} // namespace Ricochet
