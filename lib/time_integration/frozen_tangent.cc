// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <time_integration/frozen_tangent.h>

namespace Ricochet
{
  FrozenTangent &
  FrozenTangent::operator=(const FrozenTangent &other)
  {
    record = other.record;
    if (other.solution.size() > 0)
      copy_values(other.solution, solution);
    return *this;
  }



  bool
  FrozenTangent::is_same(const FrozenTangent &other) const
  {
    if (record.end_time != other.record.end_time ||
        record.time_step != other.record.time_step ||
        solution.size() != other.solution.size())
      return false;
    return entries(solution) == entries(other.solution);
  }



  void
  FrozenTangent::begin(const double  end_time,
                       const double  time_step,
                       const Vector &solution_at_begin)
  {
    record           = {};
    record.end_time  = end_time;
    record.time_step = time_step;
    copy_values(solution_at_begin, solution);
  }



  void
  FrozenTangent::count(const unsigned int n_iterations)
  {
    if (record.n_steps == 0)
      record.first_iterations = n_iterations;
    else if (n_iterations > record.first_iterations)
      record.more_iterations += n_iterations - record.first_iterations;
    record.last_iterations = n_iterations;
    ++record.n_steps;
  }



  bool
  FrozenTangent::serves(const double time_step) const
  {
    if (!exists() || record.time_step != time_step)
      return false;
    if (record.last_iterations <= record.first_iterations)
      return true;
    // States move away from that of the tangent at an even rate.
    const double n_steps   = record.n_steps;
    const double next_more = n_steps / (n_steps - 1.) *
      (record.last_iterations - record.first_iterations);
    return next_more <= (cost + record.more_iterations) / n_steps;
  }
} // namespace Ricochet
