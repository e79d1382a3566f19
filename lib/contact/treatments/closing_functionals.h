// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_closing_functionals_h
#define ricochet_contact_treatments_closing_functionals_h

#include <contact/kinematics/contact_points.h>
#include <contact/laws/contact_law.h>
#include <solvers/tangent.h>

#include <optional>
#include <vector>

namespace Ricochet
{
  /// The tangent of @p law when a point with this h_T is open.
  ContactPointTangent
  open_tangent(const ContactLaw &law, const double cell_diameter);

  /**
   * How closing changes the tangent of a law in a point: by a number times
   * test trial^T, where test and trial are directions in the space of gap, stress
   * pressure and multiplier that depend on the law and h_T only. The number can be
   * read off one entry.
   */
  struct Closing
  {
    unsigned int         row = 0, column = 0;
    dealii::Tensor<1, 3> test, trial;
  };

  /// Unit vectors across @p normal in a space of @p n_axes dimensions: two, one in the
  /// plane, or none.
  std::vector<dealii::Tensor<1, 3>>
  directions_along_plane(const dealii::Tensor<1, 3> &normal,
                         const unsigned int          n_axes);

  /// None if the law's tangent changes by more than one direction.
  std::optional<Closing>
  closing_directions(const ContactLaw &law, const double cell_diameter);

  /**
   * The functionals through which pointwise contact acts, where they stay the
   * same: in each point those of the law (test and trial, often the same), and with
   * friction those of the displacement along the foundation.
   */
  class ClosingFunctionals
  {
  public:
    /// @pre the law has closing_directions().
    ClosingFunctionals(const ContactLaw    &law,
                       const bool           with_friction,
                       const ContactPoints &points);

    /// What a point has; numbers of functionals.
    struct Point
    {
      Closing closing;
      /// See open_tangent().
      ContactPointTangent               open_tangent;
      unsigned int                      test, trial, first_tangential;
      std::vector<dealii::Tensor<1, 3>> tangential;
    };

    const Point &
    operator[](const unsigned int p) const
    {
      return points[p];
    }

    const ContactStructure::ActsThrough &
    all() const
    {
      return acts_through;
    }

  private:
    std::vector<Point>            points;
    ContactStructure::ActsThrough acts_through;
  };
} // namespace Ricochet

#endif
