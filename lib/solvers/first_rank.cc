// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/first_rank.h>

#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>

namespace Ricochet
{
  using namespace dealii;

  const Epetra_CrsMatrix &
  FirstRank::gather(const Epetra_CrsMatrix &matrix)
  {
    const bool is_new = !exchange;
    if (is_new)
      {
        communicator =
          dynamic_cast<const Epetra_MpiComm &>(matrix.Comm()).Comm();
        is_first = Utilities::MPI::this_mpi_process(communicator) == 0;
        IndexSet rows(matrix.NumGlobalRows64());
        if (is_first)
          rows.add_range(0, rows.size());
        gathered_vector.reinit(rows, communicator);
        vector_to_scatter.reinit(rows, communicator);
        const Epetra_Map map = rows.make_trilinos_map(communicator);
        exchange = std::make_unique<Epetra_Import>(map, matrix.RowMap());
        all_rows = std::make_unique<Epetra_CrsMatrix>(Copy, map, 0);
      }
    int error = all_rows->Import(matrix, *exchange, Insert);
    if (is_new && error == 0)
      error = all_rows->FillComplete();
    AssertThrow(error == 0, ExcTrilinosError(error));
    return *all_rows;
  }



  const Vector &
  FirstRank::gather(const Vector &vector)
  {
    const int error =
      gathered_vector.trilinos_vector().Import(vector.trilinos_vector(),
                                               *exchange,
                                               Insert);
    AssertThrow(error == 0, ExcTrilinosError(error));
    return gathered_vector;
  }



  void
  FirstRank::scatter_result(Vector &vector) const
  {
    const int error =
      vector.trilinos_vector().Export(vector_to_scatter.trilinos_vector(),
                                      *exchange,
                                      Insert);
    AssertThrow(error == 0, ExcTrilinosError(error));
  }



  void
  FirstRank::broadcast(double *values, const std::size_t n) const
  {
    Utilities::MPI::broadcast(values, n, 0, communicator);
  }



  bool
  FirstRank::knows(const bool is_true) const
  {
    return Utilities::MPI::max(is_first && is_true ? 1 : 0, communicator) == 1;
  }
} // namespace Ricochet
