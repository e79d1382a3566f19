// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <output/make_folder.h>
#include <output/vtu_series.h>

#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/data_postprocessor.h>

#include <filesystem>
#include <limits>
#include <sstream>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// The material of the cell in which @p inputs are.
    template <int dim, typename Inputs>
    const Material<dim> &
    material_at(const Inputs                     &inputs,
                const std::vector<Material<dim>> &materials)
    {
      return materials.size() == 1
        ? materials[0]
        : materials[inputs.template get_cell<dim>()->material_id()];
    }

    template <int dim>
    class StressPostprocessor : public DataPostprocessorTensor<dim>
    {
    public:
      explicit StressPostprocessor(const std::vector<Material<dim>> &materials)
        : DataPostprocessorTensor<dim>("stress", update_gradients)
        , materials(materials)
      {}

      void
      evaluate_vector_field(
        const DataPostprocessorInputs::Vector<dim> &inputs,
        std::vector<dealii::Vector<double>>        &stresses) const override
      {
        for (unsigned int p = 0; p < stresses.size(); ++p)
          {
            Tensor<2, dim> gradient;
            for (unsigned int i = 0; i < dim; ++i)
              gradient[i] = inputs.solution_gradients[p][i];
            const SymmetricTensor<2, dim> stress =
              material_at(inputs, materials).cauchy_stress(gradient);
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                stresses[p][Tensor<2, dim>::component_to_unrolled_index(
                  TableIndices<2>(i, j))] = stress[i][j];
          }
      }

      /// In 1D deal.II takes a field of one component for a scalar.
      void
      evaluate_scalar_field(
        const DataPostprocessorInputs::Scalar<dim> &inputs,
        std::vector<dealii::Vector<double>>        &stresses) const override
      {
        for (unsigned int p = 0; p < stresses.size(); ++p)
          {
            Tensor<2, dim> gradient;
            gradient[0] = inputs.solution_gradients[p];
            stresses[p][0] =
              material_at(inputs, materials).cauchy_stress(gradient)[0][0];
          }
      }

    private:
      const std::vector<Material<dim>> materials;
    };

    template <int dim>
    class VonMises : public DataPostprocessorScalar<dim>
    {
    public:
      explicit VonMises(const std::vector<Material<dim>> &materials)
        : DataPostprocessorScalar<dim>("von_mises", update_gradients)
        , materials(materials)
      {}

      void
      evaluate_vector_field(
        const DataPostprocessorInputs::Vector<dim> &inputs,
        std::vector<dealii::Vector<double>>        &values) const override
      {
        for (unsigned int p = 0; p < values.size(); ++p)
          {
            Tensor<2, dim> gradient;
            for (unsigned int i = 0; i < dim; ++i)
              gradient[i] = inputs.solution_gradients[p][i];
            values[p][0] = material_at(inputs, materials).von_mises(gradient);
          }
      }

    private:
      const std::vector<Material<dim>> materials;
    };

    /// The components of the Cauchy stress one by one, as deal.II's HDF5 files have no tensors.
    template <int dim>
    class StressComponents : public DataPostprocessor<dim>
    {
    public:
      explicit StressComponents(const std::vector<Material<dim>> &materials)
        : tensor(materials)
      {}

      std::vector<std::string>
      get_names() const override
      {
        std::vector<std::string> names;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = i; j < dim; ++j)
            names.push_back(std::string("stress_") + "xyz"[i] + "xyz"[j]);
        return names;
      }

      std::vector<DataComponentInterpretation::DataComponentInterpretation>
      get_data_component_interpretation() const override
      {
        return {SymmetricTensor<2, dim>::n_independent_components,
                DataComponentInterpretation::component_is_scalar};
      }

      UpdateFlags
      get_needed_update_flags() const override
      {
        return tensor.get_needed_update_flags();
      }

      void
      evaluate_vector_field(
        const DataPostprocessorInputs::Vector<dim> &inputs,
        std::vector<dealii::Vector<double>>        &stresses) const override
      {
        std::vector<dealii::Vector<double>> whole(
          stresses.size(),
          dealii::Vector<double>(Tensor<2, dim>::n_independent_components));
        tensor.evaluate_vector_field(inputs, whole);
        for (unsigned int p = 0; p < stresses.size(); ++p)
          {
            unsigned int k = 0;
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = i; j < dim; ++j)
                stresses[p][k++] = whole[p][i * dim + j];
          }
      }

      void
      evaluate_scalar_field(
        const DataPostprocessorInputs::Scalar<dim> &inputs,
        std::vector<dealii::Vector<double>>        &stresses) const override
      {
        tensor.evaluate_scalar_field(inputs, stresses);
      }

    private:
      const StressPostprocessor<dim> tensor;
    };

    /// The distance of each point to the nearest obstacle.
    template <int dim>
    class Gap : public DataPostprocessorScalar<dim>
    {
    public:
      /// @param time s
      Gap(const Obstacles &obstacles, const double time)
        : DataPostprocessorScalar<dim>("gap",
                                       update_values | update_quadrature_points)
        , obstacles(obstacles)
        , time(time)
      {}

      void
      evaluate_vector_field(
        const DataPostprocessorInputs::Vector<dim> &inputs,
        std::vector<dealii::Vector<double>>        &gaps) const override
      {
        for (unsigned int p = 0; p < gaps.size(); ++p)
          {
            Point<dim> position = inputs.evaluation_points[p];
            for (unsigned int i = 0; i < dim; ++i)
              position[i] += inputs.solution_values[p][i];
            gaps[p][0] = nearest(position);
          }
      }

      /// In 1D deal.II takes a field of one component for a scalar.
      void
      evaluate_scalar_field(
        const DataPostprocessorInputs::Scalar<dim> &inputs,
        std::vector<dealii::Vector<double>>        &gaps) const override
      {
        for (unsigned int p = 0; p < gaps.size(); ++p)
          {
            Point<dim> position = inputs.evaluation_points[p];
            position[0] += inputs.solution_values[p];
            gaps[p][0] = nearest(position);
          }
      }

    private:
      double
      nearest(const Point<dim> &position) const
      {
        double gap = std::numeric_limits<double>::max();
        for (const auto &obstacle : obstacles)
          gap =
            std::min(gap, obstacle.second->gap(in_space<dim>(position), time));
        return gap;
      }

      const Obstacles obstacles;
      const double    time;
    };

    /// Output of a scalar that is stored in the first component of a vector
    /// field.
    template <int dim>
    class FirstComponent : public DataPostprocessorScalar<dim>
    {
    public:
      explicit FirstComponent(const std::string &name)
        : DataPostprocessorScalar<dim>(name, update_values)
      {}

      void
      evaluate_vector_field(
        const DataPostprocessorInputs::Vector<dim> &inputs,
        std::vector<dealii::Vector<double>>        &values) const override
      {
        for (unsigned int p = 0; p < values.size(); ++p)
          values[p][0] = inputs.solution_values[p][0];
      }

      void
      evaluate_scalar_field(
        const DataPostprocessorInputs::Scalar<dim> &inputs,
        std::vector<dealii::Vector<double>>        &values) const override
      {
        for (unsigned int p = 0; p < values.size(); ++p)
          values[p][0] = inputs.solution_values[p];
      }
    };

    /// Patches of this rank without header and footer.
    template <int dim>
    class PieceOfFile : public DataOut<dim>
    {
    public:
      std::string
      text(const DataOutBase::VtkFlags &flags, const bool may_be_empty) const
      {
        std::ostringstream text;
        if (!may_be_empty || !this->get_patches().empty())
          DataOutBase::write_vtu_main(this->get_patches(),
                                      this->get_dataset_names(),
                                      this->get_nonscalar_data_ranges(),
                                      flags,
                                      text);
        return text.str();
      }
    };

    /// @throws ComputationError when the disk is full.
    template <int dim>
    void
    write_hdf5(const PieceOfFile<dim> &data_out,
               const Body<dim>        &body,
               const RunFolder        &folder,
               XdmfList               &list,
               const unsigned int      step,
               const double            time)
    {
      const std::string name = XdmfList::file_of(step),
                        file = folder.file(name);
      // Points of different cells stay apart: so do bodies that touch each other, and stresses.
      DataOutBase::DataOutFilter filter(
        DataOutBase::DataOutFilterFlags(/* filter duplicates */ false,
                                        /* for XDMF */ true));
      std::string entry;
      try
        {
          data_out.write_filtered_data(filter);
          data_out.write_hdf5_parallel(filter,
                                       file + unfinished,
                                       folder.communicator);
          const XDMFEntry xdmf =
            data_out.create_xdmf_entry(filter, name, time, folder.communicator);
#if DEAL_II_VERSION_GTE(9, 5, 0)
          entry = xdmf.get_xdmf_content(3);
#else
          const auto types =
            body.dof_handler().get_triangulation().get_reference_cells();
          entry = xdmf.get_xdmf_content(3, types.front());
#endif
        }
      catch (const ExceptionBase &)
        {
          throw ComputationError("The file '" + file + "' cannot be written.");
        }
      on_first_rank(folder.communicator, [&]() {
        std::error_code error;
        std::filesystem::rename(file + unfinished, file, error);
        if (error)
          throw ComputationError("The file '" + file + "' cannot be written: " +
                                 error.message() + ".");
      });
      list.append(step, entry);
    }

    /// @param flags with the time. @throws ComputationError when the disk is full.
    template <int dim>
    void
    write_vtu(const PieceOfFile<dim>      &data_out,
              const RunFolder             &folder,
              FieldList                   &list,
              const unsigned int           step,
              const DataOutBase::VtkFlags &flags)
    {
      // One file, to which each rank gives the part between header and footer.
      std::ostringstream header, footer;
      DataOutBase::write_vtu_header(header, flags);
      DataOutBase::write_vtu_footer(footer);
      const unsigned int rank =
        Utilities::MPI::this_mpi_process(folder.communicator);
      const unsigned int n_ranks =
        Utilities::MPI::n_mpi_processes(folder.communicator);
      write_atomically(folder.file(list.file_of(step)),
                       (rank == 0 ? header.str() : "") +
                         data_out.text(flags, /* may be empty */ rank > 0) +
                         (rank + 1 == n_ranks ? footer.str() : ""),
                       folder.communicator);
      list.append(step, flags.time);
    }

    /// In 1D a field of one component is a scalar to VTU files.
    template <int dim>
    std::vector<DataComponentInterpretation::DataComponentInterpretation>
    interpretation()
    {
      return {static_cast<std::size_t>(dim),
              dim == 1
                ? DataComponentInterpretation::component_is_scalar
                : DataComponentInterpretation::component_is_part_of_vector};
    }
  } // namespace



  template <int dim>
  VtuSeries<dim>::VtuSeries(const Body<dim>                  &body,
                            const std::vector<Material<dim>> &materials,
                            ContactOperator                  &contact,
                            const Obstacles                  &obstacles,
                            RunFolder                        &folder,
                            const FieldFormat                 format)
    : body(body)
    , materials(materials)
    , contact(contact)
    , obstacles(obstacles)
    , surfaces(obstacles)
    , folder(folder)
    , format(format)
    , list(folder, "solution.pvd", "solution/step-")
    , obstacle_list(folder, "obstacles.pvd", "solution/obstacles-")
    , xdmf_list(folder)
  {}



  template <int dim>
  void
  VtuSeries<dim>::write(const State &state, const unsigned int step)
  {
    const Vector displacement = body.displacement_part(state.solution);
    const Vector velocity     = body.displacement_part(state.velocity);
    const Vector acceleration = body.displacement_part(state.acceleration);
    Vector       contact_force(state.contact_force);
    contact_force *= -1.;
    const Vector force_on_body = body.displacement_part(contact_force);

    const Vector pressure =
      body.displacement_part(contact.pressure_field({state.solution,
                                                     state.contact_force,
                                                     state.time,
                                                     &state.contact_shares}));

    const StressPostprocessor<dim> stress(materials);
    const StressComponents<dim>    stress_components(materials);
    const FirstComponent<dim>      contact_pressure("contact_pressure");
    const Gap<dim>                 gap(obstacles, state.time);
    const VonMises<dim>            von_mises(materials);
    PieceOfFile<dim>               data_out;
    data_out.attach_dof_handler(body.dof_handler());
    const auto add = [&](const Vector &vector, const std::string &name) {
      data_out.add_data_vector(body.dof_handler(),
                               vector,
                               std::vector<std::string>(dim, name),
                               interpretation<dim>());
    };
    add(displacement, "displacement");
    add(velocity, "velocity");
    add(acceleration, "acceleration");
    add(force_on_body, "contact_force");
    if (format == FieldFormat::vtu)
      data_out.add_data_vector(body.dof_handler(), displacement, stress);
    else
      data_out.add_data_vector(body.dof_handler(),
                               displacement,
                               stress_components);
    if constexpr (dim > 1)
      data_out.add_data_vector(body.dof_handler(), displacement, von_mises);
    data_out.add_data_vector(body.dof_handler(), pressure, contact_pressure);
    if (!obstacles.empty())
      data_out.add_data_vector(body.dof_handler(), displacement, gap);
    dealii::Vector<float> part(
      body.dof_handler().get_triangulation().n_active_cells());
    for (const auto &cell : body.dof_handler().active_cell_iterators())
      part(cell->active_cell_index()) = body.part(cell, materials.size());
    if (materials.size() > 1)
      data_out.add_data_vector(part, "part");
    data_out.build_patches(body.mapping(),
                           body.dof_handler().get_fe().degree,
                           body.is_curved() ? DataOut<dim>::curved_inner_cells
                                            : DataOut<dim>::curved_boundary);

    make_folder(folder, "solution");
    DataOutBase::VtkFlags flags;
    flags.time                = state.time;
    flags.print_date_and_time = false;
    if (format == FieldFormat::vtu)
      write_vtu(data_out, folder, list, step, flags);
    else
      write_hdf5(data_out, body, folder, xdmf_list, step, state.time);
    if constexpr (dim > 1)
      if (!surfaces.empty())
        write_obstacles(displacement, step, flags);
  }



  template <int dim>
  void
  VtuSeries<dim>::write_obstacles(const Vector                &displacement,
                                  const unsigned int           step,
                                  const DataOutBase::VtkFlags &flags)
  {
    // The bodies at the start and now, so that the obstacles that they leave
    // stay visible.
    Point<dim> lower, upper;
    for (unsigned int c = 0; c < dim; ++c)
      {
        lower[c] = std::numeric_limits<double>::max();
        upper[c] = std::numeric_limits<double>::lowest();
      }
    for (const auto &cell : body.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int v : cell->vertex_indices())
          for (unsigned int c = 0; c < dim; ++c)
            {
              const double there = cell->vertex(v)[c],
                           now   = there +
                displacement(cell->vertex_dof_index(v,
                                                    c,
                                                    cell->active_fe_index()));
              lower[c] = std::min({lower[c], there, now});
              upper[c] = std::max({upper[c], there, now});
            }
    for (unsigned int c = 0; c < dim; ++c)
      {
        lower[c] = Utilities::MPI::min(lower[c], folder.communicator);
        upper[c] = Utilities::MPI::max(upper[c], folder.communicator);
      }
    on_first_rank(folder.communicator, [&]() {
      write_atomically(folder.file(obstacle_list.file_of(step)),
                       surfaces.vtu(BoundingBox<dim>({lower, upper}), flags));
    });
    obstacle_list.append(step, flags.time);
  }


  template class VtuSeries<1>;
  template class VtuSeries<2>;
  template class VtuSeries<3>;
} // namespace Ricochet
