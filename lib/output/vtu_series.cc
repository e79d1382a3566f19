// SPDX-License-Identifier: LGPL-2.1-or-later
#include <output/vtu_series.h>

#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/data_postprocessor.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <regex>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    class StressPostprocessor : public DataPostprocessorTensor<dim>
    {
    public:
      explicit StressPostprocessor(const Material<dim> &material)
        : DataPostprocessorTensor<dim>("stress", update_gradients)
        , material(material)
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
              material.cauchy_stress(gradient);
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
            gradient[0]    = inputs.solution_gradients[p];
            stresses[p][0] = material.cauchy_stress(gradient)[0][0];
          }
      }

    private:
      const Material<dim> material;
    };

    class VonMises : public DataPostprocessorScalar<3>
    {
    public:
      explicit VonMises(const Material<3> &material)
        : DataPostprocessorScalar<3>("von_mises", update_gradients)
        , material(material)
      {}

      void
      evaluate_vector_field(
        const DataPostprocessorInputs::Vector<3> &inputs,
        std::vector<dealii::Vector<double>>      &values) const override
      {
        for (unsigned int p = 0; p < values.size(); ++p)
          {
            Tensor<2, 3> gradient;
            for (unsigned int i = 0; i < 3; ++i)
              gradient[i] = inputs.solution_gradients[p][i];
            values[p][0] = std::sqrt(1.5) *
              deviator(material.cauchy_stress(gradient)).norm();
          }
      }

    private:
      const Material<3> material;
    };

    /// Hands out a scalar that stands in the first component of a vector field.
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
  VtuSeries<dim>::VtuSeries(const Body<dim>     &body,
                            const Material<dim> &material,
                            ContactOperator     &contact,
                            RunFolder           &folder)
    : body(body)
    , material(material)
    , contact(contact)
    , folder(folder)
  {
    if (!folder.is_root)
      return;
    std::filesystem::create_directories(folder.file("solution"));
    if (!folder.resume)
      return;
    // Take over the list of an earlier part of the run.
    std::ifstream    in(folder.file("solution.pvd"));
    std::string      line;
    const std::regex entry(
      "timestep=\"([^\"]*)\".*file=\"(solution/step-([0-9]*)\\.vtu)\"");
    std::smatch match;
    while (std::getline(in, line))
      if (std::regex_search(line, match, entry))
        written[std::stoul(match[3])] = {std::stod(match[1]), match[2]};
  }



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

    const Vector pressure = body.displacement_part(
      contact.pressure_field(state.solution, state.contact_force));

    const StressPostprocessor<dim> stress(material);
    const FirstComponent<dim>      contact_pressure("contact_pressure");
    std::unique_ptr<DataPostprocessor<dim>> von_mises;
    if constexpr (dim == 3)
      von_mises = std::make_unique<VonMises>(material);
    DataOut<dim> data_out;
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
    data_out.add_data_vector(body.dof_handler(), displacement, stress);
    if (von_mises)
      data_out.add_data_vector(body.dof_handler(), displacement, *von_mises);
    data_out.add_data_vector(body.dof_handler(), pressure, contact_pressure);
    data_out.build_patches(body.mapping(), body.dof_handler().get_fe().degree);

    const std::string name =
      "solution/step-" + Utilities::int_to_string(step, 6) + ".vtu";
    data_out.write_vtu_in_parallel(folder.file(name), body.communicator);

    if (!folder.is_root)
      return;
    // A resumed run forgets what came after its checkpoint.
    written.erase(written.lower_bound(step), written.end());
    written[step] = {state.time, name};
    std::vector<std::pair<double, std::string>> times_and_names;
    for (const auto &entry : written)
      times_and_names.push_back(entry.second);
    std::ofstream pvd(folder.file("solution.pvd"));
    DataOutBase::write_pvd_record(pvd, times_and_names);
  }


  template class VtuSeries<1>;
  template class VtuSeries<2>;
  template class VtuSeries<3>;
} // namespace Ricochet
