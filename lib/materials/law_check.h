// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_law_check_h
#define ricochet_materials_law_check_h

#include <materials/hyperelastic_law.h>

#include <string>

namespace Ricochet
{
  /**
   * Check a hyperelastic law that somebody has written: energy and stress are zero at rest, where
   * shear and bulk moduli are positive; gradient and Hessian are the derivatives of
   * energy and gradient, by quotients of differences at two strains of some per cent. Without
   * this check a wrong law would run, while its balance of energy closes.
   *
   * @param name of the law, for messages.
   * @throws InputError that says which of its functions is wrong, and by how much.
   */
  void
  check_law(const HyperelasticLaw &law, const std::string &name);
} // namespace Ricochet

#endif
