// SPDX-License-Identifier: LGPL-2.1-or-later
#include <output/mean_rotation.h>
#include <solvers/body_matrix.h>

#include <deal.II/base/function_lib.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

#include <Eigen/Geometry>

#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  MeanRotation<dim>::MeanRotation(const Body<dim>   &body,
                                  const BodyMatrix  &mass,
                                  const unsigned int n_parts,
                                  const unsigned int begin,
                                  const unsigned int end)
    : communicator(body.communicator)
    , nodes(nodes_of_parts(body, n_parts, begin, end))
  {
    // The mass of each node, and its product with the position: the mass matrix
    // couples equal components only, and the position is in the space of the
    // displacements.
    Vector field, masses = body.make_vector(), moment = body.make_vector();
    body.interpolate(Functions::ConstantFunction<dim>(1., dim), field);
    mass.vmult(masses, field);
    body.interpolate(Functions::IdentityFunction<dim>(), field);
    mass.vmult(moment, field);
    double         total = 0.;
    Tensor<1, dim> centre;
    for (const PartNode<dim> &node : nodes)
      {
        total += masses(node.indices[0]);
        for (unsigned int c = 0; c < dim; ++c)
          centre[c] += moment(node.indices[c]);
      }
    centre = Utilities::MPI::sum(centre, communicator) /
      Utilities::MPI::sum(total, communicator);
    for (const PartNode<dim> &node : nodes)
      {
        Tensor<1, dim> own;
        for (unsigned int c = 0; c < dim; ++c)
          own[c] =
            moment(node.indices[c]) - masses(node.indices[c]) * centre[c];
        moments.push_back(own);
      }
  }



  template <int dim>
  Tensor<1, 3>
  MeanRotation<dim>::vector(const Vector &solution) const
  {
    // The centre of the deformed body drops out, since the moments have no sum.
    Tensor<2, dim> correlation;
    for (unsigned int n = 0; n < nodes.size(); ++n)
      {
        Tensor<1, dim> place;
        for (unsigned int c = 0; c < dim; ++c)
          place[c] = nodes[n].position[c] + solution(nodes[n].indices[c]);
        correlation += outer_product(place, moments[n]);
      }
    correlation = Utilities::MPI::sum(correlation, communicator);

    Tensor<1, 3> rotation;
    if (!(determinant(correlation) > 0.))
      return rotation;
    const Tensor<2, dim> nearest = project_onto_orthogonal_tensors(correlation);
    if constexpr (dim == 2)
      rotation[2] = std::atan2(nearest[1][0], nearest[0][0]);
    else
      {
        Eigen::Matrix3d matrix;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            matrix(i, j) = nearest[i][j];
        const Eigen::AngleAxisd turn(matrix);
        for (unsigned int c = 0; c < 3; ++c)
          rotation[c] = turn.angle() * turn.axis()(c);
      }
    return rotation;
  }


  template class MeanRotation<2>;
  template class MeanRotation<3>;
} // namespace Ricochet
