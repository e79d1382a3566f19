// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <time_integration/kept_tangent.h>

#include <deal.II/base/mpi.h>

namespace Ricochet
{
  using namespace dealii;

  KeptTangent &
  KeptTangent::operator=(const KeptTangent &other)
  {
    record = other.record;
    if (other.solution.size() > 0)
      copy_values(other.solution, solution);
    return *this;
  }



  bool
  KeptTangent::is_same(const KeptTangent &other) const
  {
    if (record.end_time != other.record.end_time ||
        record.time_step != other.record.time_step ||
        solution.size() != other.solution.size())
      return false;
    const bool same = entries(solution) == entries(other.solution);
    return Utilities::MPI::min(same ? 1 : 0, solution.get_mpi_communicator()) ==
      1;
  }



  void
  KeptTangent::begin(const double  end_time,
                     const double  time_step,
                     const Vector &solution_at_begin)
  {
    record           = {};
    record.end_time  = end_time;
    record.time_step = time_step;
    copy_values(solution_at_begin, solution);
  }



  void
  KeptTangent::count(const unsigned int n_iterations)
  {
    if (record.n_steps == 0)
      record.first_iterations = n_iterations;
    else if (n_iterations > record.first_iterations)
      record.more_iterations += n_iterations - record.first_iterations;
    record.last_iterations = n_iterations;
    ++record.n_steps;
  }



  bool
  KeptTangent::serves(const double time_step) const
  {
    if (!exists() || record.time_step != time_step)
      return false;
    if (record.last_iterations <= record.first_iterations)
      return true;
    // States go away from it at an even pace.
    const double n_steps   = record.n_steps;
    const double next_more = n_steps / (n_steps - 1.) *
      (record.last_iterations - record.first_iterations);
    return next_more <= (cost + record.more_iterations) / n_steps;
  }
} // namespace Ricochet
