// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_laws_augmentation_h
#define ricochet_contact_laws_augmentation_h

#include <base/own_parameter.h>

namespace Ricochet
{
  /// The augmentation parameter of multipliers and active sets, also used for
  /// exact friction and for laws that are not piecewise linear, which are
  /// solved in the same form.
  inline OwnParameters
  augmentation_parameters()
  {
    return {
      OwnParameter("Augmentation", 5.)
        .means("Parameter gamma_a",
               "Pa",
               " of the proximal augmented Lagrangian (paper C, (18)). For the "
               "other treatments it affects Newton's method, best with about "
               "Young's modulus, and not the solution.")
        .at_least(1e-30)
        .by_scale([](const Scales &scales, const ParameterValues &) {
          return scales.young_modulus;
        })
        .belongs_to(
          "multipliers, active sets, normal compliance and friction")};
  }
} // namespace Ricochet

#endif
