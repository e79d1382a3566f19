// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_material_parameters_h
#define ricochet_materials_material_parameters_h

#include <base/parameter_file.h>
#include <materials/material.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Ricochet
{
  /// Everything about the material that a user chooses.
  struct MaterialParameters
  {
    /// Of the parameter file; several parts have sections of their own.
    std::string section       = "Material";
    std::string law           = "linear elastic";
    std::string plane_state   = "plane stress";
    double      density       = 1000.;
    double      young_modulus = 1e10;
    double      poisson_ratio = .35;
    double      c1            = .5e6;
    double      c2            = 5e3;
    double      d             = .35e6;
    std::string viscosity     = "none";
    double      viscosity_eta = 0.;

    void
    add_parameters(dealii::ParameterHandler &parameters);

    /// The parameters that the law makes no use of.
    std::vector<UnusedParameter>
    unused_parameters() const;

    /**
     * @param dim dimension of the body.
     * @param scheme name of the time scheme.
     * @throws InputError for plane stress in 3D, a Poisson ratio out of range, a
     * viscosity that does not go with the law or the scheme.
     */
    void
    validate(const unsigned int dim, const std::string &scheme) const;

    template <int dim>
    Material<dim>
    make() const;

    /// Lamé's parameters at small strains, in 3D (Pa).
    LinearElastic
    at_small_strains() const;
  };
} // namespace Ricochet

#endif
