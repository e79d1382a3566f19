// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_viscosity_h
#define ricochet_materials_viscosity_h

namespace Ricochet
{
  /// The forces by the velocity in a body, beside those of contact: none, damping in
  /// proportion to the mass alone, or a viscous stress.
  enum class VelocityForce
  {
    none,
    damping,
    viscosity
  };

  /**
   * Kelvin-Voigt viscosity: a viscous power density W_v beside the elastic
   * energy, the viscous stress being its derivative with respect to the rate.
   *
   * A step uses the rate C_dot = (C_new - C_old)/dt and the mean deformation
   * gradient, F_mean; since F_mean^T (F_new - F_old) has the symmetric part dt C_dot/2, the
   * dissipation of a step is dt eta |C_dot|^2 (times the clipped factor), never
   * negative, whatever the step.
   */
  struct Viscosity
  {
    enum class Law
    {
      none,
      /// W_v = eta/2 tr(strain_rate^2), for small strains (B (6.1)).
      linear,
      /// W_v = tau/2 strain_rate : C strain_rate with the elasticity tensor C and tau =
      /// eta / (2 mu): shear has the stress of the linear law, and volume its own, too.
      kelvin_voigt,
      /// W_v = eta/2 tr(C_dot^2) (B, after (2.13)).
      curnier,
      /// W_v = eta/4 tr(C_dot^2) (tr C - 3), the factor clipped at zero (B
      /// (2.14)).
      pioletti
    };

    Law law = Law::none;
    /// Pa s
    double eta = 0.;
    /// Damping in proportion to the mass, the other half of Rayleigh's (1/s): the force
    /// per volume is - mass_damping * density * velocity.
    double mass_damping = 0.;

    /// Whether there is a viscous stress.
    bool
    is_active() const
    {
      return law != Law::none && eta > 0.;
    }
  };
} // namespace Ricochet

#endif
