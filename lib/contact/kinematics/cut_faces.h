// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_cut_faces_h
#define ricochet_contact_kinematics_cut_faces_h

#include <contact/kinematics/contact_points.h>
#include <contact/surfaces/contact_pair.h>
#include <materials/linear_elastic.h>

#include <map>
#include <set>
#include <utility>
#include <vector>

namespace Ricochet
{
  /**
   * Quadrature points between two linear elastic bodies, for treatments that
   * integrate over the faces of the contact boundary: each face of the slave is cut
   * at the ends of the facets of the master that face it, projected along its
   * normal, and each piece has its own quadrature points. On a piece all integrands
   * are polynomials, so that a uniform pressure passes exactly between meshes that
   * do not match.
   *
   * With the outward normal n of the facet of the master, the point x of the slave
   * meets the point x - gap n of the line of that facet; both are those of the
   * undeformed bodies and constant, as in the theory of small displacements. So the gap
   * is an affine function of the unknowns of both,
   *
   *     gap = initial gap + n . (u_slave - u_master),
   *
   * and exactly the distance from a flat master that does not turn, whatever the shape
   * of the slave. (Along the normal of a curved slave it is not: a distance between
   * inclined lines is no linear function of the approach.) So laws, time schemes and
   * energies are those against a plane at rest. The sum of the forces and that of their
   * moments about the undeformed positions are zero, since both points are on one
   * normal; but friction across a gap that has closed causes an unbalanced couple,
   * traction times initial gap.
   *
   * The stress pressure is the mean of both sides' -n . sigma n, n being the slave's
   * normal there, weighted by the modulus lambda + 2 mu of the other one, so that the
   * stress of the softer body prevails (Burman and Zunino, SIAM J. Numer. Anal. 44,
   * 2006, with moduli for diffusivities). h_T is the smaller one of both sides.
   */
  template <int dim>
  struct CutFaces
  {
    ContactPoints points;
    /// Area of the whole slave, by boundary id (m^(dim-1)).
    std::map<dealii::types::boundary_id, double> slave_area;
    /// Pairs of parts (material ids) that meet.
    std::set<std::pair<unsigned int, unsigned int>> parts;

    /**
     * Constructor. Collective.
     *
     * @param materials by material id, or one for all.
     * @throws InputError when the faces of a pair nowhere overlap.
     */
    CutFaces(const Body<dim>                  &body,
             const std::vector<LinearElastic> &materials,
             const std::vector<ContactPair>   &pairs);

    /// The weight of the stress of the first of two materials.
    static double
    stress_weight(const LinearElastic &own, const LinearElastic &other)
    {
      const double own_modulus   = own.lambda + 2. * own.mu;
      const double other_modulus = other.lambda + 2. * other.mu;
      return other_modulus / (own_modulus + other_modulus);
    }
  };
} // namespace Ricochet

#endif
