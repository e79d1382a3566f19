// SPDX-License-Identifier: LGPL-2.1-or-later
#include <output/momenta.h>

#include <set>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  Momenta<dim>::Momenta(const Body<dim>   &body,
                        const Matrix      &mass,
                        const bool         small_strains,
                        const unsigned int n_parts,
                        const unsigned int begin,
                        const unsigned int given_end)
    : communicator(body.communicator)
    , mass(mass)
    , small_strains(small_strains)
    , momentum(body.make_vector())
  {
    const unsigned int end =
      given_end == numbers::invalid_unsigned_int ? begin + 1 : given_end;
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
              node_indices.emplace_back();
              for (unsigned int c = 0; c < dim; ++c)
                node_indices.back()[c] = body.system_index(
                  indices[element.component_to_system_index(c, node)]);
              positions.push_back(body.mapping().transform_unit_to_real_cell(
                cell,
                element.unit_support_point(i)));
            }
        }
  }



  template <int dim>
  Tensor<1, dim>
  Momenta<dim>::linear(const Vector &velocity) const
  {
    mass.vmult(momentum, velocity);
    Tensor<1, dim> sum;
    for (const auto &node : node_indices)
      for (unsigned int c = 0; c < dim; ++c)
        sum[c] += momentum(node[c]);
    return Utilities::MPI::sum(sum, communicator);
  }



  template <int dim>
  Tensor<1, 3>
  Momenta<dim>::angular(const Vector &solution, const Vector &velocity) const
  {
    mass.vmult(momentum, velocity);
    Tensor<1, 3> sum;
    for (unsigned int n = 0; n < node_indices.size(); ++n)
      {
        Tensor<1, 3> arm, node_momentum;
        for (unsigned int c = 0; c < dim; ++c)
          {
            arm[c] = positions[n][c] +
              (small_strains ? 0. : solution(node_indices[n][c]));
            node_momentum[c] = momentum(node_indices[n][c]);
          }
        sum += cross_product_3d(arm, node_momentum);
      }
    return Utilities::MPI::sum(sum, communicator);
  }


  template class Momenta<2>;
  template class Momenta<3>;
} // namespace Ricochet
