// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <materials/law_check.h>

#include <array>
#include <cmath>

namespace Ricochet
{
  namespace
  {
    constexpr std::array<double Invariants<>::*, 3> all_invariants = {
      {&Invariants<>::first, &Invariants<>::second, &Invariants<>::third}};

    // Quotients of differences are right to this, relative to the terms in them.
    constexpr double tolerance = 1e-5;

    /// Invariants of the stretches whose squares are @p a, @p b and @p c.
    Invariants<>
    invariants_of(const double a, const double b, const double c)
    {
      return {a + b + c, a * b + b * c + c * a, a * b * c};
    }

    /// A change of invariant @p k, small, but large against round-off.
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

    void
    check_derivatives(const HyperelasticLaw &law,
                      const std::string     &name,
                      const Invariants<>    &at)
    {
      const double step     = 1e-4;
      const auto   gradient = law.gradient(at);
      const auto   hessian  = law.hessian(at);
      double       size = 0., curvature = 0.;
      for (unsigned int k = 0; k < 3; ++k)
        {
          size += std::abs(gradient[k]);
          for (unsigned int l = 0; l < 3; ++l)
            curvature += std::abs(hessian[k][l]);
        }
      const auto differs = [](const double a, const double b, const double of) {
        return !(std::abs(a - b) <= tolerance * of);
      };
      for (unsigned int k = 0; k < 3; ++k)
        {
          const Invariants<> less = moved(at, k, -step),
                             more = moved(at, k, step);
          const double quotient =
            (law.energy(more) - law.energy(less)) / (2. * step);
          const std::string where = "[" + std::to_string(k) + "]";
          if (differs(gradient[k], quotient, size + curvature))
            refuse(name,
                   "gradient()" + where + " is " + to_text(gradient[k]) +
                     ", and the energy changes by " + to_text(quotient) +
                     " with the invariant");
          const auto of_less = law.gradient(less), of_more = law.gradient(more);
          for (unsigned int l = 0; l < 3; ++l)
            {
              const double change = (of_more[l] - of_less[l]) / (2. * step);
              const std::string entry =
                "hessian()[" + std::to_string(l) + "]" + where;
              if (differs(hessian[l][k], change, size + curvature))
                refuse(name,
                       entry + " is " + to_text(hessian[l][k]) +
                         ", and the gradient changes by " + to_text(change) +
                         " with the invariant");
            }
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
      for (const double scale : {1., .1, .01})
        {
          const Invariants<> at =
            invariants_of(1. + scale * a, 1. + scale * b, 1. + scale * c);
          if (!std::isfinite(law.energy(moved(at, 0, 1e-3))))
            continue;
          check_derivatives(law, name, at);
          break;
        }
  }
} // namespace Ricochet
