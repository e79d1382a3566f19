// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/files.h>
#include <discretization/body.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <tuple>

// Data of a body for checkpoints that do not depend on the number of ranks: an
// order of the unknowns, and a checksum of the mesh.

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  std::vector<types::global_dof_index>
  Body<dim>::canonical_positions() const
  {
    // A key for each owned unknown: the smallest of the cells that have it, and
    // its number there (multipliers behind displacements). All these cells are
    // owned or ghosts.
    using Key = std::pair<std::string, unsigned int>;
    std::map<types::global_dof_index, Key> key_of;
    std::vector<types::global_dof_index>   indices, cell_dofs;
    for (const auto &cell : displacement_dofs.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        cell_dofs.resize(displacement_element->n_dofs_per_cell());
        cell->get_dof_indices(cell_dofs);
        indices.clear();
        for (const auto i : cell_dofs)
          indices.push_back(system_index(i));
        if (has_multipliers())
          {
            cell_dofs.resize(multiplier_element->n_dofs_per_cell());
            multiplier_cell(cell)->get_dof_indices(cell_dofs);
            for (const auto i : cell_dofs)
              indices.push_back(multiplier_system_index(i));
          }
        const auto  bytes = cell->id().template to_binary<dim>();
        std::string name;
        // Most significant digits first, so that strings sort like numbers.
        for (const unsigned int word : bytes)
          for (int shift = 24; shift >= 0; shift -= 8)
            name += static_cast<char>(word >> shift & 0xff);
        for (unsigned int k = 0; k < indices.size(); ++k)
          if (owned.is_element(indices[k]))
            {
              const Key  key{name, k};
              const auto known = key_of.emplace(indices[k], key).first;
              known->second    = std::min(known->second, key);
            }
      }

    // The first rank sorts the keys of all and sends each rank its positions.
    std::vector<std::string>  names;
    std::vector<unsigned int> numbers;
    for (const auto &entry : key_of)
      {
        names.push_back(entry.second.first);
        numbers.push_back(entry.second.second);
      }
    const auto all_names   = Utilities::MPI::gather(communicator, names);
    const auto all_numbers = Utilities::MPI::gather(communicator, numbers);
    std::map<unsigned int, std::vector<types::global_dof_index>> places;
    std::vector<std::tuple<Key, unsigned int, unsigned int>>     sorted;
    for (unsigned int rank = 0; rank < all_names.size(); ++rank)
      {
        places[rank].resize(all_names[rank].size());
        for (unsigned int k = 0; k < all_names[rank].size(); ++k)
          sorted.emplace_back(Key{all_names[rank][k], all_numbers[rank][k]},
                              rank,
                              k);
      }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t place = 0; place < sorted.size(); ++place)
      places[std::get<1>(sorted[place])][std::get<2>(sorted[place])] = place;
    return Utilities::MPI::some_to_some(communicator, places).at(0);
  }

  template <int dim>
  std::uint64_t
  Body<dim>::mesh_checksum() const
  {
    // The sum over all cells, which does not depend on their order.
    std::uint64_t sum = 0;
    for (const auto &cell : displacement_dofs.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        std::ostringstream bytes;
        const auto         put = [&](const auto &value) {
          bytes.write(reinterpret_cast<const char *>(&value), sizeof(value));
        };
        // In single precision, as curved cells are evaluated, which another processor may
        // round in another way.
        const auto put_point = [&](const Point<dim> &point) {
          for (unsigned int c = 0; c < dim; ++c)
            put(static_cast<float>(point[c]));
        };
        put(cell->id().template to_binary<dim>());
        put(cell->material_id());
        for (const auto &vertex : mapping().get_vertices(cell))
          put_point(vertex);
        for (const auto &face : cell->face_iterators())
          put(face->at_boundary() ? face->boundary_id()
                                  : numbers::internal_face_boundary_id);
        if (is_curved())
          for (const Point<dim> &node :
               displacement_element->base_element(0).get_unit_support_points())
            put_point(mapping().transform_unit_to_real_cell(cell, node));
        const std::string own = bytes.str();
        sum +=
          (static_cast<std::uint64_t>(checksum(own)) << 32) + checksum(own, 1);
      }
    return Utilities::MPI::sum(sum, communicator);
  }

  template std::vector<types::global_dof_index>
  Body<1>::canonical_positions() const;
  template std::vector<types::global_dof_index>
  Body<2>::canonical_positions() const;
  template std::vector<types::global_dof_index>
  Body<3>::canonical_positions() const;
  template std::uint64_t
  Body<1>::mesh_checksum() const;
  template std::uint64_t
  Body<2>::mesh_checksum() const;
  template std::uint64_t
  Body<3>::mesh_checksum() const;
} // namespace Ricochet
