// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/treatments/nitsche_bound.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// The largest eigenvalue of @p traction against @p energy, a positive
    /// semi-definite matrix, off its kernel: that of rigid motions, in which there
    /// is no traction either.
    double
    largest_eigenvalue(const Eigen::MatrixXd &traction,
                       const Eigen::MatrixXd &energy)
    {
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(energy);
      const double stiffest = modes.eigenvalues().maxCoeff();
      Eigen::Index n_rigid  = 0;
      while (n_rigid < energy.rows() &&
             modes.eigenvalues()[n_rigid] < 1e-10 * stiffest)
        ++n_rigid;
      const Eigen::Index    n           = energy.rows() - n_rigid;
      const Eigen::MatrixXd unit_energy = modes.eigenvectors().rightCols(n) *
        modes.eigenvalues().tail(n).cwiseSqrt().cwiseInverse().asDiagonal();
      return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
               unit_energy.transpose() * traction * unit_energy,
               Eigen::EigenvaluesOnly)
        .eigenvalues()
        .maxCoeff();
    }

    /// See nitsche_trace_constants().
    ///
    /// @param direction along which the stress is taken on a face with that
    /// boundary id, in that point and with that outward normal; none outside of the
    /// contact boundary.
    template <int dim>
    std::vector<double>
    trace_constants(
      const Body<dim>                      &body,
      const std::vector<LinearStress<dim>> &stresses,
      const std::function<std::optional<Tensor<1, 3>>(const types::boundary_id,
                                                      const Tensor<1, 3> &,
                                                      const Tensor<1, 3> &)>
        &direction)
    {
      const FEValuesExtractors::Vector displacement(0);
      const FiniteElement<dim>        &element = body.dof_handler().get_fe();
      FEValues<dim>                    cell_values(body.mapping(),
                                element,
                                body.cell_quadrature(),
                                update_gradients | update_JxW_values);
      FEFaceValues<dim>                face_values(body.mapping(),
                                    element,
                                    body.face_quadrature(),
                                    update_gradients |
                                      update_quadrature_points |
                                      update_normal_vectors |
                                      update_JxW_values);
      const unsigned int               n = element.n_dofs_per_cell();
      Eigen::MatrixXd                  traction(n, n), energy(n, n);
      Eigen::VectorXd                  pressure(n);
      std::vector<double>              largest(stresses.size(), 0.);
      for (const auto &cell : body.dof_handler().active_cell_iterators())
        {
          if (!cell->is_locally_owned())
            continue;
          const unsigned int part =
            stresses.size() == 1 ? 0 : cell->material_id();
          const LinearStress<dim> &stress = stresses[part];
          traction.setZero();
          for (const unsigned int f : cell->face_indices())
            {
              if (!cell->face(f)->at_boundary())
                continue;
              face_values.reinit(cell, f);
              for (const unsigned int q :
                   face_values.quadrature_point_indices())
                {
                  const auto along =
                    direction(cell->face(f)->boundary_id(),
                              in_space<dim>(face_values.quadrature_point(q)),
                              in_space(face_values.normal_vector(q)));
                  if (!along)
                    break;
                  for (unsigned int i = 0; i < n; ++i)
                    pressure[i] = *along *
                      in_space(
                        stress(
                          face_values[displacement].symmetric_gradient(i, q)) *
                        face_values.normal_vector(q));
                  traction.noalias() += cell->diameter() * face_values.JxW(q) *
                    pressure * pressure.transpose();
                }
            }
          if (traction.isZero(0.))
            continue;
          cell_values.reinit(cell);
          energy.setZero();
          for (const unsigned int q : cell_values.quadrature_point_indices())
            for (unsigned int i = 0; i < n; ++i)
              {
                const SymmetricTensor<2, dim> cell_stress =
                  stress(cell_values[displacement].symmetric_gradient(i, q));
                for (unsigned int j = 0; j < n; ++j)
                  energy(i, j) += cell_values.JxW(q) *
                    (cell_stress *
                     cell_values[displacement].symmetric_gradient(j, q));
              }
          largest[part] =
            std::max(largest[part], largest_eigenvalue(traction, energy));
        }
      for (double &constant : largest)
        constant = Utilities::MPI::max(constant, body.communicator);
      return largest;
    }
  } // namespace



  template <int dim>
  double
  nitsche_trace_constant(const Body<dim>                             &body,
                         const std::common_type_t<LinearStress<dim>> &stress,
                         const Obstacles                             &obstacles)
  {
    return trace_constants<dim>(
      body,
      {stress},
      [&](const types::boundary_id id,
          const Tensor<1, 3>      &x,
          const Tensor<1, 3>      &outward) -> std::optional<Tensor<1, 3>> {
        const auto obstacle = obstacles.find(id);
        if (obstacle == obstacles.end())
          return {};
        return stress_direction(*obstacle->second,
                                obstacle->second->normal(x, 0.),
                                outward);
      })[0];
  }



  template <int dim>
  std::vector<double>
  nitsche_trace_constants(const Body<dim>                      &body,
                          const std::vector<LinearStress<dim>> &stresses,
                          const std::set<types::boundary_id>   &boundary_ids)
  {
    return trace_constants<dim>(
      body,
      stresses,
      [&](const types::boundary_id id,
          const Tensor<1, 3> &,
          const Tensor<1, 3> &outward) -> std::optional<Tensor<1, 3>> {
        if (boundary_ids.count(id) == 0)
          return {};
        return -outward;
      });
  }


  template double
  nitsche_trace_constant(const Body<1> &,
                         const LinearStress<1> &,
                         const Obstacles &);
  template double
  nitsche_trace_constant(const Body<2> &,
                         const LinearStress<2> &,
                         const Obstacles &);
  template double
  nitsche_trace_constant(const Body<3> &,
                         const LinearStress<3> &,
                         const Obstacles &);
  template std::vector<double>
  nitsche_trace_constants(const Body<2> &,
                          const std::vector<LinearStress<2>> &,
                          const std::set<types::boundary_id> &);
} // namespace Ricochet
