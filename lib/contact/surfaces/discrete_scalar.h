// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_discrete_scalar_h
#define ricochet_contact_surfaces_discrete_scalar_h

#include <array>
#include <cmath>

namespace Ricochet
{
  /**
   * A function of positions over a step: its values at the beginning and at the end,
   * and a discrete gradient, that is a row with
   *
   *     row . (change of the positions) = new value - old value,
   *
   * exactly. Sums, products, quotients and roots of such functions are such functions,
   * by the rules below, and if the moments of the rows of their operands about the
   * middle positions are zero, so are theirs.
   *
   * @tparam Number type of the new values: double, or one for automatic
   * differentiation.
   * @tparam n number of coordinates.
   */
  template <typename Number, unsigned int n>
  struct DiscreteScalar
  {
    double                old_value = 0.;
    Number                new_value = 0.;
    std::array<Number, n> row{};

    Number
    change() const
    {
      return new_value - old_value;
    }
  };

  template <typename Number, unsigned int n>
  DiscreteScalar<Number, n>
  operator-(const DiscreteScalar<Number, n> &a,
            const DiscreteScalar<Number, n> &b)
  {
    DiscreteScalar<Number, n> result;
    result.old_value = a.old_value - b.old_value;
    result.new_value = a.new_value - b.new_value;
    for (unsigned int i = 0; i < n; ++i)
      result.row[i] = a.row[i] - b.row[i];
    return result;
  }

  template <typename Number, unsigned int n>
  DiscreteScalar<Number, n>
  operator+(const DiscreteScalar<Number, n> &a,
            const DiscreteScalar<Number, n> &b)
  {
    DiscreteScalar<Number, n> result;
    result.old_value = a.old_value + b.old_value;
    result.new_value = a.new_value + b.new_value;
    for (unsigned int i = 0; i < n; ++i)
      result.row[i] = a.row[i] + b.row[i];
    return result;
  }

  /// The row is mean(a) b' + mean(b) a'.
  template <typename Number, unsigned int n>
  DiscreteScalar<Number, n>
  operator*(const DiscreteScalar<Number, n> &a,
            const DiscreteScalar<Number, n> &b)
  {
    DiscreteScalar<Number, n> result;
    result.old_value    = a.old_value * b.old_value;
    result.new_value    = a.new_value * b.new_value;
    const Number mean_a = .5 * (a.old_value + a.new_value);
    const Number mean_b = .5 * (b.old_value + b.new_value);
    for (unsigned int i = 0; i < n; ++i)
      result.row[i] = mean_a * b.row[i] + mean_b * a.row[i];
    return result;
  }

  /// The row is (mean(b) a' - mean(a) b') / (old b new b).
  template <typename Number, unsigned int n>
  DiscreteScalar<Number, n>
  operator/(const DiscreteScalar<Number, n> &a,
            const DiscreteScalar<Number, n> &b)
  {
    DiscreteScalar<Number, n> result;
    result.old_value     = a.old_value / b.old_value;
    result.new_value     = a.new_value / b.new_value;
    const Number product = 1. / (b.old_value * b.new_value);
    const Number of_a    = .5 * (b.old_value + b.new_value) * product;
    const Number of_b    = .5 * (a.old_value + a.new_value) * product;
    for (unsigned int i = 0; i < n; ++i)
      result.row[i] = of_a * a.row[i] - of_b * b.row[i];
    return result;
  }

  /// The row is a' / (sum of both roots).
  template <typename Number, unsigned int n>
  DiscreteScalar<Number, n>
  sqrt(const DiscreteScalar<Number, n> &a)
  {
    using std::sqrt;
    DiscreteScalar<Number, n> result;
    result.old_value    = std::sqrt(a.old_value);
    result.new_value    = sqrt(a.new_value);
    const Number factor = 1. / (result.old_value + result.new_value);
    for (unsigned int i = 0; i < n; ++i)
      result.row[i] = factor * a.row[i];
    return result;
  }
} // namespace Ricochet

#endif
