// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_vtu_series_h
#define ricochet_output_vtu_series_h

#include <base/run_folder.h>
#include <discretization/body.h>
#include <materials/material.h>
#include <output/field_format.h>
#include <output/field_list.h>
#include <output/obstacle_surfaces.h>
#include <output/xdmf_list.h>
#include <time_integration/semi_discrete_system.h>

namespace Ricochet
{
  /**
   * The fields of a body for ParaView: displacement, velocity, acceleration (of the
   * midpoint scheme its mean over the last step),
   * elastic Cauchy stress and von Mises stress (Pa), the contact force of each
   * node (N, on the body), the contact pressure (Pa), the gap (m; of all points
   * of the body, to the nearest obstacle, if there is one) and the number of the part
   * (if there are several), as `solution/step-NNNNNN.vtu` with `solution.pvd`, or as
   * `solution/step-NNNNNN.h5` with `solution.xdmf`, which list them with their times. Rigid obstacles
   * are in `solution/obstacles-NNNNNN.vtu` and `obstacles.pvd`.
   */
  template <int dim>
  class VtuSeries
  {
  public:
    /// @param materials of the parts, or of the only body.
    VtuSeries(const Body<dim>                  &body,
              const std::vector<Material<dim>> &materials,
              ContactOperator                  &contact,
              const Obstacles                  &obstacles,
              RunFolder                        &folder,
              const FieldFormat                 format);

    /// Write @p state as step number @p step. A step that is written again,
    /// after a resumed run, replaces the old one.
    /// @throws ComputationError when the disk is full.
    void
    write(const State &state, const unsigned int step);

  private:
    /// @param displacement with those of other ranks. @param flags with the time.
    void
    write_obstacles(const Vector                        &displacement,
                    const unsigned int                   step,
                    const dealii::DataOutBase::VtkFlags &flags);

    const Body<dim>                 &body;
    const std::vector<Material<dim>> materials;
    ContactOperator                 &contact;
    const Obstacles                  obstacles;
    const ObstacleSurfaces<dim>      surfaces;
    RunFolder                       &folder;
    const FieldFormat                format;
    FieldList                        list, obstacle_list;
    XdmfList                         xdmf_list;
  };
} // namespace Ricochet

#endif
