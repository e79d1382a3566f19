// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <contact/obstacles/level_set.h>

#include <cmath>

namespace Ricochet
{
  using dealii::Tensor;

  namespace
  {
    /// Central difference of fourth order of @p function at 0, over steps @p h.
    template <typename Function>
    auto
    difference(const Function &function, const double h)
    {
      return (8. * (function(h) - function(-h)) -
              (function(2. * h) - function(-2. * h))) /
        (12. * h);
    }

    Tensor<1, 3>
    axis_vector(const unsigned int c)
    {
      Tensor<1, 3> vector;
      vector[c] = 1.;
      return vector;
    }

    std::vector<std::string>
    all_expressions(const unsigned int              dim,
                    const std::string              &function,
                    const std::vector<std::string> &gradient)
    {
      if (gradient.size() != dim)
        throw InputError("The gradient of the level set needs " +
                         std::to_string(dim) +
                         " expressions, separated by semicolons; it has " +
                         std::to_string(gradient.size()) + ".");
      std::vector<std::string> all = {function};
      all.insert(all.end(), gradient.begin(), gradient.end());
      return all;
    }
  } // namespace



  LevelSet::LevelSet(const unsigned int              dim,
                     const std::string              &function,
                     const std::vector<std::string> &gradient,
                     const double                    length)
    : dim(dim)
    , difference_step(1e-3 * length)
    , expressions("x,y,z",
                  all_expressions(dim, function, gradient),
                  "the level set")
  {}



  double
  LevelSet::gap(const Tensor<1, 3> &x) const
  {
    return expressions.value(0, x) / given_gradient(x).norm();
  }



  Tensor<1, 3>
  LevelSet::given_gradient(const Tensor<1, 3> &x) const
  {
    Tensor<1, 3> gradient;
    for (unsigned int c = 0; c < dim; ++c)
      gradient[c] = expressions.value(c + 1, x);
    return gradient;
  }



  std::string
  LevelSet::problem_at(const Tensor<1, 3> &x) const
  {
    const Tensor<1, 3> given = given_gradient(x);
    Tensor<1, 3>       differences;
    for (unsigned int c = 0; c < dim; ++c)
      differences[c] = difference(
        [&](const double h) {
          return expressions.value(0, x + h * axis_vector(c));
        },
        difference_step);
    std::string place;
    for (unsigned int c = 0; c < dim; ++c)
      place += (c == 0 ? "(" : ", ") + to_text(x[c]);
    place += ")";
    // Squares of large numbers overflow, and any gap would be zero.
    if (!std::isfinite(gap(x)) || !std::isfinite(given.norm()))
      return "The gap to the level set is not finite at " + place +
        ": its gradient must neither vanish nor be too large.";
    if (!((given - differences).norm() <= 1e-5 * differences.norm()))
      return "The gradient of the level set is not that of its function: at " +
        place + " it has the length " + to_text(given.norm()) +
        ", and differences of the function have " +
        to_text(differences.norm()) + ".";
    return "";
  }



  Tensor<1, 3>
  LevelSet::gap_gradient(const Tensor<1, 3> &x) const
  {
    const Tensor<1, 3> gradient = given_gradient(x);
    const double       norm     = gradient.norm();
    const Tensor<1, 3> normal   = gradient / norm;
    // The gradient of |grad phi| is the second derivative along the normal.
    const Tensor<1, 3> norm_gradient =
      difference([&](const double h) { return given_gradient(x + h * normal); },
                 difference_step);
    return normal - expressions.value(0, x) / (norm * norm) * norm_gradient;
  }



  bool
  LevelSet::needs_correction(const Tensor<1, 3> &step) const
  {
    return step.norm() > 1e-3 * difference_step;
  }



  Tensor<1, 3>
  LevelSet::discrete_normal(const Tensor<1, 3> &begin,
                            const Tensor<1, 3> &end) const
  {
    const Tensor<1, 3> step   = end - begin;
    Tensor<1, 3>       result = gap_gradient(.5 * (begin + end));
    if (needs_correction(step))
      result +=
        (gap(end) - gap(begin) - result * step) / step.norm_square() * step;
    return result;
  }



  Tensor<2, 3>
  LevelSet::gap_hessian(const Tensor<1, 3> &x) const
  {
    Tensor<2, 3> hessian;
    for (unsigned int c = 0; c < dim; ++c)
      {
        const Tensor<1, 3> column = difference(
          [&](const double h) { return gap_gradient(x + h * axis_vector(c)); },
          difference_step);
        for (unsigned int a = 0; a < 3; ++a)
          hessian[a][c] = column[a];
      }
    return hessian;
  }



  Tensor<2, 3>
  LevelSet::discrete_normal_derivative(const Tensor<1, 3> &begin,
                                       const Tensor<1, 3> &end) const
  {
    const Tensor<1, 3> step = end - begin, middle = .5 * (begin + end);
    const Tensor<2, 3> hessian = gap_hessian(middle);
    if (!needs_correction(step))
      return .5 * hessian;
    const Tensor<1, 3> gradient = gap_gradient(middle);
    const double       square   = step.norm_square();
    const double factor = (gap(end) - gap(begin) - gradient * step) / square;
    const Tensor<1, 3> factor_gradient =
      (gap_gradient(end) - gradient - .5 * hessian * step -
       2. * factor * step) /
      square;
    return .5 * hessian + outer_product(step, factor_gradient) +
      factor * Tensor<2, 3>(dealii::unit_symmetric_tensor<3>());
  }
} // namespace Ricochet
