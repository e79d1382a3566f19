// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_momenta_h
#define ricochet_output_momenta_h

#include <output/part_nodes.h>

namespace Ricochet
{
  /**
   * Linear and angular momentum of a body. A force along the normal of a plane
   * leaves the linear momentum along the plane alone; without contact both are
   * constant, and the midpoint scheme keeps them.
   */
  template <int dim>
  class Momenta
  {
  public:
    /**
     * @param mass mass matrix of the equation of motion (kg).
     * @param small_strains take the lever arms in the reference position, as
     * linear elasticity balances them; otherwise in the current one.
     * @param n_parts of the body, of which only those from @p begin to before
     * @p end (or only that one) count, see Body::part(); nodes that they share count
     * once.
     */
    Momenta(const Body<dim>   &body,
            const BodyMatrix  &mass,
            const bool         small_strains,
            const unsigned int n_parts = 1,
            const unsigned int begin   = 0,
            const unsigned int end     = dealii::numbers::invalid_unsigned_int);

    /// kg; as a body in 2D, per length of its thickness.
    double
    mass_of_body() const;

    /// kg m/s
    dealii::Tensor<1, dim>
    linear(const Vector &velocity) const;

    /// About the origin (kg m^2/s); in 2D the third component is the only one.
    dealii::Tensor<1, 3>
    angular(const Vector &solution, const Vector &velocity) const;

  private:
    /// Make #of_translations and #of_rotations.
    void
    move_rigidly() const;

    /// Products of @p velocity with each of #of_translations or #of_rotations.
    std::vector<double>
    products(const std::vector<Vector> &motions, const Vector &velocity) const;

    const MPI_Comm                   communicator;
    const BodyMatrix                &mass;
    const bool                       small_strains;
    const std::vector<PartNode<dim>> nodes;
    // Momenta of the motions with unit velocity along each axis and unit angular
    // velocity about it, made when first asked for: their products with a velocity
    // are its momenta.
    mutable std::vector<Vector> of_translations, of_rotations;
    // Begin and end of this rank's nonzero entries of them.
    mutable unsigned int begin_of_motions = 0, end_of_motions = 0;
    mutable Vector       momentum;
  };
} // namespace Ricochet

#endif
