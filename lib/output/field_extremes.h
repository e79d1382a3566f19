// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_field_extremes_h
#define ricochet_output_field_extremes_h

#include <discretization/body.h>
#include <materials/material.h>
#include <time_integration/state.h>

#include <string>
#include <vector>

namespace Ricochet
{
  /// The largest value of a field in a run.
  struct FieldExtreme
  {
    std::string name, unit;
    double      value = 0.;
    /// s
    double time = 0.;
    /// In the undeformed bodies (m).
    std::vector<double> place = {};
  };

  /**
   * The largest von Mises stress in the nodes of all cells, and the largest displacement, velocity
   * and acceleration of nodes, of all states that it is shown.
   */
  template <int dim>
  class FieldExtremes
  {
  public:
    /// @param materials of the parts, or of the only body.
    FieldExtremes(const Body<dim>                  &body,
                  const std::vector<Material<dim>> &materials);

    /// Collective.
    void
    update(const State &state);

    /// In 1D the stress is not among them: it is the force over the section.
    const std::vector<FieldExtreme> &
    all() const
    {
      return extremes;
    }

  private:
    const Body<dim>                 &body;
    const std::vector<Material<dim>> materials;
    std::vector<FieldExtreme>        extremes;
  };
} // namespace Ricochet

#endif
