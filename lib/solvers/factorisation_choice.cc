// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/factorisation_choice.h>
#include <solvers/gathered_factorisation.h>

namespace Ricochet
{
  std::string
  FactorisationChoice::name(const bool symmetric) const
  {
    if (symmetric &&
        (wanted == "CHOLMOD" ||
         (wanted == "automatic" &&
          (n_ranks == 1 || n_unknowns < (dim < 3 ? 100000 : 30000)))))
      return "CHOLMOD";
    if (wanted == "KLU" || wanted == "MUMPS")
      return wanted;
    return dim < 3 && n_unknowns < 20000 ? "KLU" : "MUMPS";
  }



  std::unique_ptr<Factorisation>
  FactorisationChoice::make(const bool symmetric, const bool approximate) const
  {
    const std::string chosen = name(symmetric);
    if (chosen != "CHOLMOD")
      return make_lu_factorisation(chosen);
    if (is_gathered(symmetric))
      return std::make_unique<GatheredFactorisation>(
        make_cholesky_factorisation(approximate));
    return make_cholesky_factorisation(approximate);
  }
} // namespace Ricochet
