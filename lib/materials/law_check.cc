// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <materials/law_check.h>

#include <array>
#include <cmath>
#include <functional>

namespace Ricochet
{
  namespace
  {
    constexpr std::array<double Invariants<>::*, 3> all_invariants = {
      {&Invariants<>::first, &Invariants<>::second, &Invariants<>::third}};

    /// Invariants of the stretches whose squares are @p a, @p b and @p c.
    Invariants<>
    invariants_of(const double a, const double b, const double c)
    {
      return {a + b + c, a * b + b * c + c * a, a * b * c};
    }

    /// The invariants with number @p k changed by @p by.
    Invariants<>
    moved(Invariants<> at, const unsigned int k, const double by)
    {
      at.*all_invariants[k] += by;
      return at;
    }

    [[noreturn]] void
    refuse(const std::string &name, const std::string &what)
    {
      throw InputError("The material law '" + name + "' is wrong: " + what +
                       ".");
    }

    void
    check_rest(const HyperelasticLaw &law,
               const std::string     &name,
               const double           modulus)
    {
      const Invariants<> rest   = invariants_of(1., 1., 1.);
      const double       energy = law.energy(rest);
      if (!(std::abs(energy) <= 1e-10 * modulus))
        refuse(name,
               "its energy at rest is " + to_text(energy) + " J/m^3, not 0");
      // Twice dW/dC at C = I.
      const auto   g      = law.gradient(rest);
      const double stress = 2. * (g[0] + 2. * g[1] + g[2]);
      if (!(std::abs(stress) <= 1e-10 * modulus))
        refuse(name, "its stress at rest is " + to_text(stress) + " Pa, not 0");
    }

    /**
     * Whether @p derivative is certainly not that of a @p function of a change of an invariant. Two quotients
     * of differences, by steps that are large against round-off, say by their own
     * difference how well they are known.
     *
     * @param size of the terms in the function, for its round-off.
     */
    bool
    is_wrong(const double                               derivative,
             const std::function<double(const double)> &function,
             const double                               size,
             double                                    &quotient)
    {
      const auto by_step = [&](const double step) {
        return (function(step) - function(-step)) / (2. * step);
      };
      constexpr double step = 1e-4;
      quotient              = by_step(step);
      const double known_to = std::abs(quotient - by_step(.5 * step)) +
        1e-14 * (size + std::abs(function(0.))) / step;
      return !(std::abs(derivative - quotient) <=
               1e-4 * (std::abs(derivative) + std::abs(quotient)) +
                 3. * known_to);
    }

    void
    check_derivatives(const HyperelasticLaw &law,
                      const std::string     &name,
                      const Invariants<>    &at)
    {
      const auto   gradient = law.gradient(at);
      const auto   hessian  = law.hessian(at);
      const double size = 3. * (std::abs(gradient[0]) + std::abs(gradient[1])) +
        std::abs(gradient[2]);
      const std::string place = ", at the invariants " + to_text(at.first) +
        ", " + to_text(at.second) + " and " + to_text(at.third);
      double curvature = 0.;
      for (const auto &row : hessian)
        for (const double entry : row)
          curvature += std::abs(entry);
      double quotient = 0.;
      for (unsigned int k = 0; k < 3; ++k)
        {
          const std::string where = "[" + std::to_string(k) + "]";
          if (is_wrong(
                gradient[k],
                [&](const double change) {
                  return law.energy(moved(at, k, change));
                },
                size,
                quotient))
            refuse(name,
                   "gradient()" + where + " is " + to_text(gradient[k]) +
                     ", while the derivative of energy() with respect to that "
                     "invariant is " +
                     to_text(quotient) + place);
          for (unsigned int l = 0; l < 3; ++l)
            if (is_wrong(
                  hessian[l][k],
                  [&](const double change) {
                    return law.gradient(moved(at, k, change))[l];
                  },
                  curvature,
                  quotient))
              refuse(name,
                     "hessian()[" + std::to_string(l) + "]" + where + " is " +
                       to_text(hessian[l][k]) +
                       ", while the derivative of gradient()[" +
                       std::to_string(l) + "] is " + to_text(quotient) + place);
        }
    }
  } // namespace



  void
  check_law(const HyperelasticLaw &law, const std::string &name)
  {
    const LinearElastic small = law.at_small_strains();
    const double        bulk  = small.lambda + 2. / 3. * small.mu;
    if (!(small.mu > 0.) || !(bulk > 0.))
      refuse(name,
             "at small strains its shear modulus is " + to_text(small.mu) +
               " Pa and its bulk modulus " + to_text(bulk) +
               " Pa, which have to be positive");
    check_rest(law, name, small.mu + bulk);
    for (const auto &[a, b, c] : {std::array<double, 3>{{.04, -.03, .01}},
                                  std::array<double, 3>{{-.02, .05, -.04}}})
      // Laws with a limit of stretch may not know such strains.
      for (const double scale : {1., .1, .01, 1e-3})
        {
          const Invariants<> at =
            invariants_of(1. + scale * a, 1. + scale * b, 1. + scale * c);
          if (!std::isfinite(law.energy(moved(at, 0, 2e-4))))
            continue;
          check_derivatives(law, name, at);
          break;
        }
  }
} // namespace Ricochet
