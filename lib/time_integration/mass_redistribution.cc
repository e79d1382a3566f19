// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <discretization/ghost_flags.h>
#include <time_integration/mass_redistribution.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>

#include <Eigen/Dense>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Data of a displacement DoF for the redistribution.
    template <int dim>
    struct DoF
    {
      unsigned int component;
      Point<dim>   position;
      bool         on_contact_boundary;
      /// Number of the body that the DoF belongs to.
      unsigned int body = 0;
    };

    /**
     * Find the DoFs that are connected through cells: moments are those of a
     * body, and a mesh may contain several that do not touch. Every DoF gets the
     * smallest index of its body: within a rank by joining sets, between ranks by
     * exchange until nothing changes.
     *
     * @return number of bodies.
     */
    template <int dim>
    unsigned int
    number_bodies(const Body<dim>                             &body,
                  std::map<types::global_dof_index, DoF<dim>> &dofs)
    {
      std::map<types::global_dof_index, types::global_dof_index> parent;
      const auto root = [&](types::global_dof_index i) {
        while (parent.at(i) != i)
          i = parent[i] = parent.at(parent.at(i));
        return i;
      };
      for (const auto &entry : dofs)
        parent[entry.first] = entry.first;
      std::vector<types::global_dof_index> indices(
        body.dof_handler().get_fe().n_dofs_per_cell());
      for (const auto &cell : body.dof_handler().active_cell_iterators())
        if (!cell->is_artificial())
          {
            cell->get_dof_indices(indices);
            for (const auto i : indices)
              parent[root(body.system_index(i))] =
                root(body.system_index(indices[0]));
          }

      std::map<types::global_dof_index, double> smallest;
      for (const auto &entry : dofs)
        smallest[root(entry.first)] = std::numeric_limits<double>::max();
      Vector labels  = body.make_vector();
      Vector ghosted = body.make_ghosted_vector();
      for (const auto i : labels.locally_owned_elements())
        labels(i) = i;
      labels.compress(VectorOperation::insert);
      unsigned int changed = 1;
      while (changed)
        {
          ghosted = labels;
          changed = 0;
          for (const auto &entry : dofs)
            {
              double &label = smallest[root(entry.first)];
              label =
                std::min(label, static_cast<double>(ghosted(entry.first)));
            }
          for (const auto &entry : dofs)
            if (body.owned_indices().is_element(entry.first))
              {
                const double label  = smallest[root(entry.first)];
                changed             = changed || label < labels(entry.first);
                labels(entry.first) = label;
              }
          labels.compress(VectorOperation::insert);
          changed = Utilities::MPI::max(changed, body.communicator);
        }

      // Labels replaced by numbers, the same on all ranks.
      std::set<double>    all_labels;
      std::vector<double> mine;
      for (const auto &entry : smallest)
        mine.push_back(entry.second);
      for (const auto &list :
           Utilities::MPI::all_gather(body.communicator, mine))
        all_labels.insert(list.begin(), list.end());
      for (auto &[index, dof] : dofs)
        dof.body = std::distance(all_labels.begin(),
                                 all_labels.find(smallest[root(index)]));
      return all_labels.size();
    }

    template <int dim>
    std::map<types::global_dof_index, DoF<dim>>
    describe_dofs(const Body<dim> &body)
    {
      std::map<types::global_dof_index, Point<dim>> positions;
      DoFTools::map_dofs_to_support_points(body.mapping(),
                                           body.dof_handler(),
                                           positions);
      Vector on_boundary = body.make_ghosted_vector();
      flag_with_ghosts(body.contact_indices(), on_boundary);
      std::map<types::global_dof_index, DoF<dim>> dofs;
      std::vector<types::global_dof_index>        indices(
        body.dof_handler().get_fe().n_dofs_per_cell());
      for (const auto &cell : body.dof_handler().active_cell_iterators())
        {
          if (cell->is_artificial())
            continue;
          cell->get_dof_indices(indices);
          for (unsigned int i = 0; i < indices.size(); ++i)
            dofs[body.system_index(indices[i])] = {
              body.dof_handler().get_fe().system_to_component_index(i).first,
              positions.at(indices[i]),
              on_boundary(body.system_index(indices[i])) == 1.};
        }
      return dofs;
    }

    /// Symmetrised products a_k b_k^T at the positions of a pair, for all moments
    /// about @p origin: 1 1, x_i 1, x_i x_j.
    template <int dim>
    Eigen::VectorXd
    moments_of_pair(const DoF<dim>   &row,
                    const DoF<dim>   &column,
                    const Point<dim> &origin)
    {
      const Tensor<1, dim> x = row.position - origin;
      const Tensor<1, dim> y = column.position - origin;
      Eigen::VectorXd      values(n_mass_moments<dim>);
      unsigned int         k = 0;
      values[k++]            = 1.;
      for (unsigned int i = 0; i < dim; ++i)
        values[k++] = .5 * (x[i] + y[i]);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          values[k++] = .5 * (x[i] * y[j] + x[j] * y[i]);
      return values;
    }

    /// Visit the owned entries of @p matrix between DoFs of one component.
    template <int dim>
    void
    for_each_entry(
      const Matrix                                      &matrix,
      const std::map<types::global_dof_index, DoF<dim>> &dofs,
      const std::function<void(const types::global_dof_index row,
                               const types::global_dof_index column,
                               const DoF<dim>               &row_dof,
                               const DoF<dim>               &column_dof,
                               const double                  value)>     &visit)
    {
      const auto range = matrix.local_range();
      for (auto row = range.first; row < range.second; ++row)
        {
          const auto row_dof = dofs.find(row);
          if (row_dof == dofs.end())
            continue;
          for (auto entry = matrix.begin(row); entry != matrix.end(row);
               ++entry)
            {
              const auto column_dof = dofs.find(entry->column());
              if (column_dof != dofs.end() &&
                  column_dof->second.component == row_dof->second.component)
                visit(row,
                      entry->column(),
                      row_dof->second,
                      column_dof->second,
                      entry->value());
            }
        }
    }

    /// Add up the entries of @p values over all ranks.
    template <typename EigenType>
    void
    sum_over_ranks(EigenType &values, const MPI_Comm communicator)
    {
      const ArrayView<double> view(values.data(), values.size());
      Utilities::MPI::sum(ArrayView<const double>(view), communicator, view);
    }

    /// The moments of the body with the number @p body.
    template <int dim>
    Eigen::VectorXd
    moments(const Matrix                                      &mass,
            const std::map<types::global_dof_index, DoF<dim>> &dofs,
            const unsigned int                                 body,
            const Point<dim>                                  &origin,
            const MPI_Comm                                     communicator)
    {
      Eigen::VectorXd sums = Eigen::VectorXd::Zero(n_mass_moments<dim>);
      for_each_entry<dim>(mass,
                          dofs,
                          [&](const auto,
                              const auto,
                              const DoF<dim> &row,
                              const DoF<dim> &column,
                              const double    value) {
                            if (row.component == 0 && row.body == body)
                              sums +=
                                value * moments_of_pair(row, column, origin);
                          });
      sum_over_ranks(sums, communicator);
      return sums;
    }

    /**
     * Remove the inertia of the contact boundary of the body with the number
     * @p body in @p redistributed, a copy of @p mass, and keep its moments about
     * @p centre: by the nearest matrix, or, @p in_proportion, with each entry
     * multiplied by a polynomial.
     */
    template <int dim>
    void
    redistribute(const Matrix                                      &mass,
                 const std::map<types::global_dof_index, DoF<dim>> &dofs,
                 const unsigned int                                 body,
                 const Point<dim>                                  &centre,
                 const bool     in_proportion,
                 const MPI_Comm communicator,
                 Matrix        &redistributed)
    {
      // Weight of the change of an entry, by its own value.
      const auto weight = [&](const double value) {
        return in_proportion ? value : 1.;
      };
      // Moments that are lost with the contact boundary, and the Gram matrix of
      // the constraints on the entries that are left.
      const unsigned int n       = n_mass_moments<dim>;
      Eigen::VectorXd    missing = Eigen::VectorXd::Zero(n);
      Eigen::MatrixXd    gram    = Eigen::MatrixXd::Zero(n, n);
      for_each_entry<dim>(mass,
                          dofs,
                          [&](const auto,
                              const auto,
                              const DoF<dim> &row,
                              const DoF<dim> &column,
                              const double    value) {
                            if (row.component != 0 || row.body != body)
                              return;
                            const Eigen::VectorXd products =
                              moments_of_pair(row, column, centre);
                            if (row.on_contact_boundary ||
                                column.on_contact_boundary)
                              missing += value * products;
                            else
                              gram +=
                                weight(value) * products * products.transpose();
                          });
      sum_over_ranks(missing, communicator);
      sum_over_ranks(gram, communicator);

      // Scale the constraints to unit diagonal before judging independence.
      const Eigen::VectorXd scale =
        gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
      const Eigen::MatrixXd scaled =
        scale.asDiagonal() * gram * scale.asDiagonal();
      Eigen::FullPivLU<Eigen::MatrixXd> factorisation(scaled);
      factorisation.setThreshold(1e-12);
      if (!factorisation.isInvertible())
        throw InputError(
          "The mass cannot be redistributed: too few nodes lie "
          "off the contact boundary to keep mass, centre of mass "
          "and moments of inertia. Refine the mesh or take the "
          "consistent mass.");
      const Eigen::VectorXd multipliers = scale.asDiagonal() *
        factorisation.solve(Eigen::VectorXd(scale.asDiagonal() * missing));

      for_each_entry<dim>(
        mass,
        dofs,
        [&](const types::global_dof_index row_index,
            const types::global_dof_index column_index,
            const DoF<dim>               &row,
            const DoF<dim>               &column,
            const double                  value) {
          if (row.body != body)
            return;
          redistributed.set(
            row_index,
            column_index,
            row.on_contact_boundary || column.on_contact_boundary ? 0.
                                                                  : value +
                weight(value) *
                  multipliers.dot(moments_of_pair(row, column, centre)));
        });
      redistributed.compress(VectorOperation::insert);
    }

    /**
     * Whether @p matrix is positive definite off the rows @p massless, where it
     * is zero. Conjugate gradients from a right hand side without structure
     * meet a direction of negative curvature if there is one, because the
     * extreme eigenvalues show first. With the diagonal as preconditioner a mass
     * matrix is so well conditioned that they converge in a few dozen steps,
     * whatever the sizes of the elements (Wathen, IMA J. Numer. Anal. 7, 1987).
     */
    bool
    is_positive_definite(const Matrix   &matrix,
                         const IndexSet &massless,
                         const Vector   &layout)
    {
      Vector residual(layout), inverse_diagonal(layout), product(layout);
      bool   positive = true;
      for (const auto i : residual.locally_owned_elements())
        if (!massless.is_element(i))
          {
            const double diagonal = matrix.diag_element(i);
            positive              = positive && diagonal > 0.;
            inverse_diagonal(i)   = 1. / diagonal;
            // All directions alike, in the scale of the preconditioned matrix.
            residual(i) =
              std::sqrt(std::abs(diagonal)) * (std::sin(1. + 12.9898 * i) + .1);
          }
      residual.compress(VectorOperation::insert);
      inverse_diagonal.compress(VectorOperation::insert);
      if (Utilities::MPI::min(positive ? 1 : 0,
                              layout.get_mpi_communicator()) == 0)
        return false;

      Vector preconditioned(residual);
      preconditioned.scale(inverse_diagonal);
      Vector       direction(preconditioned);
      double       rho     = residual * preconditioned;
      const double initial = rho;
      for (unsigned int k = 0; k < 1000 && rho > 1e-20 * initial; ++k)
        {
          matrix.vmult(product, direction);
          const double curvature = direction * product;
          if (!(curvature > 0.))
            return false;
          residual.add(-rho / curvature, product);
          preconditioned = residual;
          preconditioned.scale(inverse_diagonal);
          const double new_rho = residual * preconditioned;
          direction.sadd(new_rho / rho, 1., preconditioned);
          rho = new_rho;
        }
      return rho <= 1e-20 * initial;
    }
  } // namespace



  template <int dim>
  std::vector<std::array<double, n_mass_moments<dim>>>
  mass_moments(const Body<dim> &body, const Matrix &mass)
  {
    auto               dofs = describe_dofs(body);
    const unsigned int n    = number_bodies(body, dofs);
    std::vector<std::array<double, n_mass_moments<dim>>> result(n);
    for (unsigned int b = 0; b < n; ++b)
      {
        const Eigen::VectorXd sums =
          moments<dim>(mass, dofs, b, Point<dim>(), body.communicator);
        std::copy(sums.data(), sums.data() + sums.size(), result[b].begin());
      }
    return result;
  }



  template <int dim>
  Matrix
  redistribute_mass(const Body<dim> &body, const Matrix &mass)
  {
    auto               dofs     = describe_dofs(body);
    const unsigned int n_bodies = number_bodies(body, dofs);

    // The mass of a body without contact boundary is unchanged.
    std::vector<unsigned int> touches(n_bodies, 0);
    for (const auto &entry : dofs)
      if (entry.second.on_contact_boundary)
        touches[entry.second.body] = 1;
    Utilities::MPI::max(touches, body.communicator, touches);

    // The small system is well conditioned with moments about the centre of
    // mass.
    std::vector<Point<dim>> centres(n_bodies);
    for (unsigned int b = 0; b < n_bodies; ++b)
      {
        const Eigen::VectorXd about_zero =
          moments<dim>(mass, dofs, b, Point<dim>(), body.communicator);
        for (unsigned int i = 0; i < dim; ++i)
          centres[b][i] = about_zero[1 + i] / about_zero[0];
      }

    // The nearest matrix changes all entries by like amounts, small ones too, and
    // need not be positive where much of the mass sits on the contact boundary.
    // Then each entry is multiplied by a polynomial of the positions, like a
    // modified density.
    IndexSet no_inertia = body.contact_indices();
    no_inertia.add_indices(body.multiplier_indices());
    for (const bool in_proportion : {false, true})
      {
        Matrix redistributed;
        redistributed.copy_from(mass);
        for (unsigned int b = 0; b < n_bodies; ++b)
          if (touches[b])
            redistribute(mass,
                         dofs,
                         b,
                         centres[b],
                         in_proportion,
                         body.communicator,
                         redistributed);
        if (is_positive_definite(redistributed, no_inertia, body.make_vector()))
          return redistributed;
      }
    throw InputError(
      "The mass cannot be redistributed: on this mesh so much "
      "of it sits on the contact boundary that the matrix "
      "that keeps mass, centre of mass and moments of inertia "
      "is not positive. Refine the mesh or take the "
      "consistent mass.");
  }


  template Matrix
  redistribute_mass(const Body<1> &, const Matrix &);
  template Matrix
  redistribute_mass(const Body<2> &, const Matrix &);
  template Matrix
  redistribute_mass(const Body<3> &, const Matrix &);
  template std::vector<std::array<double, n_mass_moments<1>>>
  mass_moments(const Body<1> &, const Matrix &);
  template std::vector<std::array<double, n_mass_moments<2>>>
  mass_moments(const Body<2> &, const Matrix &);
  template std::vector<std::array<double, n_mass_moments<3>>>
  mass_moments(const Body<3> &, const Matrix &);
} // namespace Ricochet
