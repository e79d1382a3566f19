// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_factorisation_choice_h
#define ricochet_solvers_factorisation_choice_h

#include <solvers/factorisation.h>

#include <memory>
#include <string>

namespace Ricochet
{
  /// Which factorisation is used for which matrices.
  struct FactorisationChoice
  {
    /// "automatic", "CHOLMOD", "KLU" or "MUMPS".
    std::string  wanted;
    unsigned int dim        = 0;
    std::size_t  n_unknowns = 0;
    unsigned int n_ranks    = 1;

    /// @param symmetric the matrix is, or its symmetric part will do.
    std::string
    name(const bool symmetric) const;

    /// Whether one of several ranks does it for all.
    bool
    is_gathered(const bool symmetric) const
    {
      return n_ranks > 1 && name(symmetric) == "CHOLMOD";
    }

    /// @param approximate the symmetric part of the matrix will do.
    std::unique_ptr<Factorisation>
    make(const bool symmetric, const bool approximate = false) const;
  };
} // namespace Ricochet

#endif
