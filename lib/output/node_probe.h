// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_node_probe_h
#define ricochet_output_node_probe_h

#include <discretization/body.h>

namespace Ricochet
{
  /// Values of system vectors in the vertex that is nearest to a given point,
  /// by is_nearer().
  template <int dim>
  class NodeProbe
  {
  public:
    NodeProbe(const Body<dim> &body, const dealii::Point<dim> &point)
      : NodeProbe(body, point, 1, 0, 1)
    {}

    /// The same among the vertices of the parts from @p begin to before @p end, of
    /// @p n_parts, see Body::part().
    NodeProbe(const Body<dim>          &body,
              const dealii::Point<dim> &point,
              const unsigned int        n_parts,
              const unsigned int        begin,
              const unsigned int        end);

    /// Component @p component of @p vector in the node; collective.
    double
    value(const Vector &vector, const unsigned int component = 0) const;

  private:
    const MPI_Comm communicator;
    // System indices of the node's displacements on the rank that owns them;
    // empty on all others.
    const std::vector<dealii::types::global_dof_index> indices;
  };
} // namespace Ricochet

#endif
