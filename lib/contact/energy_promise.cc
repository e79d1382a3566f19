// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/energy_promise.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  std::string
  EnergyPromise::verb() const
  {
    switch (kind)
      {
        case Kind::keeps:
          return "keeps";
        case Kind::never_gains:
          return "never gains";
        default:
          return "promises nothing";
      }
  }



  EnergyPromise
  keeps_by_quotient()
  {
    return {EnergyPromise::Kind::keeps,
            "the pressure is the quotient of potential and gap increment, so "
            "that its work is the change of the potential"};
  }



  EnergyPromise
  keeps_by_no_work()
  {
    return {EnergyPromise::Kind::keeps,
            "pressure times gap increment is zero in each point, so that "
            "contact does no work"};
  }



  EnergyPromise
  falls_by_convexity()
  {
    return {EnergyPromise::Kind::never_gains,
            "the force is the slope, at the end of the step, of a potential "
            "that is convex in the gap: the potential grows by no more than "
            "the work"};
  }



  EnergyPromise
  falls_by_complementarity()
  {
    return {EnergyPromise::Kind::never_gains,
            "where there is pressure the gap is zero at the end of the step, "
            "and was not negative at its beginning, so that its increment is "
            "not positive"};
  }



  EnergyPromise
  EnergyPromise::and_also(const EnergyPromise &other) const
  {
    return static_cast<int>(other.kind) > static_cast<int>(kind) ? other
                                                                 : *this;
  }



  void
  ContactStep::add_point(const double       amount,
                         const Point<3>    &where,
                         const unsigned int part_of_point)
  {
    made += amount;
    if (std::abs(amount) > std::abs(made_at_point))
      {
        made_at_point = amount;
        place         = where;
        part          = part_of_point;
      }
  }



  void
  ContactStep::unite(const ContactStep &other)
  {
    made += other.made;
    n_dropped += other.n_dropped;
    n_entered += other.n_entered;
    if (n_passed == 0)
      place_passed = other.place_passed;
    n_passed += other.n_passed;
    if (std::abs(other.made_at_point) > std::abs(made_at_point))
      {
        made_at_point = other.made_at_point;
        place         = other.place;
        part          = other.part;
      }
  }



  ContactSteps
  reduce_steps(const ContactSteps &mine, const MPI_Comm communicator)
  {
    ContactSteps all;
    for (const auto &[id, step] : mine)
      all[id] = step;
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      return all;
    // Few numbers, sent as lists of doubles: id, amounts, position, counts.
    std::vector<double> numbers;
    for (const auto &[id, step] : mine)
      numbers.insert(numbers.end(),
                     {static_cast<double>(id),
                      step.made,
                      step.made_at_point,
                      step.place[0],
                      step.place[1],
                      step.place[2],
                      static_cast<double>(step.part),
                      static_cast<double>(step.n_dropped),
                      static_cast<double>(step.n_entered),
                      static_cast<double>(step.n_passed),
                      step.place_passed[0],
                      step.place_passed[1],
                      step.place_passed[2]});
    all.clear();
    for (const auto &list : Utilities::MPI::all_gather(communicator, numbers))
      for (unsigned int k = 0; k + 13 <= list.size(); k += 13)
        {
          ContactStep step;
          step.made          = list[k + 1];
          step.made_at_point = list[k + 2];
          step.place         = Point<3>(list[k + 3], list[k + 4], list[k + 5]);
          step.part          = static_cast<unsigned int>(list[k + 6]);
          step.n_dropped     = static_cast<unsigned int>(list[k + 7]);
          step.n_entered     = static_cast<unsigned int>(list[k + 8]);
          step.n_passed      = static_cast<unsigned int>(list[k + 9]);
          step.place_passed =
            Point<3>(list[k + 10], list[k + 11], list[k + 12]);
          all[static_cast<unsigned int>(list[k])].unite(step);
        }
    return all;
  }
} // namespace Ricochet
