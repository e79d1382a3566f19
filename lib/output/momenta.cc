// SPDX-License-Identifier: LGPL-2.1-or-later
#include <output/momenta.h>
#include <solvers/body_matrix.h>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  Momenta<dim>::Momenta(const Body<dim>   &body,
                        const BodyMatrix  &mass,
                        const bool         small_strains,
                        const unsigned int n_parts,
                        const unsigned int begin,
                        const unsigned int end)
    : communicator(body.communicator)
    , mass(mass)
    , small_strains(small_strains)
    , nodes(
        nodes_of_parts(body,
                       n_parts,
                       begin,
                       end == numbers::invalid_unsigned_int ? begin + 1 : end))
    , momentum(body.make_vector())
  {}



  template <int dim>
  Tensor<1, dim>
  Momenta<dim>::linear(const Vector &velocity) const
  {
    mass.vmult(momentum, velocity);
    Tensor<1, dim> sum;
    for (const PartNode<dim> &node : nodes)
      for (unsigned int c = 0; c < dim; ++c)
        sum[c] += momentum(node.indices[c]);
    return Utilities::MPI::sum(sum, communicator);
  }



  template <int dim>
  Tensor<1, 3>
  Momenta<dim>::angular(const Vector &solution, const Vector &velocity) const
  {
    mass.vmult(momentum, velocity);
    Tensor<1, 3> sum;
    for (const PartNode<dim> &node : nodes)
      {
        Tensor<1, 3> arm, node_momentum;
        for (unsigned int c = 0; c < dim; ++c)
          {
            arm[c] = node.position[c] +
              (small_strains ? 0. : solution(node.indices[c]));
            node_momentum[c] = momentum(node.indices[c]);
          }
        sum += cross_product_3d(arm, node_momentum);
      }
    return Utilities::MPI::sum(sum, communicator);
  }


  template class Momenta<2>;
  template class Momenta<3>;
} // namespace Ricochet
