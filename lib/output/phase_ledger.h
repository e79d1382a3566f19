// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_phase_ledger_h
#define ricochet_output_phase_ledger_h

#include <base/program.h>

namespace Ricochet
{
  /**
   * The energy tables of all phases of a run as one, in the folder @p whole. Time and sums go
   * on from phase to phase. The columns are those of all phases; where a phase has no such
   * contact or probe, a sum stays and other values are missing. In front are
   *
   * - `phase`, its number: the last row of a phase and the first one of the next are of one
   *   time, as conditions change between them;
   * - `phase_change`, the sum of what these changes have done to the energy (J): the
   *   account of the whole run is
   *
   *       change of energy = works - dissipation + phase_change.
   *
   *   Energy is kinetic and stored. A support that is released, a contact that ends and
   *   another treatment change none of them; a motion that a static phase does not have, or
   *   springs that are taken out, are lost, and velocities that a phase gives are added.
   *
   * Fields of all phases are listed in `solution.pvd`, with these times.
   *
   * @throws InputError when a table is not there. Collective.
   */
  void
  join_phases(RunFolder &whole, const std::vector<PhaseResult> &phases);
} // namespace Ricochet

#endif
