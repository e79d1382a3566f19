// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_stress_probe_h
#define ricochet_output_stress_probe_h

#include <discretization/body.h>
#include <materials/material.h>

#include <deal.II/fe/fe_values.h>

#include <memory>
#include <vector>

namespace Ricochet
{
  /// The elastic Cauchy stress of a body in a point, or its mean over the
  /// undeformed volume.
  template <int dim>
  class StressProbe
  {
  public:
    /**
     * @param materials of all parts of @p body.
     * @param begin, end the range of parts.
     * @param point position (m); null for the mean. Collective.
     */
    StressProbe(const Body<dim>                  &body,
                const std::vector<Material<dim>> &materials,
                const unsigned int                begin,
                const unsigned int                end,
                const dealii::Point<dim>         *point);

    /// Whether the point is in one of the parts.
    bool
    is_in_body() const
    {
      return found;
    }

    /// Pa. Collective.
    dealii::SymmetricTensor<2, dim>
    stress(const Vector &solution) const;

  private:
    const Body<dim>                 &body;
    const std::vector<Material<dim>> materials;
    // Points of this rank.
    std::vector<typename dealii::DoFHandler<dim>::active_cell_iterator> cells;
    std::unique_ptr<dealii::FEValues<dim>>                              values;
    bool                                                                found;
  };
} // namespace Ricochet

#endif
