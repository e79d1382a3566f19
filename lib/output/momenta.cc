// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <output/momenta.h>
#include <solvers/body_matrix.h>

#include <algorithm>

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
  void
  Momenta<dim>::move_rigidly() const
  {
    if (!of_translations.empty())
      return;
    Vector     velocity(momentum);
    const auto add_motion = [&](std::vector<Vector> &motions,
                                const auto          &velocity_at) {
      velocity = 0.;
      for (const PartNode<dim> &node : nodes)
        {
          const Tensor<1, 3> of_node = velocity_at(node);
          for (unsigned int c = 0; c < dim; ++c)
            velocity(node.indices[c]) = of_node[c];
        }
      velocity.compress(VectorOperation::insert);
      mass.vmult(momentum, velocity);
      motions.push_back(momentum);
    };
    for (unsigned int axis = 0; axis < 3; ++axis)
      {
        Tensor<1, 3> direction;
        direction[axis] = 1.;
        if (axis < dim)
          add_motion(of_translations,
                     [&](const PartNode<dim> &) { return direction; });
        if (dim == 3 || axis == 2)
          add_motion(of_rotations, [&](const PartNode<dim> &node) {
            Tensor<1, 3> arm;
            for (unsigned int c = 0; c < dim; ++c)
              arm[c] = node.position[c];
            return cross_product_3d(direction, arm);
          });
      }

    begin_of_motions = momentum.locally_owned_size();
    end_of_motions   = 0;
    for (const auto *const motions : {&of_translations, &of_rotations})
      for (const Vector &motion : *motions)
        for (unsigned int i = 0; i < motion.locally_owned_size(); ++i)
          if (local_values(motion)[i] != 0.)
            {
              begin_of_motions = std::min(begin_of_motions, i);
              end_of_motions   = std::max(end_of_motions, i + 1);
            }
    end_of_motions = std::max(begin_of_motions, end_of_motions);
  }



  template <int dim>
  std::vector<double>
  Momenta<dim>::products(const std::vector<Vector> &motions,
                         const Vector              &velocity) const
  {
    const unsigned int  n = end_of_motions - begin_of_motions;
    std::vector<double> sums;
    for (const Vector &motion : motions)
      sums.push_back(entries(motion)
                       .segment(begin_of_motions, n)
                       .dot(entries(velocity).segment(begin_of_motions, n)));
    Utilities::MPI::sum(sums, communicator, sums);
    return sums;
  }



  template <int dim>
  double
  Momenta<dim>::mass_of_body() const
  {
    move_rigidly();
    double sum = 0.;
    for (const PartNode<dim> &node : nodes)
      sum += of_translations[0](node.indices[0]);
    return Utilities::MPI::sum(sum, communicator);
  }



  template <int dim>
  Tensor<1, dim>
  Momenta<dim>::linear(const Vector &velocity) const
  {
    move_rigidly();
    const std::vector<double> sums = products(of_translations, velocity);
    Tensor<1, dim>            sum;
    for (unsigned int c = 0; c < dim; ++c)
      sum[c] = sums[c];
    return sum;
  }



  template <int dim>
  Tensor<1, 3>
  Momenta<dim>::angular(const Vector &solution, const Vector &velocity) const
  {
    move_rigidly();
    const std::vector<double> sums = products(of_rotations, velocity);
    Tensor<1, 3>              sum;
    for (unsigned int axis = 3 - sums.size(); axis < 3; ++axis)
      sum[axis] = sums[axis - (3 - sums.size())];
    if (small_strains)
      return sum;
    mass.vmult(momentum, velocity);
    Tensor<1, 3> of_displacements;
    for (const PartNode<dim> &node : nodes)
      {
        Tensor<1, 3> arm, node_momentum;
        for (unsigned int c = 0; c < dim; ++c)
          {
            arm[c]           = solution(node.indices[c]);
            node_momentum[c] = momentum(node.indices[c]);
          }
        of_displacements += cross_product_3d(arm, node_momentum);
      }
    return sum + Utilities::MPI::sum(of_displacements, communicator);
  }


  template class Momenta<2>;
  template class Momenta<3>;
} // namespace Ricochet
