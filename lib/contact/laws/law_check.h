// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_laws_law_check_h
#define ricochet_contact_laws_law_check_h

#include <contact/laws/contact_law.h>

#include <string>

namespace Ricochet
{
  /**
   * Check a contact law that somebody has written, at some penetrations and gaps between a thousandth and a
   * tenth of @p cell_diameter (m): the force is the derivative of the potential, by quotients of
   * differences, where the law depends on the gap alone; it presses, where the traits need
   * that; the tangent is the derivative of the force, and is the same within a branch
   * where the law says so. Without this check a wrong law would run, with another energy or
   * without quadratic convergence.
   *
   * @param name of the law, for messages.
   * @throws InputError that says what is wrong, and by how much.
   */
  void
  check_law(const ContactLaw  &law,
            const std::string &name,
            const double       cell_diameter);
} // namespace Ricochet

#endif
