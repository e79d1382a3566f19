// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_material_h
#define ricochet_materials_material_h

#include <materials/hyperelastic.h>
#include <materials/linear_elastic.h>
#include <materials/viscosity.h>

#include <memory>
#include <optional>

namespace Ricochet
{
  /// What a body is made of: one elastic law and, beside it, a viscosity.
  template <int dim>
  struct Material
  {
    Material(const LinearElastic &linear, const Viscosity &viscosity = {})
      : linear(linear)
      , viscosity(viscosity)
    {}

    Material(std::shared_ptr<const Hyperelastic<dim>> hyperelastic,
             const Viscosity                         &viscosity = {})
      : hyperelastic(std::move(hyperelastic))
      , viscosity(viscosity)
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

    /// Small strains; nothing for a hyperelastic body.
    const std::optional<LinearElastic> linear;
    /// Large strains; null for a linear elastic body.
    const std::shared_ptr<const Hyperelastic<dim>> hyperelastic;
    const Viscosity                                viscosity;
  };
} // namespace Ricochet

#endif
