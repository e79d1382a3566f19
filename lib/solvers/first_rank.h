// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_first_rank_h
#define ricochet_solvers_first_rank_h

#include <base/exceptions.h>
#include <base/types.h>

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>

#include <memory>
#include <string>

namespace Ricochet
{
  /**
   * What is on several ranks, gathered on the first one, and what is found out there
   * given to the others. Bodies of some ten thousand unknowns are factored and solved for
   * much faster by one rank than by all together, whose messages take longer than
   * their work.
   *
   * All functions are collective.
   */
  class FirstRank
  {
  public:
    /// Whether this rank is the first one, known since there was a matrix.
    bool
    is_here() const
    {
      return is_first;
    }

    /// @return all rows of @p matrix; on other ranks, none. The same pattern each time.
    const Epetra_CrsMatrix &
    gather(const Epetra_CrsMatrix &matrix);

    /// @return all of a @p vector over these rows; on other ranks, nothing.
    const Vector &
    gather(const Vector &vector);

    /// Where the first rank may put such a vector.
    Vector &
    result()
    {
      return vector_to_scatter;
    }

    /// @param vector gets its part of result().
    void
    scatter_result(Vector &vector) const;

    /// Call @p action on the first rank. @throws NewtonFailure on all ranks, if it does
    /// so there.
    template <typename Action>
    void
    run(const Action &action) const
    {
      std::string failure;
      if (is_first)
        try
          {
            action();
          }
        catch (const NewtonFailure &error)
          {
            failure = error.what();
          }
      if (knows(!failure.empty()))
        throw NewtonFailure(
          dealii::Utilities::MPI::broadcast(communicator, failure));
    }

    /// Let all ranks have @p n numbers of the first one.
    void
    broadcast(double *values, const std::size_t n) const;

    /// Whether it is true on the first rank.
    bool
    knows(const bool is_true) const;

  private:
    MPI_Comm communicator = MPI_COMM_NULL;
    bool     is_first     = false;
    // From the rows of all ranks to those that the first one has here.
    std::unique_ptr<Epetra_Import>    exchange;
    std::unique_ptr<Epetra_CrsMatrix> all_rows;
    Vector                            gathered_vector, vector_to_scatter;
  };
} // namespace Ricochet

#endif
