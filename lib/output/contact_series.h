// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_contact_series_h
#define ricochet_output_contact_series_h

#include <base/run_folder.h>
#include <base/units.h>
#include <contact/contact_operator.h>
#include <discretization/body.h>
#include <output/part_nodes.h>
#include <time_integration/state.h>

#include <map>
#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * Contact as data, `contact/step-NNNNNN.h5` with the time as an attribute. For each contact:
   *
   *     NAME/position   (points, dim), displaced
   *     NAME/gap, NAME/normal_force, NAME/area, NAME/active     (points)
   *     NAME/nodes      (nodes, dim), initial positions of the nodes with a force
   *     NAME/nodal_force, NAME/nodal_displacement               (nodes, dim)
   *
   * The sum of `normal_force` is the column `contact_force_NAME` of the energy table. Of a
   * treatment that has several boundaries at once only all nodal forces together are known: then
   * `nodes` and those after it are not in a group.
   */
  template <int dim>
  class ContactSeries
  {
  public:
    /// @param names of the contacts by boundary, see TimeLoop.
    ContactSeries(
      const Body<dim>                                         &body,
      ContactOperator                                         &contact,
      const std::map<dealii::types::boundary_id, std::string> &names,
      RunFolder                                               &folder,
      const Units                                             &units);

    /// Write @p state as step number @p step. Collective.
    /// @throws ComputationError when the disk is full.
    void
    write(const State &state, const unsigned int step);

  private:
    const Body<dim>                                        &body;
    ContactOperator                                        &contact;
    const std::map<dealii::types::boundary_id, std::string> names;
    RunFolder                                              &folder;
    const Units                                             units;
    // Nodes of this rank, found when they are first written.
    std::vector<PartNode<dim>> nodes;
  };
} // namespace Ricochet

#endif
