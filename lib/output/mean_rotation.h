// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_mean_rotation_h
#define ricochet_output_mean_rotation_h

#include <output/part_nodes.h>

namespace Ricochet
{
  /**
   * How far a deformable body has turned: by the rotation R that brings the undeformed
   * body nearest to the deformed one, which minimises the integral of
   * rho |x - x_m - R (X - X_m)|^2. It is the orthogonal factor of the integral of
   * rho (x - x_m) (X - X_m)^T, where x_m and X_m are the centres of mass.
   */
  template <int dim>
  class MeanRotation
  {
  public:
    /**
     * @param mass consistent mass matrix (kg).
     * @param n_parts of the body, of which those from @p begin to before @p end count,
     * see Body::part(). Collective.
     */
    MeanRotation(const Body<dim>   &body,
                 const BodyMatrix  &mass,
                 const unsigned int n_parts,
                 const unsigned int begin,
                 const unsigned int end);

    /// Axis times angle (rad), the angle from 0 to pi; in 2D the third component is the
    /// angle, from -pi to pi, and the others are zero. Zero for a body that has
    /// collapsed or is inverted, for which no nearest rotation exists.
    /// Collective.
    dealii::Tensor<1, 3>
    vector(const Vector &solution) const;

  private:
    const MPI_Comm                   communicator;
    const std::vector<PartNode<dim>> nodes;
    // For each unknown, the integral of rho times its shape function times X -
    // X_m (kg m).
    std::vector<dealii::Tensor<1, dim>> moments;
  };
} // namespace Ricochet

#endif
