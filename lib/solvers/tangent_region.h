// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_tangent_region_h
#define ricochet_solvers_tangent_region_h

#include <solvers/contact_schur_complement.h>
#include <solvers/functionals.h>
#include <solvers/tangent.h>

#include <functional>
#include <memory>
#include <vector>

namespace Ricochet
{
  /**
   * The part of a body where its tangent K differs most from another tangent T, with
   * which systems are solved in its place. What an impact changes within a step is near
   * where the bodies touch, and so is what T leaves of a residual; there a small system
   * with K tells T what it does not know.
   *
   * With the displacements d of the region R that K and the derivatives C and E of contact
   * (see Tangent::differentiate_contact) find for a residual r, while all
   * else is held,
   *
   *     (K + E K + C)_RR d = -r_R,
   *
   * and a step of T for what they leave over, both steps together are one step of T for
   * the force
   *
   *     r + (K - T) d,
   *
   * as contact takes its rows out of what that leaves over.
   */
  class TangentRegion
  {
  public:
    TangentRegion();
    ~TangentRegion();

    /**
     * Look for the region anew: the unknowns with a twentieth of all entries of @p
     * residual, the largest ones, and what contact couples with them. There is none if the
     * small system is singular.
     *
     * @param residual of the rows of forces (N), after a few steps of T.
     * @param contact has C and E.
     * @param kept has T.
     * @param add_difference adds K - T to a matrix with the pattern of T: the rows and the
     * columns of these unknowns at least.
     */
    void
    find(
      const Vector                                             &residual,
      const Tangent                                            &contact,
      const ContactSchurComplement                             &kept,
      const std::function<void(const UnknownList &, Matrix &)> &add_difference);

    void
    forget();

    bool
    exists() const;

    /// Make r + (K - T) d of the entries r of a @p force (N). @pre exists().
    void
    complete(std::vector<double> &force) const;

  private:
    struct SmallSystem;

    std::unique_ptr<SmallSystem> small;
    Matrix                       difference;
  };
} // namespace Ricochet

#endif
