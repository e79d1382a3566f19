// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/factorisation_choice.h>

namespace Ricochet
{
  std::string
  FactorisationChoice::name(const bool symmetric) const
  {
    if (symmetric && n_ranks == 1 &&
        (wanted == "automatic" || wanted == "CHOLMOD"))
      return "CHOLMOD";
    if (wanted == "KLU" || wanted == "MUMPS")
      return wanted;
    return dim < 3 && n_unknowns < 20000 ? "KLU" : "MUMPS";
  }



  std::unique_ptr<Factorisation>
  FactorisationChoice::make(const bool symmetric, const bool approximate) const
  {
    const std::string chosen = name(symmetric);
    return chosen == "CHOLMOD" ? make_cholesky_factorisation(approximate)
                               : make_lu_factorisation(chosen);
  }
} // namespace Ricochet
