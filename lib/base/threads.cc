// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/one_rank.h>
#include <base/threads.h>

#include <deal.II/base/mpi.h>

#include <dlfcn.h>
#include <omp.h>

#include <algorithm>
#include <cstdlib>
#include <exception>

namespace Ricochet
{
  namespace
  {
    unsigned int n_threads = 1;

    /// OpenBLAS has threads of its own, which keep the cores busy between the
    /// small products of our solvers and slow down the other threads.
    void
    stop_threads_of_blas()
    {
      using SetNumber = void (*)(int);
      if (const auto set_number = reinterpret_cast<SetNumber>(
            dlsym(RTLD_DEFAULT, "openblas_set_num_threads")))
        set_number(1);
    }

    /// Ranks on this machine. Collective.
    unsigned int
    n_ranks_here()
    {
      MPI_Comm here;
      MPI_Comm_split_type(OneRank::communicator(),
                          MPI_COMM_TYPE_SHARED,
                          0,
                          MPI_INFO_NULL,
                          &here);
      const unsigned int n = dealii::Utilities::MPI::n_mpi_processes(here);
      MPI_Comm_free(&here);
      return n;
    }
  } // namespace



  void
  Threads::begin()
  {
    stop_threads_of_blas();
    omp_set_max_active_levels(0);
    const unsigned int n_ranks = n_ranks_here();
    const unsigned int n_cores = omp_get_num_procs();
    // OpenMP has read the environment.
    n_threads = std::getenv("OMP_NUM_THREADS") != nullptr
      ? std::max(1, omp_get_max_threads())
      : std::max(1u, n_cores / n_ranks);
  }



  unsigned int
  Threads::number()
  {
    return omp_in_parallel() != 0 ? 1 : n_threads;
  }



  unsigned int
  Threads::set_number(const unsigned int n)
  {
    const unsigned int before = n_threads;
    n_threads                 = n;
    return before;
  }



  void
  Threads::for_each_part(const unsigned int                             n_parts,
                         const std::function<void(const unsigned int)> &action)
  {
    const unsigned int n_used = std::min(number(), n_parts);
    if (n_used <= 1)
      {
        for (unsigned int part = 0; part < n_parts; ++part)
          action(part);
        return;
      }
    std::vector<std::exception_ptr> errors(n_parts);
    omp_set_max_active_levels(1);
#pragma omp parallel for num_threads(n_used) schedule(dynamic, 1)
    for (unsigned int part = 0; part < n_parts; ++part)
      {
        try
          {
            action(part);
          }
        catch (...)
          {
            errors[part] = std::current_exception();
          }
      }
    omp_set_max_active_levels(0);
    for (const std::exception_ptr &error : errors)
      if (error)
        std::rethrow_exception(error);
  }



  std::vector<unsigned int>
  Threads::balanced_parts(const std::vector<unsigned int> &cuts,
                          const std::vector<double>       &work)
  {
    const unsigned int        n_parts = number();
    std::vector<unsigned int> begin{cuts.front()};
    for (unsigned int part = 1; part < n_parts; ++part)
      {
        // The cut that is nearest to where the part would end.
        const double wanted = work.back() * part / n_parts;
        auto after = std::lower_bound(work.begin(), work.end() - 1, wanted);
        if (after != work.begin() && wanted - *(after - 1) < *after - wanted)
          --after;
        const unsigned int cut = cuts[after - work.begin()];
        if (cut > begin.back() && cut < cuts.back())
          begin.push_back(cut);
      }
    begin.push_back(cuts.back());
    return begin;
  }



  void
  Threads::for_each_balanced_part(
    const std::vector<unsigned int>                                   &cuts,
    const std::vector<double>                                         &work,
    const double                                                       smallest,
    const std::function<void(const unsigned int, const unsigned int)> &action)
  {
    if (number() == 1 || cuts.size() <= 2 || work.back() < smallest)
      return action(cuts.front(), cuts.back());
    const auto parts = balanced_parts(cuts, work);
    for_each_part(parts.size() - 1, [&](const unsigned int part) {
      action(parts[part], parts[part + 1]);
    });
  }



  void
  Threads::for_each_range(
    const unsigned int                                                 n,
    const unsigned int                                                 smallest,
    const std::function<void(const unsigned int, const unsigned int)> &action)
  {
    // A few parts for each thread, as they do not take equally long.
    const unsigned int n_parts = number() == 1
      ? 1
      : std::max(1u, std::min(4 * number(), n / std::max(1u, smallest)));
    for_each_part(n_parts, [&](const unsigned int part) {
      const auto place = [&](const unsigned int p) -> unsigned int {
        return static_cast<unsigned long>(n) * p / n_parts;
      };
      action(place(part), place(part + 1));
    });
  }
} // namespace Ricochet
