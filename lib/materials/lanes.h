// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_lanes_h
#define ricochet_materials_lanes_h

#include <deal.II/base/template_constraints.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  /**
   * A number in several points at once, in the lanes of one of the processor's
   * registers. deal.II's VectorizedArray has as many lanes as deal.II was built for,
   * which for packages of it is one; we have as many as Ricochet was built for.
   */
  class Lanes
  {
  public:
#if defined(__AVX512F__)
    static constexpr unsigned int n = 8;
#elif defined(__AVX__)
    static constexpr unsigned int n = 4;
#else
    static constexpr unsigned int n = 2;
#endif

    static constexpr unsigned int
    size()
    {
      return n;
    }

    /// Zero.
    Lanes()
      : data{}
    {}

    /// The same in all lanes.
    Lanes(const double value)
      : data(Register{} + value)
    {}

    double &
    operator[](const unsigned int lane)
    {
      return reinterpret_cast<double *>(&data)[lane];
    }

    double
    operator[](const unsigned int lane) const
    {
      return data[lane];
    }

    Lanes &
    operator+=(const Lanes &other)
    {
      data += other.data;
      return *this;
    }

    Lanes &
    operator-=(const Lanes &other)
    {
      data -= other.data;
      return *this;
    }

    Lanes &
    operator*=(const Lanes &other)
    {
      data *= other.data;
      return *this;
    }

    Lanes &
    operator/=(const Lanes &other)
    {
      data /= other.data;
      return *this;
    }

    friend Lanes
    operator+(Lanes a, const Lanes &b)
    {
      return a += b;
    }

    friend Lanes
    operator-(Lanes a, const Lanes &b)
    {
      return a -= b;
    }

    friend Lanes
    operator*(Lanes a, const Lanes &b)
    {
      return a *= b;
    }

    friend Lanes
    operator/(Lanes a, const Lanes &b)
    {
      return a /= b;
    }

    friend Lanes
    operator-(Lanes a)
    {
      a.data = -a.data;
      return a;
    }

    friend Lanes
    where_less(const Lanes &a,
               const Lanes &b,
               const Lanes &then,
               const Lanes &otherwise)
    {
      Lanes result;
      result.data = a.data < b.data ? then.data : otherwise.data;
      return result;
    }

    friend Lanes
    abs(const Lanes &x)
    {
      return where_less(x, 0., -x, x);
    }

    friend Lanes
    min(const Lanes &a, const Lanes &b)
    {
      return where_less(b, a, b, a);
    }

    // Functions of the standard library, lane by lane.

    friend Lanes
    sqrt(const Lanes &x)
    {
      return x.apply([](const double y) { return std::sqrt(y); });
    }

    friend Lanes
    cbrt(const Lanes &x)
    {
      return x.apply([](const double y) { return std::cbrt(y); });
    }

    friend Lanes
    exp(const Lanes &x)
    {
      return x.apply([](const double y) { return std::exp(y); });
    }

    friend Lanes
    expm1(const Lanes &x)
    {
      return x.apply([](const double y) { return std::expm1(y); });
    }

    friend Lanes
    log(const Lanes &x)
    {
      return x.apply([](const double y) { return std::log(y); });
    }

    friend Lanes
    pow(const Lanes &x, const double exponent)
    {
      return x.apply(
        [exponent](const double y) { return std::pow(y, exponent); });
    }

    friend Lanes
    log_of_one_plus(const Lanes &x)
    {
      // ln(1 + x) = 2 artanh y with y = x/(2 + x): the series, where it is short.
      constexpr double limit = .1;
      if (!is_less_somewhere(Lanes(limit), abs(x)))
        {
          const Lanes y = x / (2. + x), y2 = y * y;
          // y^2 <= .0028: the remainder is below 1e-17 of the sum.
          const Lanes higher = (2. / 13. * y2 + 2. / 11.) * y2 + 2. / 9.;
          const Lanes lower  = ((higher * y2 + 2. / 7.) * y2 + 2. / 5.) * y2;
          return 2. * y + y * y2 * (lower + 2. / 3.);
        }
      return x.apply([](const double y) { return std::log1p(y); });
    }

    /// Whether @p a < @p b is false in some lane, also where one is not a
    /// number.
    friend bool
    is_not_less_somewhere(const Lanes &a, const Lanes &b)
    {
      const auto less   = a.data < b.data;
      bool       result = false;
      for (unsigned int lane = 0; lane < n; ++lane)
        result |= less[lane] == 0;
      return result;
    }

    friend bool
    is_less_somewhere(const Lanes &a, const Lanes &b)
    {
      bool result = false;
      for (unsigned int lane = 0; lane < n; ++lane)
        result = result || a[lane] < b[lane];
      return result;
    }

  private:
    template <typename Function>
    Lanes
    apply(const Function &function) const
    {
      Lanes result;
      for (unsigned int lane = 0; lane < n; ++lane)
        result[lane] = function(data[lane]);
      return result;
    }

    using Register __attribute__((vector_size(n * sizeof(double)), may_alias)) =
      double;

    Register data;
  };

  // The same for one point.

  /// @p then where @p a < @p b, @p otherwise elsewhere.
  inline double
  where_less(const double a,
             const double b,
             const double then,
             const double otherwise)
  {
    return a < b ? then : otherwise;
  }

  /// Whether @p a < @p b in some lane.
  inline bool
  is_less_somewhere(const double a, const double b)
  {
    return a < b;
  }

  /// ln(1 + @p x), without cancellation.
  inline double
  log_of_one_plus(const double x)
  {
    return std::log1p(x);
  }
} // namespace Ricochet

/// deal.II's tensors may be scaled by it.
template <>
struct dealii::EnableIfScalar<Ricochet::Lanes>
{
  using type = Ricochet::Lanes;
};

#endif
