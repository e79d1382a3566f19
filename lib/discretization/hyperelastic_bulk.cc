// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/parameter_file.h>
#include <base/vector_operations.h>
#include <discretization/hyperelastic_bulk.h>
#include <materials/gonzalez.h>
#include <solvers/matrix_entries.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Number of components of a symmetric tensor, and the pair of indices of
    /// each: those of deal.II's unrolled symmetric tensors.
    template <int dim>
    constexpr unsigned int n_components = dim *(dim + 1) / 2;

    template <int dim>
    constexpr std::array<std::array<unsigned int, 2>, n_components<dim>>
    component_indices()
    {
      if constexpr (dim == 2)
        return {{{{0, 0}}, {{1, 1}}, {{0, 1}}}};
      else
        return {{{{0, 0}}, {{1, 1}}, {{2, 2}}, {{0, 1}}, {{0, 2}}, {{1, 2}}}};
    }

    /// An element with a smaller det F counts as inverted: det C, its square,
    /// would drown in round-off.
    constexpr double flat = 1e-6;

    /// The derivatives of (F^T dF) : S with respect to the displacements of a
    /// node with the shape gradient @p gradient, per component of S: for each
    /// direction i and component (k, l), F_ik gradient_l (+ F_il gradient_k).
    template <int dim>
    void
    node_strains(const Tensor<2, dim, Lanes> &f,
                 const Tensor<1, dim, Lanes> &gradient,
                 Lanes                       *strains)
    {
      constexpr auto indices = component_indices<dim>();
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int c = 0; c < n_components<dim>; ++c)
          {
            const unsigned int k = indices[c][0], l = indices[c][1];
            strains[i * n_components<dim> + c] = k == l
              ? f[i][k] * gradient[k]
              : f[i][k] * gradient[l] + f[i][l] * gradient[k];
          }
    }
  } // namespace



  template <int dim>
  HyperelasticBulk<dim>::HyperelasticBulk(
    const Body<dim>                  &body,
    const std::vector<Material<dim>> &materials)
    : materials(materials)
    , communicator(body.communicator)
    , ghosted_old(body.make_ghosted_vector())
    , ghosted_new(body.make_ghosted_vector())
  {
    AssertThrow(std::any_of(materials.begin(),
                            materials.end(),
                            [](const Material<dim> &material) {
                              return material.hyperelastic != nullptr;
                            }),
                ExcMessage("No material is hyperelastic."));
    const FiniteElement<dim> &element = body.dof_handler().get_fe();

    // The gradients of linear simplices are constant: one point is enough.
    const bool one_point = element.degree == 1 &&
      body.dof_handler().get_triangulation().all_reference_cells_are_simplex();
    const Quadrature<dim> quadrature = one_point
      ? Quadrature<dim>(QGaussSimplex<dim>(1))
      : body.cell_quadrature();
    FEValues<dim>         fe_values(body.mapping(),
                            element,
                            quadrature,
                            update_gradients | update_JxW_values);
    n_points = quadrature.size();
    n_nodes  = element.n_dofs_per_cell() / dim;

    has_corners = element.degree == 1 && !one_point;

    const unsigned int n = dim * n_nodes;
    struct Cell
    {
      typename DoFHandler<dim>::active_cell_iterator iterator;
      unsigned int                                   part;
      std::vector<int>                               ghosted, owned;
    };
    std::vector<Cell>                    cells;
    std::vector<types::global_dof_index> indices(n);
    for (const auto &cell : body.dof_handler().active_cell_iterators())
      {
        if (cell->is_artificial() ||
            !materials[body.part(cell, materials.size())].hyperelastic)
          continue;
        cell->get_dof_indices(indices);
        bool touches_owned_rows = false;
        for (auto &index : indices)
          {
            index = body.system_index(index);
            touches_owned_rows =
              touches_owned_rows || body.owned_indices().is_element(index);
          }
        // A cell may have no row of the rank that it belongs to; its energy counts.
        if (!touches_owned_rows && !cell->is_locally_owned())
          continue;

        Cell own{cell, body.part(cell, materials.size()), {}, {}};
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int c = 0; c < dim; ++c)
            {
              const auto index =
                indices[element.component_to_system_index(c, a)];
              own.ghosted.push_back(ghosted_new.local_index(index));
              own.owned.push_back(
                body.owned_indices().is_element(index)
                  ? static_cast<int>(
                      body.owned_indices().index_within_set(index))
                  : -1);
            }
        cells.push_back(std::move(own));
      }
    // A batch has one material.
    std::stable_sort(cells.begin(),
                     cells.end(),
                     [](const Cell &a, const Cell &b) {
                       return a.part < b.part;
                     });
    for (const Cell &cell : cells)
      cell_centers.push_back(cell.iterator->center());

    constexpr unsigned int n_lanes = Lanes::size();
    for (unsigned int first = 0; first < cells.size(); ++n_batches)
      {
        unsigned int end = first + 1;
        while (end < cells.size() && end < first + n_lanes &&
               cells[end].part == cells[first].part)
          ++end;
        batch_part.push_back(cells[first].part);
        auto &numbers = batch_cells.emplace_back();
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          numbers[lane] = std::min(first + lane, end - 1);
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int lane = 0; lane < n_lanes; ++lane)
            {
              const Cell &cell = cells[numbers[lane]];
              ghosted_index.push_back(cell.ghosted[k]);
              owned_index.push_back(first + lane < end ? cell.owned[k] : -1);
            }
        if (has_corners)
          for (unsigned int v = 0; v < n_nodes; ++v)
            {
              Tensor<1, dim, Lanes> corner;
              for (unsigned int lane = 0; lane < n_lanes; ++lane)
                for (unsigned int c = 0; c < dim; ++c)
                  corner[c][lane] = cells[numbers[lane]].iterator->vertex(v)[c];
              corners.push_back(corner);
            }
        const std::size_t first_point = jxw.size();
        jxw.resize(first_point + n_points);
        owned_jxw.resize(first_point + n_points);
        shape_gradients.resize((first_point + n_points) * n_nodes);
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          {
            const Cell &cell = cells[numbers[lane]];
            fe_values.reinit(cell.iterator);
            for (unsigned int q = 0; q < n_points; ++q)
              {
                const std::size_t point = first_point + q;
                jxw[point][lane] = first + lane < end ? fe_values.JxW(q) : 0.;
                owned_jxw[point][lane] =
                  cell.iterator->is_locally_owned() ? jxw[point][lane] : 0.;
                for (unsigned int a = 0; a < n_nodes; ++a)
                  {
                    const Tensor<1, dim> gradient =
                      fe_values.shape_grad(element.component_to_system_index(0,
                                                                             a),
                                           q);
                    for (unsigned int d = 0; d < dim; ++d)
                      shape_gradients[point * n_nodes + a][d][lane] =
                        gradient[d];
                  }
              }
          }
        first = end;
      }

    cell_old.resize(n);
    cell_change.resize(n);
    cell_vector.resize(n);
    cell_matrix.resize(n * n);
    test_strains.resize(n * n_components<dim>);
    trial_strains.resize(n * n_components<dim>);
    stress_columns.resize(n * n_components<dim>);

    Matrix matrix;
    matrix.reinit(body.sparsity_pattern());
    find_matrix_entries(matrix);

    const Vector rest = body.make_vector();
    add_tangent(1., rest, matrix);
    scale = matrix.linfty_norm();

    // A strain is known to a rounding error of 1, so the ends of a cell to one of its
    // diameter.
    double              square = 0., energy_square = 0.;
    std::vector<double> diameter(body.owned_indices().n_elements(), 0.);
    for (const Cell &cell : cells)
      for (const int row : cell.owned)
        if (row >= 0)
          diameter[row] = std::max(diameter[row], cell.iterator->diameter());
    const MatrixEntries entries(matrix);
    for (unsigned int row = 0; row < entries.n_rows(); ++row)
      {
        double sum = 0.;
        for (int k = entries.begin[row]; k < entries.begin[row + 1]; ++k)
          sum += std::abs(entries.value[k]);
        const double force = sum * diameter[row];
        square += force * force;
        // Energy in the volume of the node, if all terms were as large as
        // Young's modulus; a row has some eight times that.
        const double energy = .125 * force * diameter[row];
        energy_square += energy * energy;
      }
    const auto total = [&](const double sum_of_squares) {
      return std::numeric_limits<double>::epsilon() *
        std::sqrt(Utilities::MPI::sum(sum_of_squares, communicator));
    };
    round_off    = total(square);
    energy_error = total(energy_square);
  }



  template <int dim>
  void
  HyperelasticBulk<dim>::find_matrix_entries(const Matrix &matrix)
  {
    const MatrixEntries    entries(matrix);
    constexpr unsigned int n_lanes = Lanes::size();
    const unsigned int     n       = dim * n_nodes;
    matrix_entry.reserve(n_batches * n * n * n_lanes);
    std::vector<int> column(n * n_lanes);
    for (unsigned int batch = 0; batch < n_batches; ++batch)
      {
        for (unsigned int k = 0; k < n * n_lanes; ++k)
          column[k] = entries.column_number(
            ghosted_new.index(ghosted_index[batch * n * n_lanes + k]));
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int k = 0; k < n * n_lanes; ++k)
            {
              const int row =
                owned_index[(batch * n + i) * n_lanes + k % n_lanes];
              if (row < 0)
                {
                  matrix_entry.push_back(-1);
                  continue;
                }
              matrix_entry.push_back(entries.find(row, column[k]));
              AssertThrow(matrix_entry.back() >= 0,
                          ExcMessage("The sparsity pattern has no such "
                                     "entry."));
            }
      }
  }



  template <int dim>
  void
  HyperelasticBulk<dim>::import_ghosts(const Vector &old_solution,
                                       const Vector &new_solution) const
  {
    ghosted_old.import(old_solution);
    ghosted_new.import(new_solution);
  }



  template <int dim>
  inline void
  HyperelasticBulk<dim>::gather(const unsigned int batch,
                                const unsigned int n_nodes) const
  {
    constexpr unsigned int n_lanes    = Lanes::size();
    const double          *old_values = ghosted_old.values();
    const double          *new_values = ghosted_new.values();
    const int *index = &ghosted_index[batch * n_nodes * dim * n_lanes];

    // Relative to the first node, since the gradients of all shape functions
    // sum up to zero: far from where it started, the displacement of a body is
    // much larger than its differences.
    for (unsigned int k = 0; k < n_nodes * dim; ++k)
      {
        Lanes value;
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          {
            const int i          = index[k * n_lanes + lane];
            value[lane]          = old_values[i];
            cell_change[k][lane] = new_values[i] - old_values[i];
          }
        cell_old[k] = value;
      }
    for (unsigned int k = n_nodes * dim; k-- > dim;)
      {
        cell_old[k] -= cell_old[k % dim];
        cell_change[k] -= cell_change[k % dim];
      }
  }



  template <int dim>
  inline void
  HyperelasticBulk<dim>::deformation(const Tensor<1, dim, Lanes> *gradients,
                                     const unsigned int           n_nodes,
                                     Gradient                    &old_f,
                                     Gradient &difference) const
  {
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          Lanes old_sum(i == d ? 1. : 0.), sum(0.);
          for (unsigned int a = 1; a < n_nodes; ++a)
            {
              old_sum += cell_old[a * dim + i] * gradients[a][d];
              sum += cell_change[a * dim + i] * gradients[a][d];
            }
          old_f[i][d]      = old_sum;
          difference[i][d] = sum;
        }
  }



  template <int dim>
  void
  HyperelasticBulk<dim>::find_strains(const Increment &increment,
                                      const Gradient  &old_f,
                                      const Gradient  &difference_f,
                                      Symmetric2      &old_c,
                                      Symmetric2      &change)
  {
    // Between two states C_new - C_old = 2 sym(F_mean^T (F_new - F_old)), without
    // cancellation.
    const Gradient f = old_f + Lanes(increment.strain) * difference_f;
    change = Symmetric2(Lanes(2.) * symmetrize(transpose(f) * difference_f));
    if (increment.strain == .5)
      old_c = Symmetric2(symmetrize(transpose(old_f) * old_f));
    else
      {
        const Gradient new_f = old_f + difference_f;
        old_c = Symmetric2(symmetrize(transpose(new_f) * new_f)) - change;
      }
  }



  template <int dim>
  Lanes
  HyperelasticBulk<dim>::mend(const unsigned int batch,
                              Gradient          &old_f,
                              Gradient          &difference) const
  {
    const Lanes det = determinant(Gradient(old_f + difference));
    if (!is_not_less_somewhere(Lanes(std::max(flat, smallest_determinant)),
                               det))
      return Lanes(1.);
    for (unsigned int lane = 0; lane < Lanes::size(); ++lane)
      if (!std::isnan(smallest_determinant) &&
          !(det[lane] >= smallest_determinant))
        {
          smallest_determinant = det[lane];
          worst_cell           = batch_cells[batch][lane];
        }
    Lanes exists(1.);
    bool  all_exist = true;
    for (unsigned int lane = 0; lane < Lanes::size(); ++lane)
      if (!(det[lane] > flat))
        {
          all_exist    = false;
          exists[lane] = 0.;
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int d = 0; d < dim; ++d)
              {
                old_f[i][d][lane]      = i == d ? 1. : 0.;
                difference[i][d][lane] = 0.;
              }
        }
    return all_exist ? Lanes(1.) : exists;
  }



  template <int dim>
  template <typename Action>
  void
  HyperelasticBulk<dim>::with_cell_size(const Action &action) const
  {
    constexpr unsigned int n_corners = 1 << dim;
    if (n_points == 1 && n_nodes == dim + 1)
      action(CellSize<1, dim + 1>());
    else if (n_points == n_corners && n_nodes == n_corners)
      action(CellSize<n_corners, n_corners>());
    else
      action(CellSize<0, 0>());
  }



  template <int dim>
  template <unsigned int n_points_of_cell,
            unsigned int n_nodes_of_cell,
            typename StressFunction>
  void
  HyperelasticBulk<dim>::add_forces(
    const CellSize<n_points_of_cell, n_nodes_of_cell> /*size*/,
    const Increment      &increment,
    const StressFunction &stress_function,
    double               *values) const
  {
    const unsigned int n_points =
      n_points_of_cell > 0 ? n_points_of_cell : this->n_points;
    const unsigned int n_nodes =
      n_nodes_of_cell > 0 ? n_nodes_of_cell : this->n_nodes;
    constexpr unsigned int n_lanes = Lanes::size();
    const unsigned int     n       = dim * n_nodes;
    Gradient               old_f, difference_f;
    Symmetric2             old_c, change, stress;
    for (unsigned int batch = 0; batch < n_batches; ++batch)
      {
        const Material<dim> &material = materials[batch_part[batch]];
        gather(batch, n_nodes);
        std::fill_n(cell_vector.begin(), n, Lanes(0.));
        for (unsigned int q = 0; q < n_points; ++q)
          {
            const Tensor<1, dim, Lanes> *gradients =
              &shape_gradients[(batch * n_points + q) * n_nodes];
            deformation(gradients, n_nodes, old_f, difference_f);
            const Lanes exists = mend(batch, old_f, difference_f);

            find_strains(increment, old_f, difference_f, old_c, change);
            stress_function(material, old_c, change, stress, nullptr);
            const Gradient test_f =
              old_f + Lanes(increment.test) * difference_f;
            const Lanes    weight = exists * jxw[batch * n_points + q];
            const Gradient first_piola_kirchhoff =
              weight * (test_f * Gradient(stress));
            for (unsigned int a = 0; a < n_nodes; ++a)
              {
                const Tensor<1, dim, Lanes> node_force =
                  first_piola_kirchhoff * gradients[a];
                for (unsigned int i = 0; i < dim; ++i)
                  cell_vector[a * dim + i] += node_force[i];
              }
          }
        const int *index = &owned_index[batch * n * n_lanes];
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int lane = 0; lane < n_lanes; ++lane)
            if (index[i * n_lanes + lane] >= 0)
              values[index[i * n_lanes + lane]] += cell_vector[i][lane];
      }
  }



  template <int dim>
  template <typename StressFunction>
  void
  HyperelasticBulk<dim>::assemble_force(const Increment      &increment,
                                        const StressFunction &stress_function,
                                        const Vector         &old_solution,
                                        const Vector         &new_solution,
                                        Vector               &force) const
  {
    import_ghosts(old_solution, new_solution);
    double *values = local_values(force);
    std::fill_n(values, force.locally_owned_size(), 0.);
    smallest_determinant = std::numeric_limits<double>::max();
    with_cell_size([&](const auto size) {
      add_forces(size, increment, stress_function, values);
    });
    if (!(smallest_determinant > flat) && force.locally_owned_size() > 0)
      values[0] = std::numeric_limits<double>::quiet_NaN();
  }



  template <int dim>
  template <unsigned int n_points_of_cell,
            unsigned int n_nodes_of_cell,
            typename StressFunction>
  void
  HyperelasticBulk<dim>::add_matrices(
    const CellSize<n_points_of_cell, n_nodes_of_cell> /*size*/,
    const double          factor,
    const Increment      &increment,
    const StressFunction &stress_function,
    double               *values) const
  {
    const unsigned int n_points =
      n_points_of_cell > 0 ? n_points_of_cell : this->n_points;
    const unsigned int n_nodes =
      n_nodes_of_cell > 0 ? n_nodes_of_cell : this->n_nodes;
    constexpr auto         indices = component_indices<dim>();
    constexpr unsigned int n_c     = n_components<dim>;
    constexpr unsigned int n_lanes = Lanes::size();
    const unsigned int     n       = dim * n_nodes;
    Gradient               old_f, difference_f;
    Symmetric2             old_c, change, stress;
    Symmetric4             stress_derivative;
    Lanes                  moduli[n_c][n_c];
    for (unsigned int batch = 0; batch < n_batches; ++batch)
      {
        const Material<dim> &material = materials[batch_part[batch]];
        gather(batch, n_nodes);
        std::fill_n(cell_matrix.begin(), n * n, Lanes(0.));
        for (unsigned int q = 0; q < n_points; ++q)
          {
            const Tensor<1, dim, Lanes> *gradients =
              &shape_gradients[(batch * n_points + q) * n_nodes];
            deformation(gradients, n_nodes, old_f, difference_f);
            find_strains(increment, old_f, difference_f, old_c, change);
            stress_function(material,
                            old_c,
                            change,
                            stress,
                            &stress_derivative);
            const Lanes weight = factor * jxw[batch * n_points + q];
            for (unsigned int c = 0; c < n_c; ++c)
              for (unsigned int d = 0; d < n_c; ++d)
                moduli[c][d] = 2. * weight *
                  stress_derivative[indices[c][0]][indices[c][1]][indices[d][0]]
                                   [indices[d][1]];

            // dC = F^T dF + dF^T F.
            const Gradient trial_f =
              old_f + Lanes(increment.trial) * difference_f;
            const Gradient test_f =
              old_f + Lanes(increment.test) * difference_f;
            for (unsigned int a = 0; a < n_nodes; ++a)
              {
                node_strains<dim>(test_f,
                                  gradients[a],
                                  &test_strains[a * dim * n_c]);
                node_strains<dim>(trial_f,
                                  gradients[a],
                                  &trial_strains[a * dim * n_c]);
              }
            for (unsigned int j = 0; j < n; ++j)
              for (unsigned int c = 0; c < n_c; ++c)
                {
                  Lanes sum(0.);
                  for (unsigned int d = 0; d < n_c; ++d)
                    sum += moduli[c][d] * trial_strains[j * n_c + d];
                  stress_columns[j * n_c + c] = sum;
                }
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int j = 0; j < n; ++j)
                {
                  Lanes sum = cell_matrix[i * n + j];
                  for (unsigned int c = 0; c < n_c; ++c)
                    sum +=
                      test_strains[i * n_c + c] * stress_columns[j * n_c + c];
                  cell_matrix[i * n + j] = sum;
                }

            // The test gradient changes too: the geometric part.
            for (unsigned int a = 0; a < n_nodes; ++a)
              {
                const Tensor<1, dim, Lanes> stressed_gradient =
                  increment.test * weight * (stress * gradients[a]);
                for (unsigned int b = 0; b < n_nodes; ++b)
                  {
                    const Lanes geometric = stressed_gradient * gradients[b];
                    for (unsigned int i = 0; i < dim; ++i)
                      cell_matrix[(a * dim + i) * n + b * dim + i] += geometric;
                  }
              }
          }
        const int *entry = &matrix_entry[batch * n * n * n_lanes];
        for (unsigned int k = 0; k < n * n; ++k)
          for (unsigned int lane = 0; lane < n_lanes; ++lane)
            if (entry[k * n_lanes + lane] >= 0)
              values[entry[k * n_lanes + lane]] += cell_matrix[k][lane];
      }
  }



  template <int dim>
  template <typename StressFunction>
  void
  HyperelasticBulk<dim>::add_matrix(const double          factor,
                                    const Increment      &increment,
                                    const StressFunction &stress_function,
                                    const Vector         &old_solution,
                                    const Vector         &new_solution,
                                    Matrix               &tangent) const
  {
    import_ghosts(old_solution, new_solution);
    double *const values = entry_values(tangent);

    with_cell_size([&](const auto size) {
      add_matrices(size, factor, increment, stress_function, values);
    });
  }



  template <int dim>
  template <typename Density>
  std::vector<double>
  HyperelasticBulk<dim>::integrate(const Density &density,
                                   const Vector  &old_solution,
                                   const Vector  &new_solution) const
  {
    import_ghosts(old_solution, new_solution);
    std::vector<double> my_sums(materials.size(), 0.), sums(materials.size());
    Gradient            old_f, difference_f;
    for (unsigned int batch = 0; batch < n_batches; ++batch)
      {
        gather(batch, n_nodes);
        for (unsigned int q = 0; q < n_points; ++q)
          {
            deformation(&shape_gradients[(batch * n_points + q) * n_nodes],
                        n_nodes,
                        old_f,
                        difference_f);
            const Gradient mean_f = old_f + Lanes(.5) * difference_f;
            const Lanes    part   = owned_jxw[batch * n_points + q] *
              density(materials[batch_part[batch]],
                      Symmetric2(symmetrize(transpose(old_f) * old_f)),
                      Symmetric2(Lanes(2.) *
                                 symmetrize(transpose(mean_f) * difference_f)));
            for (unsigned int lane = 0; lane < Lanes::size(); ++lane)
              my_sums[batch_part[batch]] += part[lane];
          }
      }
    Utilities::MPI::sum(my_sums, communicator, sums);
    return sums;
  }



  template <int dim>
  auto
  HyperelasticBulk<dim>::collocation_stress()
  {
    return [](const Material<dim> &material,
              const Symmetric2    &old_c,
              const Symmetric2    &difference,
              Symmetric2          &stress,
              Symmetric4          *tangent) {
      if (tangent)
        {
          material.hyperelastic->template derivatives<Lanes>(old_c + difference,
                                                             stress,
                                                             *tangent);
          *tangent *= Lanes(2.);
        }
      else
        stress =
          material.hyperelastic->template derivative<Lanes>(old_c + difference);
      stress *= Lanes(2.);
    };
  }



  template <int dim>
  auto
  HyperelasticBulk<dim>::step_stress(const double time_step)
  {
    return [time_step](const Material<dim> &material,
                       const Symmetric2    &old_c,
                       const Symmetric2    &difference,
                       Symmetric2          &stress,
                       Symmetric4          *tangent) {
      if (tangent)
        GonzalezStress<dim>::stress_and_tangent(*material.hyperelastic,
                                                old_c,
                                                difference,
                                                stress,
                                                *tangent);
      else
        stress = material.hyperelastic->step_stress(old_c, difference);
      if (!material.viscosity.is_active())
        return;
      ViscousTangent<dim, Lanes> of_viscosity;
      stress += viscous_stress(*material.hyperelastic,
                               material.viscosity,
                               Symmetric2(old_c + Lanes(.5) * difference),
                               difference,
                               time_step,
                               tangent ? &of_viscosity : nullptr);
      if (tangent)
        *tangent += of_viscosity.with_change + Lanes(.5) * of_viscosity.with_c;
    };
  }



  template <int dim>
  auto
  HyperelasticBulk<dim>::rate_stress(const double rate_time, const bool with_c)
  {
    return [rate_time, with_c](const Material<dim> &material,
                               const Symmetric2    &old_c,
                               const Symmetric2    &change,
                               Symmetric2          &stress,
                               Symmetric4          *tangent) {
      stress = Symmetric2();
      if (tangent)
        *tangent = Symmetric4();
      if (!material.viscosity.is_active())
        return;
      ViscousTangent<dim, Lanes> of_viscosity;
      const Symmetric2           viscous =
        viscous_stress(*material.hyperelastic,
                       material.viscosity,
                       Symmetric2(old_c + change),
                       change,
                       rate_time,
                       tangent ? &of_viscosity : nullptr);
      if (tangent)
        *tangent = with_c ? of_viscosity.with_c : of_viscosity.with_change;
      if (!with_c)
        stress = viscous;
    };
  }



  template <int dim>
  void
  HyperelasticBulk<dim>::force(const Vector &solution, Vector &result) const
  {
    assemble_force(Increment::none(),
                   collocation_stress(),
                   solution,
                   solution,
                   result);
  }



  template <int dim>
  void
  HyperelasticBulk<dim>::add_tangent(const double  factor,
                                     const Vector &solution,
                                     Matrix       &tangent) const
  {
    add_matrix(factor,
               Increment::none(),
               collocation_stress(),
               solution,
               solution,
               tangent);
  }



  template <int dim>
  void
  HyperelasticBulk<dim>::step_force(const Vector &old_solution,
                                    const Vector &new_solution,
                                    const double  time_step,
                                    Vector       &result) const
  {
    assemble_force(Increment::of_step(),
                   step_stress(time_step),
                   old_solution,
                   new_solution,
                   result);
  }



  template <int dim>
  void
  HyperelasticBulk<dim>::add_step_tangent(const Vector &old_solution,
                                          const Vector &new_solution,
                                          const double  time_step,
                                          Matrix       &tangent) const
  {
    add_matrix(1.,
               Increment::of_step(),
               step_stress(time_step),
               old_solution,
               new_solution,
               tangent);
  }



  template <int dim>
  bool
  HyperelasticBulk<dim>::is_viscous() const
  {
    return std::any_of(materials.begin(),
                       materials.end(),
                       [](const Material<dim> &material) {
                         return material.viscosity.is_active();
                       });
  }



  template <int dim>
  void
  HyperelasticBulk<dim>::viscous_force(const Vector &rate_origin,
                                       const Vector &solution,
                                       const double  rate_time,
                                       Vector       &result) const
  {
    assemble_force(Increment::of_rate(),
                   rate_stress(rate_time, false),
                   rate_origin,
                   solution,
                   result);
  }



  template <int dim>
  void
  HyperelasticBulk<dim>::add_viscous_tangent(const double  factor,
                                             const Vector &rate_origin,
                                             const Vector &solution,
                                             const double  rate_time,
                                             Matrix       &tangent) const
  {
    // The stress depends on the rate of C and, with Pioletti's law, on C itself; their
    // trial gradients differ.
    const auto add = [&](const Increment &increment, const bool with_c) {
      add_matrix(factor,
                 increment,
                 rate_stress(rate_time, with_c),
                 rate_origin,
                 solution,
                 tangent);
    };
    add(Increment::of_rate(), false);
    if (std::any_of(materials.begin(),
                    materials.end(),
                    [](const Material<dim> &material) {
                      return material.viscosity.law == Viscosity::Law::pioletti;
                    }))
      add(Increment::strain_of_rate(), true);
  }



  template <int dim>
  double
  HyperelasticBulk<dim>::energy(const Vector &solution) const
  {
    const std::vector<double> energies = energies_of_parts(solution);
    return std::accumulate(energies.begin(), energies.end(), 0.);
  }



  template <int dim>
  std::vector<double>
  HyperelasticBulk<dim>::energies_of_parts(const Vector &solution) const
  {
    return integrate(
      [](const Material<dim> &material,
         const Symmetric2    &c,
         const Symmetric2 &) {
        return material.hyperelastic->template energy<Lanes>(c);
      },
      solution,
      solution);
  }



  template <int dim>
  double
  HyperelasticBulk<dim>::viscous_dissipation(const Vector &old_solution,
                                             const Vector &new_solution,
                                             const double  time_step) const
  {
    if (!is_viscous())
      return 0.;
    const std::vector<double> sums = integrate(
      [time_step](const Material<dim> &material,
                  const Symmetric2    &old_c,
                  const Symmetric2    &difference) {
        if (!material.viscosity.is_active())
          return Lanes(0.);
        return Lanes(.5) *
          (viscous_stress(*material.hyperelastic,
                          material.viscosity,
                          Symmetric2(old_c + Lanes(.5) * difference),
                          difference,
                          time_step) *
           difference);
      },
      old_solution,
      new_solution);
    return std::accumulate(sums.begin(), sums.end(), 0.);
  }



  template <int dim>
  std::string
  HyperelasticBulk<dim>::failure() const
  {
    // The worst element of all ranks; all of them get the same text.
    std::vector<double> mine = {std::numeric_limits<double>::max()};
    if (n_batches > 0)
      mine[0] = std::isnan(smallest_determinant)
        ? -std::numeric_limits<double>::max()
        : smallest_determinant;
    for (unsigned int d = 0; d < dim; ++d)
      mine.push_back(n_batches > 0 ? cell_centers[worst_cell][d] : 0.);
    const auto all   = Utilities::MPI::all_gather(communicator, mine);
    const auto worst = *std::min_element(all.begin(), all.end());
    if (worst[0] > flat)
      return {};
    std::string text =
      "An element is flat or turned inside out: det F = " + to_text(worst[0]) +
      " in the cell around (";
    for (unsigned int d = 0; d < dim; ++d)
      text += (d == 0 ? "" : ", ") + to_text(worst[d + 1]);
    return text + ") of the undeformed body.";
  }


  template <int dim>
  std::string
  HyperelasticBulk<dim>::inverted_corner(const Vector &solution) const
  {
    if (!has_corners)
      return {};
    import_ghosts(solution, solution);
    // The place of an inverted corner in the undeformed body, on this rank.
    std::vector<Point<dim>> places;
    for (unsigned int batch = 0; batch < n_batches && places.empty(); ++batch)
      {
        gather(batch, n_nodes);
        const auto *const corner = &corners[batch * n_nodes];
        for (unsigned int v = 0; v < n_nodes; ++v)
          {
            // The edges along the axes of the reference cell, which lead from this corner
            // to its neighbours or from those to this one.
            Tensor<2, dim, Lanes> edges;
            for (unsigned int d = 0; d < dim; ++d)
              {
                const unsigned int begin = v & ~(1U << d), end = v | (1U << d);
                for (unsigned int c = 0; c < dim; ++c)
                  {
                    edges[d][c] = corner[end][c] - corner[begin][c];
                    // gather() leaves displacements relative to the first node.
                    edges[d][c] += cell_old[end * dim + c];
                    if (begin > 0)
                      edges[d][c] -= cell_old[begin * dim + c];
                  }
              }
            const Lanes volume = determinant(edges);
            for (unsigned int lane = 0; lane < Lanes::size(); ++lane)
              if (volume[lane] <= 0. && places.empty())
                {
                  Point<dim> &place = places.emplace_back();
                  for (unsigned int c = 0; c < dim; ++c)
                    place[c] = corner[v][c][lane];
                }
          }
      }
    std::string text;
    for (const auto &of_rank : Utilities::MPI::all_gather(communicator, places))
      if (text.empty() && !of_rank.empty())
        for (unsigned int c = 0; c < dim; ++c)
          text += (c == 0 ? "(" : ", ") + to_text(of_rank.front()[c]);
    return text.empty() ? text : text + ") of the undeformed body";
  }


  template class HyperelasticBulk<2>;
  template class HyperelasticBulk<3>;
} // namespace Ricochet
