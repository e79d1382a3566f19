// SPDX-License-Identifier: LGPL-2.1-or-later
#include <output/part_nodes.h>

#include <set>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  std::vector<PartNode<dim>>
  nodes_of_parts(const Body<dim>   &body,
                 const unsigned int n_parts,
                 const unsigned int begin,
                 const unsigned int end)
  {
    std::vector<PartNode<dim>>           nodes;
    const FiniteElement<dim>            &element = body.dof_handler().get_fe();
    std::vector<types::global_dof_index> indices(element.n_dofs_per_cell());
    std::set<types::global_dof_index>    seen;
    for (const auto &cell : body.dof_handler().active_cell_iterators())
      if (!cell->is_artificial() && body.part(cell, n_parts) >= begin &&
          body.part(cell, n_parts) < end)
        {
          cell->get_dof_indices(indices);
          for (unsigned int i = 0; i < indices.size(); ++i)
            {
              const auto [component, node] =
                element.system_to_component_index(i);
              const auto first = body.system_index(indices[i]);
              if (component != 0 || !body.owned_indices().is_element(first) ||
                  !seen.insert(first).second)
                continue;
              PartNode<dim> own;
              for (unsigned int c = 0; c < dim; ++c)
                own.indices[c] = body.system_index(
                  indices[element.component_to_system_index(c, node)]);
              own.position = body.mapping().transform_unit_to_real_cell(
                cell,
                element.unit_support_point(i));
              nodes.push_back(own);
            }
        }
    return nodes;
  }


  template std::vector<PartNode<1>>
  nodes_of_parts(const Body<1> &,
                 const unsigned int,
                 const unsigned int,
                 const unsigned int);
  template std::vector<PartNode<2>>
  nodes_of_parts(const Body<2> &,
                 const unsigned int,
                 const unsigned int,
                 const unsigned int);
  template std::vector<PartNode<3>>
  nodes_of_parts(const Body<3> &,
                 const unsigned int,
                 const unsigned int,
                 const unsigned int);
} // namespace Ricochet
