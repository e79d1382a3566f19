// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_laws_coulomb_friction_h
#define ricochet_contact_laws_coulomb_friction_h

#include <base/exceptions.h>
#include <base/own_parameter.h>
#include <base/parameter_file.h>

#include <string>

namespace Ricochet
{
  /// Coulomb's friction: a point slips at mu times its pressure.
  struct CoulombFriction
  {
    /// mu
    double coefficient = 0.;

    static constexpr const char *name = "Coulomb";

    static OwnParameters
    parameters()
    {
      return {
        OwnParameter("Friction coefficient", 0.)
          .means("Coulomb's coefficient mu of friction; 0 for none. Stick and "
                 "slip are exact with Signorini active set, persistent contact "
                 "and Ayyad-Barboteu two-step, regularised with the others.",
                 "",
                 "")
          .must([](const double value) {
            if (value < 0.)
              throw InputError(
                "The friction coefficient must not be negative; it is " +
                to_text(value) + ".");
          })
          .belongs_to("Coulomb's friction")};
    }

    static CoulombFriction
    make(const ParameterValues &values)
    {
      return {values["Friction coefficient"]};
    }

    static std::string
    absent(const ParameterValues &values)
    {
      return make(values).coefficient > 0. ? "" : "Friction coefficient is 0";
    }

    template <typename Number>
    Number
    limit(const Number &pressure, const Number & /*slip_speed*/) const
    {
      return coefficient * pressure;
    }
  };
} // namespace Ricochet

#endif
