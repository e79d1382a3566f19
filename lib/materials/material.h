// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_material_h
#define ricochet_materials_material_h

#include <materials/hyperelastic.h>
#include <materials/linear_elastic.h>
#include <materials/viscosity.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

namespace Ricochet
{
  /// The material of a body: one elastic law and, in parallel, a viscosity.
  template <int dim>
  struct Material
  {
    /// @param plane_state in 2D, the plane state that @p linear was reduced to.
    Material(const LinearElastic &linear,
             const Viscosity     &viscosity   = {},
             const PlaneState     plane_state = PlaneState::plane_strain)
      : linear(linear)
      , viscosity(viscosity)
      , plane_state(plane_state)
    {}

    Material(std::shared_ptr<const Hyperelastic<dim>> hyperelastic,
             const Viscosity                         &viscosity = {})
      : hyperelastic(std::move(hyperelastic))
      , viscosity(viscosity)
      , plane_state(PlaneState::plane_strain)
    {}

    /// Elastic Cauchy stress (Pa) for a gradient of the displacement.
    dealii::SymmetricTensor<2, dim>
    cauchy_stress(const dealii::Tensor<2, dim> &displacement_gradient) const
    {
      if constexpr (dim > 1)
        if (!linear)
          return hyperelastic->cauchy_stress(
            dealii::unit_symmetric_tensor<dim>() + displacement_gradient);
      return linear->stress(symmetrize(displacement_gradient));
    }

    /// Von Mises' stress (Pa), sqrt(3/2) times the norm of the deviator of the
    /// elastic Cauchy stress, which in 2D has an out-of-plane component. A bar
    /// is in uniaxial stress.
    double
    von_mises(const dealii::Tensor<2, dim> &displacement_gradient) const
    {
      dealii::SymmetricTensor<2, 3> stress;
      if constexpr (dim > 1)
        if (!linear)
          stress = hyperelastic->spatial_cauchy_stress(
            dealii::unit_symmetric_tensor<dim>() + displacement_gradient);
      if (linear)
        {
          const dealii::SymmetricTensor<2, dim> strain =
            symmetrize(displacement_gradient);
          const dealii::SymmetricTensor<2, dim> in_plane =
            linear->stress(strain);
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = i; j < dim; ++j)
              stress[i][j] = in_plane[i][j];
          if (dim == 2 && plane_state == PlaneState::plane_strain)
            stress[2][2] = linear->lambda * trace(strain);
        }
      return std::sqrt(1.5) * deviator(stress).norm();
    }

    /// Small strains; nothing for a hyperelastic body.
    const std::optional<LinearElastic> linear;
    /// Large strains; null for a linear elastic body.
    const std::shared_ptr<const Hyperelastic<dim>> hyperelastic;
    const Viscosity                                viscosity;

  private:
    PlaneState plane_state;
  };

  /// Whether all @p materials are linear elastic.
  template <int dim>
  bool
  are_linear(const std::vector<Material<dim>> &materials)
  {
    return std::all_of(materials.begin(),
                       materials.end(),
                       [](const Material<dim> &material) {
                         return material.linear.has_value();
                       });
  }
} // namespace Ricochet

#endif
