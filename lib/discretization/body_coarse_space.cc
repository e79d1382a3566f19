// SPDX-License-Identifier: LGPL-2.1-or-later
#include <discretization/body.h>
#include <discretization/boundary_dofs.h>
#include <discretization/ghost_flags.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/numerics/vector_tools.h>

#include <cmath>
#include <functional>
#include <map>

// Data of a body for multigrid: rigid body modes, and from degree 2 the space
// of degree 1 beneath it.

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// CoarseSpace::rigid_body_modes of the displacements @p dofs.
    template <int dim>
    std::vector<Vector>
    rigid_body_modes(const Mapping<dim>    &mapping,
                     const DoFHandler<dim> &dofs,
                     const MPI_Comm         communicator)
    {
      // A translation and a gradient of each rigid body mode.
      std::vector<std::pair<Tensor<1, dim>, Tensor<2, dim>>> modes;
      for (unsigned int c = 0; c < dim; ++c)
        {
          Tensor<1, dim> translation;
          translation[c] = 1.;
          modes.emplace_back(translation, Tensor<2, dim>());
        }
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = c + 1; d < dim; ++d)
          {
            Tensor<2, dim> rotation;
            rotation[c][d] = -1.;
            rotation[d][c] = 1.;
            modes.emplace_back(Tensor<1, dim>(), rotation);
          }
      std::vector<Vector> vectors;
      for (const auto &[translation, gradient] : modes)
        {
          std::vector<std::function<double(const Point<dim> &)>> components;
          for (unsigned int c = 0; c < dim; ++c)
            components.emplace_back([value = translation[c],
                                     slope = gradient[c]](const Point<dim> &x) {
              return value + slope * x;
            });
          vectors.emplace_back(dofs.locally_owned_dofs(), communicator);
          VectorTools::interpolate(mapping,
                                   dofs,
                                   FunctionFromFunctionObjects<dim>(components),
                                   vectors.back());
        }
      return vectors;
    }
  } // namespace

  template <int dim>
  CoarseSpace
  Body<dim>::coarse_space(const bool of_own_degree) const
  {
    CoarseSpace space;
    if (displacement_element->degree == 1 || of_own_degree)
      {
        space.rigid_body_modes =
          rigid_body_modes(*geometry, displacement_dofs, communicator);
        return space;
      }
    AssertThrow(!has_multipliers(),
                ExcMessage("There is no coarse space for multipliers."));

    // The multipliers' element is scalar, of degree 1 and on the same cells.
    const FESystem<dim> element(*multiplier_element, dim);
    DoFHandler<dim>     dofs(displacement_dofs.get_triangulation());
    dofs.distribute_dofs(element);
    const IndexSet &coarse_owned = dofs.locally_owned_dofs();
    IndexSet        coarse_relevant;
    DoFTools::extract_locally_relevant_dofs(dofs, coarse_relevant);
    space.clamped = boundary_dofs(dofs, clamped_ids) & coarse_owned;
    Vector is_coarse_clamped(coarse_owned, coarse_relevant, communicator);
    flag_with_ghosts(space.clamped, is_coarse_clamped);
    space.rigid_body_modes = rigid_body_modes(*geometry, dofs, communicator);

    DynamicSparsityPattern couplings(coarse_relevant);
    DoFTools::make_sparsity_pattern(dofs, couplings);
    SparsityTools::distribute_sparsity_pattern(couplings,
                                               coarse_owned,
                                               communicator,
                                               coarse_relevant);
    space.pattern.reinit(coarse_owned, couplings, communicator);

    // A node of the body has the values of the coarse shape functions there, the
    // same in all cells.
    const std::vector<Point<dim>> &nodes =
      displacement_element->get_unit_support_points();
    const unsigned int                   n_coarse = element.dofs_per_cell;
    std::vector<types::global_dof_index> indices(nodes.size());
    std::vector<types::global_dof_index> coarse_indices(n_coarse);
    std::vector<std::map<types::global_dof_index, double>> rows(
      relevant.n_elements());
    for (const auto &cell : dofs.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        cell->get_dof_indices(coarse_indices);
        typename DoFHandler<dim>::active_cell_iterator(
          &dofs.get_triangulation(),
          cell->level(),
          cell->index(),
          &displacement_dofs)
          ->get_dof_indices(indices);
        for (unsigned int i = 0; i < nodes.size(); ++i)
          {
            auto &row = rows[relevant.index_within_set(indices[i])];
            if (!row.empty() || prescribed.is_constrained(indices[i]))
              continue;
            for (unsigned int j = 0; j < n_coarse; ++j)
              if (const double value = element.shape_value(j, nodes[i]);
                  displacement_element->system_to_component_index(i).first ==
                    element.system_to_component_index(j).first &&
                  std::abs(value) > 1e-12 &&
                  is_coarse_clamped(coarse_indices[j]) == 0.)
                row.emplace(coarse_indices[j], value);
          }
      }

    space.relevant = relevant;
    DynamicSparsityPattern parents(owned.size(), dofs.n_dofs(), owned);
    for (unsigned int k = 0; k < rows.size(); ++k)
      {
        const types::global_dof_index index = relevant.nth_index_in_set(k);
        for (const auto &[parent, value] : rows[k])
          {
            space.parents.add(parent, value);
            if (owned.is_element(index))
              parents.add(index, parent);
          }
        space.parents.end_functional();
      }
    space.prolongation.reinit(owned, coarse_owned, parents, communicator);
    for (unsigned int k = 0; k < rows.size(); ++k)
      if (const auto index = relevant.nth_index_in_set(k);
          owned.is_element(index))
        for (const auto &[parent, value] : rows[k])
          space.prolongation.set(index, parent, value);
    space.prolongation.compress(VectorOperation::insert);
    return space;
  }

  template CoarseSpace
  Body<1>::coarse_space(const bool) const;
  template CoarseSpace
  Body<2>::coarse_space(const bool) const;
  template CoarseSpace
  Body<3>::coarse_space(const bool) const;
} // namespace Ricochet
