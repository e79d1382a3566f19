// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_scheme_traits_h
#define ricochet_time_integration_scheme_traits_h

#include <functional>
#include <string>
#include <vector>

namespace Ricochet
{
  /// Properties of a time scheme for other parts of the library.
  struct SchemeTraits
  {
    std::string name;
    /// Contact acts over a step between two states, and its work over a step is
    /// force times displacement increment: laws may depend on both ends, and
    /// friction on the slip between them.
    bool contact_over_step = false;
    /// The scheme integrates a differential equation whose forces are functions
    /// of the state, with an invertible mass, and takes the work of contact from
    /// a potential.
    bool needs_potential = false;
    /// The scheme gives its stages the velocity at their instant, on which friction and
    /// viscosity depend (Stage::rate_origin); needless where contact acts over a step.
    bool gives_rates = false;
    /// Bodies have inertia: without, steps are those of a load.
    bool has_inertia = true;

    /// A scheme whose contact acts at instants and which knows the velocity there.
    static SchemeTraits
    at_instants_with_rates(const std::string &name)
    {
      SchemeTraits traits;
      traits.name        = name;
      traits.gives_rates = true;
      return traits;
    }

    /// Whether friction and viscosity are possible.
    bool
    has_rates() const
    {
      return contact_over_step || gives_rates;
    }
  };

  /// All schemes, in the order of their table.
  std::vector<SchemeTraits>
  all_scheme_traits();

  /// The names of the schemes that are @p good, with commas, for messages.
  std::string
  names_of_schemes(const std::function<bool(const SchemeTraits &)> &good);

  /// The traits of the scheme @p name.
  SchemeTraits
  scheme_traits(const std::string &name);
} // namespace Ricochet

#endif
