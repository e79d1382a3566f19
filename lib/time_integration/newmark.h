// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_newmark_h
#define ricochet_time_integration_newmark_h

#include <time_integration/generalised_alpha.h>

namespace Ricochet
{
  /// Newmark's method with any beta and gamma (Newmark 1959). It is stable for any step if
  /// 2 beta >= gamma >= 1/2, and of second order only with gamma = 1/2.
  class Newmark : public GeneralisedAlpha
  {
  public:
    Newmark(const double beta, const double gamma)
      : GeneralisedAlpha(Coefficients{0., 0., beta, gamma})
    {}

    static SchemeTraits
    traits()
    {
      return SchemeTraits::at_instants_with_rates("Newmark");
    }

    static std::string
    about()
    {
      return "with any beta and gamma";
    }

    static OwnParameters
    parameters()
    {
      return {
        OwnParameter("Newmark beta", .25)
          .means("Parameter beta of Newmark's method; 2 beta below gamma is "
                 "stable for short steps only. Used by Newmark.",
                 "",
                 "")
          .at_least(1e-3)
          .at_most(1.)
          .belongs_to("the time scheme Newmark"),
        OwnParameter("Newmark gamma", .5)
          .means("Parameter gamma of Newmark's method; above 1/2 it damps. "
                 "Used by Newmark.",
                 "",
                 "")
          .at_least(.5)
          .at_most(1.)
          .belongs_to("the time scheme Newmark")};
    }

    static std::unique_ptr<TimeScheme>
    make(const ParameterValues &values)
    {
      return std::make_unique<Newmark>(values["Newmark beta"],
                                       values["Newmark gamma"]);
    }
  };
} // namespace Ricochet

#endif
