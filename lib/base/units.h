// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_units_h
#define ricochet_base_units_h

#include <string>

namespace Ricochet
{
  /**
   * Units of length, mass and time. Nothing is converted: numbers are the
   * user's, in any consistent system, and only names change.
   */
  class Units
  {
  public:
    /// The SI units.
    Units() = default;

    /// @param text units of length, mass and time, separated by commas: "mm, t, s".
    /// @throws InputError for another number of them.
    explicit Units(const std::string &text);

    /// The unit that is @p si_unit in the SI, one of those in the ledger: "J" becomes
    /// "mJ" in mm, t and s, and "t furlong^2/s^2" in units that nobody else uses.
    std::string
    name(const std::string &si_unit) const;

    /// Whether they are m, kg and s.
    bool
    are_si() const;

    /// A number in these units, of the quantity that has @p si_unit in the SI, in that; not a number
    /// where one of these units is unknown.
    double
    in_si(const double value, const std::string &si_unit) const;

    /// A number with its unit, for people: "0.5 mm".
    std::string
    text(const double value, const std::string &si_unit) const;

  private:
    std::string length = "m", mass = "kg", time = "s";
  };
} // namespace Ricochet

#endif
