// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_threads_h
#define ricochet_base_threads_h

#include <functional>
#include <vector>

namespace Ricochet
{
  /**
   * Threads of a rank, for work in independent parts: bodies between contacts,
   * and contact points against facets. Ranks are what large problems are
   * distributed over (MPI); threads are for cores that would be idle otherwise,
   * as all but one are where a program is started without MPI.
   *
   * Parts are chosen such that results are the same to the last digit, however many
   * threads there are.
   *
   * Threads are those of OpenMP, which wait actively for the next part for a
   * moment before they sleep; OMP_NUM_THREADS bounds their number.
   */
  namespace Threads
  {
    /**
     * To be called once MPI has begun: as many threads as the environment
     * allows; if it sets none, this rank's part of the cores that it may run
     * on. Without this call there is one.
     *
     * Libraries are not to begin threads of OpenMP themselves (CHOLMOD asks for four
     * whatever the environment says, which wait more than they work).
     */
    void
    begin();

    /// Number of threads; within a part, one.
    unsigned int
    number();

    /// Set their number, for a comparison. @return what it was.
    unsigned int
    set_number(const unsigned int n_threads);

    /// Call @p action(part) for each part < @p n_parts, on several threads.
    /// @throws what the first part threw that did; where there is more than one thread,
    /// after the others have ended.
    void
    for_each_part(const unsigned int                             n_parts,
                  const std::function<void(const unsigned int)> &action);

    /**
     * Cut a range into as many parts as there are threads, about the same in work, at
     * some places only.
     *
     * @param cuts the places, rising, from the beginning of the range to its end.
     * @param work for all that is before each of them.
     * @return the beginning of each part, and the end of the last one.
     */
    std::vector<unsigned int>
    balanced_parts(const std::vector<unsigned int> &cuts,
                   const std::vector<double>       &work);

    /// Call @p action(begin, end) for these parts; for the whole range where there is less
    /// work than @p smallest, which is done before another thread has begun.
    void
    for_each_balanced_part(
      const std::vector<unsigned int> &cuts,
      const std::vector<double>       &work,
      const double                     smallest,
      const std::function<void(const unsigned int, const unsigned int)>
        &action);

    /// Call @p action(begin, end) for parts of the range from 0 to @p n, which may be cut
    /// anywhere: none is shorter than @p smallest, unless it is the only one.
    void
    for_each_range(const unsigned int                             n,
                   const unsigned int                             smallest,
                   const std::function<void(const unsigned int,
                                            const unsigned int)> &action);
  } // namespace Threads
} // namespace Ricochet

#endif
