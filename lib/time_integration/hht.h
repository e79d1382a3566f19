// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_hht_h
#define ricochet_time_integration_hht_h

#include <time_integration/generalised_alpha.h>

#include <cmath>

namespace Ricochet
{
  /**
   * HHT-alpha (paper C, (24)), with beta = (1 + |alpha|)^2 / 4 and gamma = 1/2
   * + |alpha|, for alpha of either sign; alpha = 0 is Crank-Nicolson.
   *
   *     M a_new + (1 - alpha) F(u_new) + alpha F(u_old) = 0,
   *
   * where F is the internal and contact force less the load. For alpha < 0 the
   * scheme is of first order only: the order condition is gamma = 1/2 + alpha.
   */
  class HHT : public GeneralisedAlpha
  {
  public:
    explicit HHT(const double alpha)
      : GeneralisedAlpha({0.,
                          alpha,
                          .25 * (1. + std::abs(alpha)) * (1. + std::abs(alpha)),
                          .5 + std::abs(alpha)})
    {}

    static SchemeTraits
    traits()
    {
      return SchemeTraits::at_instants_with_rates("HHT");
    }

    static std::string
    about()
    {
      return "paper C, (24)";
    }

    static OwnParameters
    parameters()
    {
      return {OwnParameter("HHT alpha", .05)
                .means("Parameter alpha of HHT, of either sign (paper C: alpha "
                       "tilde); beta = (1 + |alpha|)^2/4, gamma = 1/2 + "
                       "|alpha|. Used by HHT.",
                       "",
                       "")
                .at_least(-1. / 3.)
                .at_most(1. / 3.)
                .belongs_to("the time scheme HHT")};
    }

    static std::unique_ptr<TimeScheme>
    make(const ParameterValues &values)
    {
      return std::make_unique<HHT>(values["HHT alpha"]);
    }
  };



  /// The trapezoidal rule, which is HHT with alpha = 0.
  class CrankNicolson : public HHT
  {
  public:
    CrankNicolson()
      : HHT(0.)
    {}

    static SchemeTraits
    traits()
    {
      return SchemeTraits::at_instants_with_rates("Crank-Nicolson");
    }

    static std::string
    about()
    {
      return "HHT with alpha = 0";
    }

    static OwnParameters
    parameters()
    {
      return {};
    }

    static std::unique_ptr<TimeScheme>
    make(const ParameterValues &)
    {
      return std::make_unique<CrankNicolson>();
    }
  };
} // namespace Ricochet

#endif
