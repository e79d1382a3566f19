// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_scheme_traits_h
#define ricochet_time_integration_scheme_traits_h

#include <string>
#include <vector>

namespace Ricochet
{
  /// What the other parts of the library may know of a time scheme.
  struct SchemeTraits
  {
    std::string name;
    /// Contact acts over a step between two states, and its work over a step is
    /// force times way: laws may look at both ends, and friction at the slip
    /// between them.
    bool contact_over_step = false;
    /// The scheme integrates a differential equation whose forces are functions
    /// of the state, with an invertible mass, and reads the work of contact off a
    /// potential.
    bool needs_potential = false;
  };

  /// All schemes, in the order of their table.
  std::vector<SchemeTraits>
  all_scheme_traits();

  /// Those of the scheme @p name.
  SchemeTraits
  scheme_traits(const std::string &name);
} // namespace Ricochet

#endif
