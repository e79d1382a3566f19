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
   * The part of a body where its tangent K differs most from a frozen tangent T. The
   * changes of an impact within a step are near the contact, and so are the residuals
   * that T leaves; a small system with K in that region corrects them.
   *
   * With the displacements d of the region R determined by K and the derivatives C and
   * E of contact (see Tangent::differentiate_contact) for a residual r, with all other
   * displacements fixed,
   *
   *     (K + E K + C)_RR d = -r_R,
   *
   * and a step of T for the remaining residual, both steps together are one step of T
   * for the force
   *
   *     r + (K - T) d,
   *
   * as contact eliminates its rows from the remaining residual.
   */
  class TangentRegion
  {
  public:
    TangentRegion();
    ~TangentRegion();

    /**
     * Choose the region: the unknowns with the largest twentieth of the entries of
     * @p residual, and those coupled to them by contact. The region is empty if the
     * small system is singular.
     *
     * @param residual residual in the rows of forces (N), after a few steps of
     * T.
     * @param contact provides C and E.
     * @param kept provides T.
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

    /// Replace the entries r of a @p force (N) by r + (K - T) d. @pre exists().
    void
    complete(std::vector<double> &force) const;

  private:
    struct SmallSystem;

    std::unique_ptr<SmallSystem> small;
    Matrix                       difference;
  };
} // namespace Ricochet

#endif
