// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <time_integration/state.h>

namespace Ricochet
{
  State &
  State::operator=(const State &other)
  {
    if (this == &other)
      return *this;
    time        = other.time;
    step_before = other.step_before;
    for (Vector State::*const part : {&State::solution,
                                      &State::velocity,
                                      &State::acceleration,
                                      &State::contact_force,
                                      &State::mean_velocity,
                                      &State::scheme_force,
                                      &State::friction_force,
                                      &State::viscous_force,
                                      &State::solution_before,
                                      &State::velocity_before})
      if ((other.*part).size() > 0)
        copy_values(other.*part, this->*part);
    contact_shares.resize(other.contact_shares.size());
    for (unsigned int k = 0; k < contact_shares.size(); ++k)
      copy_values(other.contact_shares[k], contact_shares[k]);
    return *this;
  }
} // namespace Ricochet
