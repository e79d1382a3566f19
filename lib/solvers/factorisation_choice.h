// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_factorisation_choice_h
#define ricochet_solvers_factorisation_choice_h

#include <cstddef>
#include <string>

namespace Ricochet
{
  /// Which LU factorisation is used for whole tangents.
  struct FactorisationChoice
  {
    /// "automatic", "KLU" or "MUMPS".
    std::string  wanted;
    unsigned int dim        = 0;
    std::size_t  n_unknowns = 0;

    /// "KLU" or "MUMPS".
    std::string
    name() const
    {
      if (wanted != "automatic")
        return wanted;
      return dim < 3 && n_unknowns < 20000 ? "KLU" : "MUMPS";
    }
  };
} // namespace Ricochet

#endif
