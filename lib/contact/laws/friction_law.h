// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_laws_friction_law_h
#define ricochet_contact_laws_friction_law_h

#include <Sacado_Fad_SFad.hpp>

namespace Ricochet
{
  /// The traction at which a point slips, with its derivatives.
  struct FrictionLimit
  {
    /// Pa
    double value         = 0.;
    double with_pressure = 0.;
    /// Pa s/m
    double with_slip_speed = 0.;
  };

  /**
   * A law of friction: the largest tangential traction of a sticking point,
   * which is that of a slipping one. See RegularisedFriction for smaller
   * tractions.
   *
   * A concrete law is a struct with
   *
   *     static constexpr const char *name;
   *     static OwnParameters parameters();
   *     static Law make(const ParameterValues &);
   *     template <typename Number>
   *     Number limit(const Number &pressure, const Number &slip_speed) const;
   *
   * and, if some values mean no friction, `static std::string absent(const
   * ParameterValues &)`, which then gives the reason ("Friction coefficient is
   * 0") and is empty otherwise. The table is in contact_treatment_table.cc.
   */
  class FrictionLaw
  {
  public:
    virtual ~FrictionLaw() = default;

    /// @param pressure Pa, not negative. @param slip_speed m/s
    virtual FrictionLimit
    limit(const double pressure, const double slip_speed) const = 0;
  };

  /// Turns a struct with a templated limit() into a FrictionLaw.
  template <typename Law>
  class FrictionLawImplementation : public FrictionLaw
  {
  public:
    explicit FrictionLawImplementation(const Law &law)
      : law(law)
    {}

    FrictionLimit
    limit(const double pressure, const double slip_speed) const override
    {
      using AD = Sacado::Fad::SFad<double, 2>;
      const AD result =
        law.template limit<AD>(AD(2, 0, pressure), AD(2, 1, slip_speed));
      return {result.val(), result.dx(0), result.dx(1)};
    }

  private:
    const Law law;
  };
} // namespace Ricochet

#endif
