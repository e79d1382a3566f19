// SPDX-License-Identifier: LGPL-2.1-or-later
#include <problems/unheld_bodies.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// For each part the smallest number of those with which it is one body.
    template <int dim>
    std::vector<unsigned int>
    connected_parts(const Body<dim> &body, const unsigned int n_parts)
    {
      // Parts that share a node, on any rank.
      std::vector<unsigned int> share(n_parts * n_parts, 0);
      std::map<types::global_dof_index, unsigned int> part_of;
      std::vector<types::global_dof_index>            indices(
        body.dof_handler().get_fe().n_dofs_per_cell());
      for (const auto &cell : body.dof_handler().active_cell_iterators())
        if (!cell->is_artificial())
          {
            const unsigned int part =
              n_parts == 1 ? 0 : body.part(cell, n_parts);
            cell->get_dof_indices(indices);
            for (const auto i : indices)
              {
                const unsigned int other =
                  part_of.emplace(i, part).first->second;
                share[part * n_parts + other] = share[other * n_parts + part] =
                  1;
              }
          }
      Utilities::MPI::max(share, body.communicator, share);
      std::vector<unsigned int> first(n_parts);
      for (unsigned int p = 0; p < n_parts; ++p)
        first[p] = p;
      for (bool changed = true; changed;)
        {
          changed = false;
          for (unsigned int p = 0; p < n_parts; ++p)
            for (unsigned int q = 0; q < n_parts; ++q)
              if (share[p * n_parts + q] && first[q] < first[p])
                {
                  first[p] = first[q];
                  changed  = true;
                }
        }
      return first;
    }
  } // namespace



  template <int dim>
  SemiDiscreteSystem::Unknowns::Unheld
  find_unheld_bodies(const Body<dim> &body, const ImpactSetup<dim> &setup)
  {
    const unsigned int n_parts = std::max<std::size_t>(1, setup.parts.size());
    const std::vector<unsigned int> first   = connected_parts(body, n_parts);
    const std::vector<unsigned int> part_of = body.parts_of_unknowns(n_parts);
    const IndexSet                 &owned   = body.owned_indices();

    std::vector<unsigned int> is_held(dim * n_parts, 0);
    const auto hold = [&](const types::boundary_id id, const unsigned int c) {
      for (const auto unknown : body.boundary_displacements(id, c))
        if (owned.is_element(unknown))
          is_held[dim * first[part_of[owned.index_within_set(unknown)]] + c] =
            1;
    };
    for (unsigned int c = 0; c < dim; ++c)
      {
        for (const auto id : setup.clamped)
          hold(id, c);
        for (const auto &[id, imposed] : setup.imposed)
          if (imposed.components[c])
            hold(id, c);
        for (const BoundarySprings<dim> &springs : setup.springs)
          if (springs.components[c] && springs.stiffness > 0.)
            hold(springs.boundary_id, c);
      }
    Utilities::MPI::max(is_held, body.communicator, is_held);

    SemiDiscreteSystem::Unknowns::Unheld result;
    for (unsigned int p = 0; p < n_parts; ++p)
      if (first[p] == p &&
          std::count(&is_held[dim * p], &is_held[dim * p] + dim, 1U) < dim)
        result.bodies.push_back(setup.parts.empty() ? "the body"
                                                    : setup.parts[p].name);
    double smallest = std::numeric_limits<double>::max();
    for (const auto &cell : body.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        smallest = std::min(smallest, cell->minimum_vertex_distance());
    result.cell_size = Utilities::MPI::min(smallest, body.communicator);
    return result;
  }


  template SemiDiscreteSystem::Unknowns::Unheld
  find_unheld_bodies(const Body<1> &, const ImpactSetup<1> &);
  template SemiDiscreteSystem::Unknowns::Unheld
  find_unheld_bodies(const Body<2> &, const ImpactSetup<2> &);
  template SemiDiscreteSystem::Unknowns::Unheld
  find_unheld_bodies(const Body<3> &, const ImpactSetup<3> &);
} // namespace Ricochet
