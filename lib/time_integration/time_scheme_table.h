// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_time_scheme_table_h
#define ricochet_time_integration_time_scheme_table_h

#include <base/named_table.h>
#include <time_integration/scheme_traits.h>
#include <time_integration/time_scheme.h>

#include <functional>
#include <memory>
#include <string>

namespace Ricochet
{
  /**
   * A time scheme in the table from which parameter files choose. A class that derives
   * from TimeScheme has
   *
   *     static SchemeTraits traits();
   *     static std::string about();            for the documentation
   *     static OwnParameters parameters();
   *     static std::unique_ptr<TimeScheme> make(const ParameterValues &);
   */
  struct TimeSchemeEntry
  {
    SchemeTraits  traits;
    std::string   about;
    OwnParameters parameters;
    std::function<std::unique_ptr<TimeScheme>(const ParameterValues &)> make;
  };

  inline const std::string &
  name_of(const TimeSchemeEntry &entry)
  {
    return entry.traits.name;
  }

  /// Add a time scheme to the table. Programs do this before they declare parameters.
  /// @throws dealii::ExcMessage when its name is taken.
  void
  register_time_scheme(const TimeSchemeEntry &entry);

  /// The entry of the time scheme @p Scheme.
  template <typename Scheme>
  TimeSchemeEntry
  time_scheme_entry()
  {
    return {Scheme::traits(),
            Scheme::about(),
            Scheme::parameters(),
            Scheme::make};
  }

  /// Add the time scheme @p Scheme to the table.
  template <typename Scheme>
  void
  register_time_scheme()
  {
    register_time_scheme(time_scheme_entry<Scheme>());
  }
} // namespace Ricochet

#endif
