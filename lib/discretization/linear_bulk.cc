// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <discretization/linear_bulk.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <functional>
#include <numeric>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// The cell loop of all constant matrices, in either storage format.
    /// @p integrand gets the FEValues and a quadrature point and adds to the cell
    /// matrix.
    template <int dim>
    BodyMatrix
    assemble(const Body<dim>                                 &body,
             const MatrixStorage                              storage,
             const bool                                       isotropic,
             const UpdateFlags                                flags,
             const std::function<void(const FEValues<dim> &,
                                      const unsigned int,
                                      FullMatrix<double> &)> &integrand)
    {
      FEValues<dim>                        fe_values(body.mapping(),
                              body.dof_handler().get_fe(),
                              body.cell_quadrature(),
                              flags | update_JxW_values);
      const unsigned int                   n = fe_values.dofs_per_cell;
      FullMatrix<double>                   cell_matrix(n, n);
      std::vector<types::global_dof_index> indices(n);
      std::vector<unsigned int>            numbers(n);
      Matrix                               matrix;
      std::unique_ptr<BlockMatrix<double>> blocks;
      if (storage == MatrixStorage::blocks)
        blocks = std::make_unique<BlockMatrix<double>>(body.block_pattern(),
                                                       isotropic);
      else
        matrix.reinit(isotropic ? body.component_sparsity_pattern()
                                : body.sparsity_pattern());
      // Entries of other ranks are sent there; blocks have to be found here, from all
      // cells that touch own nodes.
      for (const auto &cell : body.dof_handler().active_cell_iterators())
        if (blocks ? !cell->is_artificial() : cell->is_locally_owned())
          {
            fe_values.reinit(cell);
            cell_matrix = 0.;
            for (const unsigned int q : fe_values.quadrature_point_indices())
              integrand(fe_values, q, cell_matrix);
            cell->get_dof_indices(indices);
            for (types::global_dof_index &index : indices)
              index = body.system_index(index);
            if (blocks)
              {
                const auto &partitioner = *body.block_pattern()->partitioner;
                for (unsigned int i = 0; i < n; ++i)
                  numbers[i] = partitioner.global_to_local(indices[i]);
                blocks->add_cell(numbers, cell_matrix);
              }
            else
              // Zeros are not in every pattern.
              matrix.add(indices, cell_matrix, /* elide_zero_values */ true);
          }
      if (blocks)
        return BodyMatrix(std::move(blocks));
      matrix.compress(VectorOperation::add);
      return BodyMatrix(std::move(matrix));
    }

    /// The number, of @p n_parts, of the part that the cell of @p fe_values
    /// belongs to.
    template <int dim>
    unsigned int
    part_of(const FEValues<dim> &fe_values, const unsigned int n_parts)
    {
      return n_parts > 1 ? fe_values.get_cell()->material_id() : 0;
    }

    /// The matrix of stress(strain(u)) : strain(v), with the law of each part.
    template <int dim>
    BodyMatrix
    assemble_strain_matrix(const Body<dim>                  &body,
                           const std::vector<LinearElastic> &laws,
                           const MatrixStorage               storage)
    {
      const FEValuesExtractors::Vector     displacement(0);
      std::vector<SymmetricTensor<2, dim>> strains(
        body.dof_handler().get_fe().n_dofs_per_cell());
      return assemble<dim>(
        body,
        storage,
        /* isotropic = */ false,
        update_gradients,
        [&](const FEValues<dim> &fe_values,
            const unsigned int   q,
            FullMatrix<double>  &cell_matrix) {
          for (const unsigned int i : fe_values.dof_indices())
            strains[i] = fe_values[displacement].symmetric_gradient(i, q);
          const LinearElastic &law = laws[part_of(fe_values, laws.size())];
          for (const unsigned int j : fe_values.dof_indices())
            {
              const SymmetricTensor<2, dim> stress = law.stress(strains[j]);
              for (const unsigned int i : fe_values.dof_indices())
                cell_matrix(i, j) += stress * strains[i] * fe_values.JxW(q);
            }
        });
    }
  } // namespace



  template <int dim>
  LinearBulk<dim>::LinearBulk(const Body<dim>                  &body,
                              const std::vector<Material<dim>> &materials,
                              const MatrixStorage               storage)
    : has_viscosity(std::any_of(materials.begin(),
                                materials.end(),
                                [](const Material<dim> &material) {
                                  return material.viscosity.is_active();
                                }))
    , communicator(body.communicator)
    , n_parts(materials.size())
    , work(body.make_vector())
    , product(body.make_vector())
  {
    std::vector<unsigned int>       group(body.owned_indices().n_elements(),
                                    n_parts * dim);
    const std::vector<unsigned int> parts   = body.parts_of_unknowns(n_parts);
    const FiniteElement<dim>       &element = body.dof_handler().get_fe();
    std::vector<types::global_dof_index> indices(element.n_dofs_per_cell());
    // Connected parts, those with common nodes, move as one body: their
    // translations must not be subtracted separately.
    std::vector<unsigned int> my_links(n_parts * n_parts, 0), links;
    for (const auto &cell : body.dof_handler().active_cell_iterators())
      if (!cell->is_artificial())
        {
          cell->get_dof_indices(indices);
          for (unsigned int i = 0; i < indices.size(); ++i)
            {
              const auto index = body.system_index(indices[i]);
              if (!body.owned_indices().is_element(index))
                continue;
              const auto own = body.owned_indices().index_within_set(index);
              group[own] =
                parts[own] * dim + element.system_to_component_index(i).first;
              if (n_parts > 1)
                my_links[parts[own] * n_parts + cell->material_id()] = 1;
            }
        }
    links.resize(my_links.size());
    Utilities::MPI::max(my_links, communicator, links);
    // Each part has the number of the first one that it is connected with.
    std::vector<unsigned int> first(n_parts);
    std::iota(first.begin(), first.end(), 0U);
    for (unsigned int p = 0; p < n_parts; ++p)
      for (unsigned int q = 0; q < n_parts; ++q)
        if (links[p * n_parts + q] > 0 && first[p] != first[q])
          {
            const auto [low, high] = std::minmax({first[p], first[q]});
            std::replace(first.begin(), first.end(), high, low);
          }
    for (unsigned int &one : group)
      if (one < n_parts * dim)
        one = first[one / dim] * dim + one % dim;
    make_runs(group);

    // W_v = eta/2 tr(strain_rate^2): the viscous stress is eta times the strain rate. With
    // the elasticity tensor it is tau = eta / (2 mu) times the elastic one of that rate.
    std::vector<LinearElastic> laws, viscosities;
    for (const Material<dim> &material : materials)
      {
        AssertThrow(material.linear,
                    ExcMessage("The material is not linear elastic."));
        const Viscosity::Law law = material.viscosity.law;
        AssertThrow(law == Viscosity::Law::none ||
                      law == Viscosity::Law::linear ||
                      law == Viscosity::Law::kelvin_voigt,
                    ExcMessage("A linear body has linear viscosity."));
        laws.push_back(*material.linear);
        const double mu =
          material.viscosity.is_active() ? .5 * material.viscosity.eta : 0.;
        viscosities.push_back({law == Viscosity::Law::kelvin_voigt
                                 ? mu / laws.back().mu * laws.back().lambda
                                 : 0.,
                               mu});
      }
    stiffness = assemble_strain_matrix(body, laws, storage);
    scale     = stiffness.linfty_norm();
    if (has_viscosity)
      viscosity_matrix = assemble_strain_matrix(body, viscosities, storage);
  }



  template <int dim>
  void
  LinearBulk<dim>::force(const Vector &solution, Vector &force) const
  {
    copy_values(solution, work);
    remove_translation();
    stiffness.vmult(force, work);
  }



  template <int dim>
  MatrixSum
  LinearBulk<dim>::tangent_terms(const double factor) const
  {
    return {{factor, &stiffness}};
  }



  template <int dim>
  void
  LinearBulk<dim>::step_force(const Vector &old_solution,
                              const Vector &new_solution,
                              const double  time_step,
                              Vector       &force) const
  {
    entries(work) = .5 * (entries(old_solution) + entries(new_solution));
    remove_translation();
    stiffness.vmult(force, work);
    if (has_viscosity)
      {
        apply_viscosity(old_solution, new_solution);
        force.add(1. / time_step, product);
      }
  }



  template <int dim>
  void
  LinearBulk<dim>::apply_viscosity(const Vector &begin, const Vector &end) const
  {
    copy_values(end, work);
    work -= begin;
    viscosity_matrix.vmult(product, work);
  }



  template <int dim>
  void
  LinearBulk<dim>::viscous_force(const Vector &rate_origin,
                                 const Vector &solution,
                                 const double  rate_time,
                                 Vector       &result) const
  {
    apply_viscosity(rate_origin, solution);
    result.equ(1. / rate_time, product);
  }



  template <int dim>
  MatrixSum
  LinearBulk<dim>::viscous_tangent_terms(const double factor,
                                         const double rate_time) const
  {
    return {{factor / rate_time, &viscosity_matrix}};
  }



  template <int dim>
  MatrixSum
  LinearBulk<dim>::step_tangent_terms(const double time_step) const
  {
    MatrixSum terms{{.5, &stiffness}};
    if (has_viscosity)
      for (const MatrixTerm &term : viscous_tangent_terms(1., time_step))
        terms.push_back(term);
    return terms;
  }



  template <int dim>
  void
  LinearBulk<dim>::make_runs(const std::vector<unsigned int> &group)
  {
    group_sizes.assign(n_parts * dim, 0.);
    for (unsigned int i = 0; i < group.size(); ++i)
      {
        const unsigned int part = group[i] / dim, component = group[i] % dim;
        if (part == n_parts)
          continue;
        group_sizes[group[i]] += 1.;
        if (runs.empty() || runs.back().end != i || runs.back().part != part ||
            component !=
              (runs.back().first_component + i - runs.back().begin) % dim)
          runs.push_back({part, component, i, i});
        runs.back().end = i + 1;
      }
    Utilities::MPI::sum(group_sizes, communicator, group_sizes);
  }



  template <int dim>
  void
  LinearBulk<dim>::remove_translation() const
  {
    // Several nodes at once.
    constexpr unsigned int width = 4 * dim;
    using Lanes                  = Eigen::Array<double, width, 1>;
    double *const       values   = local_values(work);
    std::vector<double> means(group_sizes.size(), 0.);
    const auto          group_of = [](const Run &run, const unsigned int i) {
      return run.part * dim + (run.first_component + i) % dim;
    };
    for (const Run &run : runs)
      {
        Lanes        sums = Lanes::Zero();
        unsigned int i    = run.begin;
        for (; i + width <= run.end; i += width)
          sums += Eigen::Map<const Lanes>(values + i);
        for (unsigned int k = 0; k < width; ++k)
          means[group_of(run, k)] += sums[k];
        for (; i < run.end; ++i)
          means[group_of(run, i - run.begin)] += values[i];
      }
    Utilities::MPI::sum(means, communicator, means);
    for (unsigned int g = 0; g < means.size(); ++g)
      means[g] /= std::max(1., group_sizes[g]);
    for (const Run &run : runs)
      {
        Lanes mean;
        for (unsigned int k = 0; k < width; ++k)
          mean[k] = means[group_of(run, k)];
        unsigned int i = run.begin;
        for (; i + width <= run.end; i += width)
          Eigen::Map<Lanes>(values + i) -= mean;
        for (; i < run.end; ++i)
          values[i] -= mean[(i - run.begin) % width];
      }
  }



  template <int dim>
  double
  LinearBulk<dim>::energy(const Vector &solution) const
  {
    const std::vector<double> energies = energies_of_parts(solution);
    return std::accumulate(energies.begin(), energies.end(), 0.);
  }



  template <int dim>
  std::vector<double>
  LinearBulk<dim>::energies_of_parts(const Vector &solution) const
  {
    // Displacements without the translation are left in #work.
    force(solution, product);
    std::vector<double> energies(n_parts, 0.);
    for (const Run &run : runs)
      energies[run.part] += .5 *
        entries(product)
          .segment(run.begin, run.end - run.begin)
          .dot(entries(work).segment(run.begin, run.end - run.begin));
    Utilities::MPI::sum(energies, communicator, energies);
    return energies;
  }



  template <int dim>
  double
  LinearBulk<dim>::viscous_dissipation(const Vector &old_solution,
                                       const Vector &new_solution,
                                       const double  time_step) const
  {
    if (!has_viscosity)
      return 0.;
    apply_viscosity(old_solution, new_solution);
    return (product * work) / time_step;
  }



  template <int dim>
  BodyMatrix
  assemble_mass_matrix(const Body<dim>           &body,
                       const std::vector<double> &densities,
                       const MatrixStorage        storage)
  {
    // Components do not couple.
    const FiniteElement<dim> &element = body.dof_handler().get_fe();
    return assemble<dim>(
      body,
      storage,
      /* isotropic = */ true,
      update_values,
      [&](const FEValues<dim> &fe_values,
          const unsigned int   q,
          FullMatrix<double>  &cell_matrix) {
        const double density = densities[part_of(fe_values, densities.size())];
        for (const unsigned int i : fe_values.dof_indices())
          for (const unsigned int j : fe_values.dof_indices())
            if (element.system_to_component_index(i).first ==
                element.system_to_component_index(j).first)
              cell_matrix(i, j) += density * fe_values.shape_value(i, q) *
                fe_values.shape_value(j, q) * fe_values.JxW(q);
      });
  }


  template class LinearBulk<1>;
  template class LinearBulk<2>;
  template class LinearBulk<3>;
  template BodyMatrix
  assemble_mass_matrix(const Body<1> &,
                       const std::vector<double> &,
                       const MatrixStorage);
  template BodyMatrix
  assemble_mass_matrix(const Body<2> &,
                       const std::vector<double> &,
                       const MatrixStorage);
  template BodyMatrix
  assemble_mass_matrix(const Body<3> &,
                       const std::vector<double> &,
                       const MatrixStorage);
} // namespace Ricochet
