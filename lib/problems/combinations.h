// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_combinations_h
#define ricochet_problems_combinations_h

#include <contact/treatments/contact_treatment.h>

#include <string>

namespace Ricochet
{
  /// The other side of a contact.
  enum class Opposite
  {
    obstacle,
    moving_obstacle,
    /// ContactParameters::coupling says how.
    body,
    itself
  };

  /// One of each choice that a combination can be refused for.
  struct Combination
  {
    ContactParameters contact;
    std::string       scheme;
    bool              redistributed_mass = false, viscous = false;
    /// Linear elastic or hyperelastic.
    bool         linear_material = true;
    Opposite     opposite        = Opposite::obstacle;
    unsigned int dim = 2, degree = 1;
  };

  /// @throws InputError the reason why the library does not take it.
  void
  check(const Combination &combination);

  /**
   * All combinations as CSV: names of the choices, which are those of parameter files, and
   * either "yes" or the number of a reason. The reasons follow, one in a line, after an
   * empty one, with TREATMENT, SCHEME and COUPLING in place of names.
   */
  std::string
  combinations_as_csv();
} // namespace Ricochet

#endif
