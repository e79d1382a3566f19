// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/memory.h>
#include <base/parameter_file.h>
#include <discretization/body.h>
#include <discretization/boundary_dofs.h>
#include <discretization/nearest_vertex.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// The smallest determinant of the map from the reference cell, over the
    /// vertices of @p cell: negative or zero for an inverted cell.
    template <int dim>
    double
    smallest_determinant(
      const typename Triangulation<dim>::active_cell_iterator &cell)
    {
      if (cell->reference_cell().is_simplex() && dim > 1)
        {
          Tensor<2, dim> edges;
          for (unsigned int d = 0; d < dim; ++d)
            edges[d] = cell->vertex(d + 1) - cell->vertex(0);
          return determinant(edges);
        }
      Point<dim>     vertices[GeometryInfo<dim>::vertices_per_cell];
      Tensor<0, dim> determinants[GeometryInfo<dim>::vertices_per_cell];
      for (const unsigned int v : cell->vertex_indices())
        vertices[v] = cell->vertex(v);
      GeometryInfo<dim>::alternating_form_at_vertices(vertices, determinants);
      double smallest = determinants[0];
      for (const double value : determinants)
        smallest = std::min(smallest, value);
      return smallest;
    }

    template <int dim>
    using Determinant = std::function<double(
      const typename Triangulation<dim>::active_cell_iterator &)>;

    /// The same with the geometry @p curved, over the points of @p rule and the
    /// vertices.
    template <int dim>
    Determinant<dim>
    smallest_determinant_in(const Mapping<dim>    &curved,
                            const FESystem<dim>   &element,
                            const Quadrature<dim> &rule)
    {
      std::vector<Point<dim>> points = rule.get_points();
      for (const auto &point :
           element.base_element(0).get_unit_support_points())
        points.push_back(point);
      const auto values =
        std::make_shared<FEValues<dim>>(curved,
                                        element,
                                        Quadrature<dim>(points),
                                        update_jacobians);
      return [values](const auto &cell) {
        values->reinit(cell);
        double smallest = std::numeric_limits<double>::infinity();
        for (const unsigned int q : values->quadrature_point_indices())
          smallest = std::min(smallest,
                              determinant(Tensor<2, dim>(values->jacobian(q))));
        return smallest;
      };
    }

    template <int dim>
    void
    refuse_inverted_cells(const Triangulation<dim> &triangulation,
                          const Determinant<dim>   &smallest_determinant,
                          const MPI_Comm            communicator)
    {
      std::vector<double> worst;
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && worst.empty() &&
            !(smallest_determinant(cell) > 0.))
          for (unsigned int d = 0; d < dim; ++d)
            worst.push_back(cell->center()[d]);
      for (const auto &center : Utilities::MPI::all_gather(communicator, worst))
        if (!center.empty())
          {
            std::string text;
            for (const double x : center)
              text += (text.empty() ? "" : ", ") + to_text(x);
            throw InputError(
              "The mesh has a cell that is turned inside out or "
              "flat, around (" +
              text + ").");
          }
    }
  } // namespace

  template <int dim>
  Body<dim>::Body(const Triangulation<dim>       &triangulation,
                  const unsigned int              degree,
                  const BoundaryIds              &clamped_ids,
                  const BoundaryIds              &contact_ids,
                  const MultiplierSpace           multipliers,
                  const MPI_Comm                  communicator,
                  const HeldComponents           &held,
                  const Mapping<dim>             *curved,
                  const std::vector<BoundaryIds> &multiplier_sets,
                  const Vertices                 &vertices)
    : communicator(communicator)
    , displacement_dofs(triangulation)
    , multiplier_dofs(triangulation)
    , multipliers(multipliers)
    , clamped_ids(clamped_ids)
    , contact_ids(contact_ids)
    , multiplier_ids(multiplier_sets.empty()
                       ? std::vector<BoundaryIds>{contact_ids}
                       : multiplier_sets)
    , curved_geometry(curved != nullptr)
  {
    const unsigned int n_multipliers =
      n_multiplier_sets() * n_multipliers_per_node();
    const unsigned int degree_of_multipliers =
      multipliers == MultiplierSpace::nodal ||
        multipliers == MultiplierSpace::nodal_vector
      ? degree
      : 1;
    if (triangulation.all_reference_cells_are_hyper_cube())
      {
        displacement_element =
          std::make_unique<FESystem<dim>>(FE_Q<dim>(degree), dim);
        multiplier_element =
          std::make_unique<FESystem<dim>>(FE_Q<dim>(degree_of_multipliers),
                                          n_multipliers);
        // MappingQ and not MappingFE: the latter has no faces in 1D.
        geometry  = std::make_unique<MappingQ<dim>>(1);
        cell_rule = std::make_unique<QGauss<dim>>(degree + 1);
        face_rule = std::make_unique<QGauss<dim - 1>>(degree + 1);
      }
    else if (triangulation.all_reference_cells_are_simplex())
      {
        displacement_element =
          std::make_unique<FESystem<dim>>(FE_SimplexP<dim>(degree), dim);
        multiplier_element =
          std::make_unique<FESystem<dim>>(FE_SimplexP<dim>(
                                            degree_of_multipliers),
                                          n_multipliers);
        geometry  = std::make_unique<MappingFE<dim>>(FE_SimplexP<dim>(1));
        cell_rule = std::make_unique<QGaussSimplex<dim>>(degree + 1);
        face_rule = std::make_unique<QGaussSimplex<dim - 1>>(degree + 1);
      }
    else
      throw InputError(
        "The mesh mixes cells of different kinds; Ricochet "
        "takes meshes of hypercubes only or simplices only.");

    refuse_inverted_cells<dim>(triangulation,
                               smallest_determinant<dim>,
                               communicator);
    if (curved)
      {
        AssertThrow(degree == 2, ExcMessage("Curved cells are of degree 2."));
        geometry = curved->clone();
        refuse_inverted_cells<dim>(
          triangulation,
          smallest_determinant_in(*geometry, *displacement_element, *cell_rule),
          communicator);
      }
    displacement_dofs.distribute_dofs(*displacement_element);
    number_multipliers();
    for (const auto &[id, vertex] : vertices)
      unknowns_of_vertices[id] = unknowns_of_nearest_vertex(*this,
                                                            vertex.place,
                                                            vertex.n_parts,
                                                            vertex.begin,
                                                            vertex.end);

    IndexSet clamped =
      owned_system_indices(boundary_dofs(displacement_dofs, clamped_ids));
    for (const auto &[id, components] : held)
      for (unsigned int c = 0; c < dim; ++c)
        if (components[c])
          clamped.add_indices(boundary_displacements(id, c));
    for (const IndexSet &of_rank :
         Utilities::MPI::all_gather(communicator, clamped))
      prescribed.add_lines(of_rank);
    prescribed.close();
    contact_displacements =
      owned_system_indices(boundary_dofs(displacement_dofs, contact_ids));

    return_freed_memory();
  }

  template <int dim>
  IndexSet
  Body<dim>::owned_system_indices(const IndexSet &displacement_set) const
  {
    IndexSet set(owned.size());
    for (const types::global_dof_index i : displacement_set)
      {
        const types::global_dof_index index = system_index(i);
        if (owned.is_element(index))
          set.add_index(index);
      }
    set.compress();
    return set;
  }

  template <int dim>
  IndexSet
  Body<dim>::boundary_displacements(const types::boundary_id id,
                                    const unsigned int       component) const
  {
    if (const auto vertex = unknowns_of_vertices.find(id);
        vertex != unknowns_of_vertices.end())
      {
        IndexSet set(owned.size());
        if (!vertex->second.empty())
          set.add_index(vertex->second[component]);
        return set;
      }
    ComponentMask mask(dim, false);
    mask.set(component, true);
    return owned_system_indices(
      DoFTools::extract_boundary_dofs(displacement_dofs, mask, {id}));
  }

  template <int dim>
  std::vector<unsigned int>
  Body<dim>::parts_of_unknowns(const unsigned int n_parts) const
  {
    std::vector<unsigned int>            parts(owned.n_elements(), n_parts);
    std::vector<unsigned int>            n_cells(n_parts, 0);
    std::vector<types::global_dof_index> indices(
      displacement_element->n_dofs_per_cell());
    unsigned int largest = 0;
    for (const auto &cell : displacement_dofs.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        const unsigned int own = part(cell, n_parts);
        largest                = std::max(largest, own);
        if (own >= n_parts)
          continue;
        n_cells[own] += cell->is_locally_owned();
        cell->get_dof_indices(indices);
        for (const auto i : indices)
          if (const auto index = system_index(i); owned.is_element(index))
            {
              unsigned int &known = parts[owned.index_within_set(index)];
              known               = std::min(known, own);
            }
      }
    largest = Utilities::MPI::max(largest, communicator);
    if (largest >= n_parts)
      throw InputError("The mesh has cells with the material id " +
                       std::to_string(largest) + ", but there are " +
                       std::to_string(n_parts) +
                       " parts: ids are the numbers of parts, from 0.");
    for (unsigned int p = 0; p < n_parts; ++p)
      if (Utilities::MPI::sum(n_cells[p], communicator) == 0)
        throw InputError("The mesh has no cell of part " + std::to_string(p) +
                         ", that is with this material id.");
    return parts;
  }

  template <int dim>
  void
  Body<dim>::number_multipliers()
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int my_rank = Utilities::MPI::this_mpi_process(communicator);

    std::vector<types::global_dof_index> my_multipliers;
    IndexSet                             contact_dofs;
    IndexSet                             relevant_multipliers;
    if (has_multipliers())
      {
        multiplier_dofs.distribute_dofs(*multiplier_element);
        contact_dofs.set_size(multiplier_dofs.n_dofs());
        for (unsigned int set = 0; set < n_multiplier_sets(); ++set)
          {
            AssertThrow(!multiplier_ids[set].empty(),
                        ExcMessage("Multipliers need a contact boundary."));
            ComponentMask of_set(multiplier_element->n_components(), false);
            for (unsigned int c = 0; c < n_multipliers_per_node(); ++c)
              of_set.set(multiplier_component(set, c), true);
            contact_dofs.add_indices(
              DoFTools::extract_boundary_dofs(multiplier_dofs,
                                              of_set,
                                              multiplier_ids[set]));
          }
        relevant_multipliers =
          DoFTools::extract_locally_relevant_dofs(multiplier_dofs);
        for (const types::global_dof_index i :
             multiplier_dofs.locally_owned_dofs())
          if (contact_dofs.is_element(i))
            my_multipliers.push_back(i);
      }

    // One contiguous range per rank.
    const std::vector<types::global_dof_index> n_displacements =
      Utilities::MPI::all_gather(communicator,
                                 displacement_dofs.n_locally_owned_dofs());
    const std::vector<types::global_dof_index> n_multipliers =
      Utilities::MPI::all_gather(communicator,
                                 static_cast<types::global_dof_index>(
                                   my_multipliers.size()));
    types::global_dof_index displacements_so_far = 0, multipliers_so_far = 0;
    types::global_dof_index my_first_multiplier = 0;
    for (unsigned int rank = 0; rank < n_ranks; ++rank)
      {
        rank_begin.push_back(displacements_so_far);
        rank_shift.push_back(multipliers_so_far);
        displacements_so_far += n_displacements[rank];
        if (rank == my_rank)
          my_first_multiplier = displacements_so_far + multipliers_so_far;
        multipliers_so_far += n_multipliers[rank];
      }

    const types::global_dof_index n_unknowns =
      displacements_so_far + multipliers_so_far;
    owned.set_size(n_unknowns);
    owned.add_range(rank_begin[my_rank] + rank_shift[my_rank],
                    my_first_multiplier + my_multipliers.size());
    owned_multipliers.set_size(n_unknowns);
    owned_multipliers.add_range(my_first_multiplier,
                                my_first_multiplier + my_multipliers.size());
    relevant = owned;
    for (const types::global_dof_index i :
         DoFTools::extract_locally_relevant_dofs(displacement_dofs))
      relevant.add_index(system_index(i));

    if (has_multipliers())
      {
        // The owner of a multiplier knows its number; the others ask for it
        // by a ghost exchange. Doubles hold integers exactly up to 2^53.
        LinearAlgebra::distributed::Vector<double> numbers(
          multiplier_dofs.locally_owned_dofs(),
          relevant_multipliers,
          communicator);
        for (unsigned int j = 0; j < my_multipliers.size(); ++j)
          numbers(my_multipliers[j]) =
            static_cast<double>(my_first_multiplier + j);
        numbers.update_ghost_values();
        for (const types::global_dof_index i : relevant_multipliers)
          if (contact_dofs.is_element(i))
            {
              const auto index =
                static_cast<types::global_dof_index>(numbers(i));
              multiplier_index[i] = index;
              relevant.add_index(index);
            }
      }
    relevant.compress();
  }

  template <int dim>
  types::global_dof_index
  Body<dim>::system_index(const types::global_dof_index i) const
  {
    if (!has_multipliers())
      return i;
    const auto next = std::upper_bound(rank_begin.begin(), rank_begin.end(), i);
    return i + rank_shift[next - rank_begin.begin() - 1];
  }

  template <int dim>
  types::global_dof_index
  Body<dim>::multiplier_system_index(const types::global_dof_index i) const
  {
    const auto entry = multiplier_index.find(i);
    return entry == multiplier_index.end() ? numbers::invalid_dof_index
                                           : entry->second;
  }

  template <int dim>
  void
  Body<dim>::make_sparsity_pattern(
    const bool                         by_component,
    TrilinosWrappers::SparsityPattern &result) const
  {
    DynamicSparsityPattern all(owned.size(), owned.size(), relevant);
    std::vector<types::global_dof_index> cell_dofs(
      displacement_element->n_dofs_per_cell());
    std::vector<types::global_dof_index> multiplier_cell_dofs(
      multiplier_element->n_dofs_per_cell());
    // Unknowns of a cell that couple to each other.
    std::vector<std::vector<types::global_dof_index>> groups(by_component ? dim
                                                                          : 1);

    for (const auto &cell : displacement_dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(cell_dofs);
          for (auto &group : groups)
            group.clear();
          for (unsigned int i = 0; i < cell_dofs.size(); ++i)
            groups[by_component
                     ? displacement_element->system_to_component_index(i).first
                     : 0]
              .push_back(system_index(cell_dofs[i]));
          if (has_multipliers())
            {
              multiplier_cell(cell)->get_dof_indices(multiplier_cell_dofs);
              for (const types::global_dof_index i : multiplier_cell_dofs)
                {
                  const types::global_dof_index index =
                    multiplier_system_index(i);
                  if (index == numbers::invalid_dof_index)
                    continue;
                  if (by_component)
                    all.add(index, index);
                  else
                    groups[0].push_back(index);
                }
            }
          for (auto &group : groups)
            {
              std::sort(group.begin(), group.end());
              for (const types::global_dof_index i : group)
                all.add_entries(i, group.begin(), group.end(), true);
            }
        }
    // Rows of other ranks go to their owners.
    SparsityTools::distribute_sparsity_pattern(all,
                                               owned,
                                               communicator,
                                               relevant);
    result.reinit(owned, all, communicator);
  }

  template <int dim>
  const TrilinosWrappers::SparsityPattern &
  Body<dim>::sparsity_pattern() const
  {
    if (pattern.n_rows() == 0)
      make_sparsity_pattern(false, pattern);
    return pattern;
  }

  template <int dim>
  const TrilinosWrappers::SparsityPattern &
  Body<dim>::component_sparsity_pattern() const
  {
    if (component_pattern.n_rows() == 0)
      make_sparsity_pattern(true, component_pattern);
    return component_pattern;
  }

  template <int dim>
  const std::shared_ptr<const BlockPattern> &
  Body<dim>::block_pattern() const
  {
    if (blocks)
      return blocks;
    AssertThrow(!has_multipliers() ||
                  Utilities::MPI::n_mpi_processes(communicator) == 1,
                ExcMessage("Multipliers of several ranks have no place in "
                           "blocks."));
    const auto partitioner =
      std::make_shared<Utilities::MPI::Partitioner>(owned,
                                                    relevant,
                                                    communicator);
    // From all cells that touch own nodes, also those of other ranks.
    std::vector<std::vector<unsigned int>> rows(
      displacement_dofs.n_locally_owned_dofs() / dim);
    std::vector<types::global_dof_index> cell_dofs(
      displacement_element->n_dofs_per_cell());
    std::vector<unsigned int> nodes;
    for (const auto &cell : displacement_dofs.active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(cell_dofs);
          nodes.clear();
          for (unsigned int i = 0; i < cell_dofs.size(); ++i)
            if (displacement_element->system_to_component_index(i).first == 0)
              nodes.push_back(partitioner->global_to_local(cell_dofs[i]) / dim);
          for (const unsigned int a : nodes)
            for (const unsigned int b : nodes)
              if (a < rows.size() && a < b)
                {
                  auto      &row = rows[a];
                  const auto place =
                    std::lower_bound(row.begin(), row.end(), b);
                  if (place == row.end() || *place != b)
                    row.insert(place, b);
                }
        }
    blocks = std::make_shared<BlockPattern>(partitioner, std::move(rows), dim);
    return blocks;
  }

  template <int dim>
  void
  Body<dim>::interpolate(const Function<dim> &function, Vector &vector) const
  {
    Vector displacement(displacement_dofs.locally_owned_dofs(), communicator);
    VectorTools::interpolate(*geometry,
                             displacement_dofs,
                             function,
                             displacement);
    vector = make_vector();
    for (const types::global_dof_index i :
         displacement_dofs.locally_owned_dofs())
      vector(system_index(i)) = displacement(i);
    vector.compress(VectorOperation::insert);
  }

  template <int dim>
  Vector
  Body<dim>::displacement_part(const Vector &vector) const
  {
    Vector displacement(displacement_dofs.locally_owned_dofs(), communicator);
    for (const types::global_dof_index i :
         displacement_dofs.locally_owned_dofs())
      displacement(i) = vector(system_index(i));
    displacement.compress(VectorOperation::insert);

    Vector ghosted(displacement_dofs.locally_owned_dofs(),
                   DoFTools::extract_locally_relevant_dofs(displacement_dofs),
                   communicator);
    ghosted = displacement;
    return ghosted;
  }

  template <int dim>
  Vector
  Body<dim>::make_vector() const
  {
    return Vector(owned, communicator);
  }

  template <int dim>
  Vector
  Body<dim>::make_ghosted_vector(
    const std::vector<types::global_dof_index> &more) const
  {
    IndexSet known = relevant;
    // Multipliers that do not exist keep an invalid index. Indices that are
    // sorted are added at once.
    std::vector<types::global_dof_index> unknown;
    for (const auto index : more)
      if (index < known.size() && !relevant.is_element(index))
        unknown.push_back(index);
    std::sort(unknown.begin(), unknown.end());
    unknown.erase(std::unique(unknown.begin(), unknown.end()), unknown.end());
    known.add_indices(unknown.begin(), unknown.end());
    return Vector(owned, known, communicator);
  }

  template class Body<1>;
  template class Body<2>;
  template class Body<3>;
} // namespace Ricochet
