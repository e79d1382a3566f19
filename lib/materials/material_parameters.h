// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_material_parameters_h
#define ricochet_materials_material_parameters_h

#include <base/own_parameter.h>
#include <base/parameter_file.h>
#include <materials/material.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Ricochet
{
  /// The material as chosen by the user.
  struct MaterialParameters
  {
    /// Section of the parameter file; several parts have sections of their own.
    std::string section       = "Material";
    std::string law           = "linear elastic";
    std::string plane_state   = "plane stress";
    double      density       = 1000.;
    std::string viscosity     = "none";
    double      viscosity_eta = 0.;
    /// See Viscosity (1/s).
    double mass_damping = 0.;
    /// The parameters of all laws, as they declare them.
    ParameterValues values = all_parameters();

    void
    add_parameters(dealii::ParameterHandler &parameters);

    /// The names of all parameters, for callers that declare others instead.
    static std::vector<std::string>
    names();

    bool
    is_linear() const
    {
      return law == LinearElastic::name;
    }

    VelocityForce
    velocity_force() const
    {
      return viscosity != "none" && viscosity_eta > 0.
        ? VelocityForce::viscosity
        : mass_damping > 0. ? VelocityForce::damping
                            : VelocityForce::none;
    }

    /// The parameters that the law does not use.
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

    /// The magnitudes by which the values of contact are set that the user has not given.
    /// @param cell_diameter and @param cell_depth are means of the cells at the surface (m), see
    /// Scales; the second is the first where it is 0.
    Scales
    scales(const double       cell_diameter,
           const unsigned int degree,
           const double       cell_depth = 0.) const;

  private:
    /// Parameters of all laws.
    static OwnParameters
    all_parameters();

    PlaneState
    state(const unsigned int dim) const;
  };
} // namespace Ricochet

#endif
