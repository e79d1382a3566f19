// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_functional_places_h
#define ricochet_solvers_functional_places_h

#include <solvers/tangent.h>

#include <vector>

namespace Ricochet
{
  /// @return the place of each functional among all of them by their @p order; what is
  /// equal stays in its order.
  std::vector<unsigned int>
  places_in_order(const std::vector<double> &order);

  /// @return the functionals of all ranks, one rank's behind the other's. Collective.
  Functionals
  functionals_of_all_ranks(const Functionals &own, const MPI_Comm communicator);

  /// The functionals of all ranks have numbers, one rank's behind the other's, and places,
  /// by their order.
  struct FunctionalPlaces
  {
    FunctionalPlaces() = default;

    /// Collective.
    FunctionalPlaces(const ContactStructure::ActsThrough &contact,
                     const MPI_Comm                       communicator);

    /// Place of functional @p f that this rank knows: its own ones, then those elsewhere.
    unsigned int
    place(const unsigned int f) const
    {
      return place_of_number[numbers[f]];
    }

    /// By functional that this rank knows, and by number.
    std::vector<unsigned int> numbers, place_of_number;
  };
} // namespace Ricochet

#endif
