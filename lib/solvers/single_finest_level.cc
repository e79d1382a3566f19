// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/single_finest_level.h>
#include <solvers/single_precision.h>

#include <deal.II/base/mpi.h>

#include <ml_MultiLevelPreconditioner.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    double
    linfty_norm(const MatrixEntries &matrix, const MPI_Comm communicator)
    {
      double largest = 0.;
      for (unsigned int r = 0; r < matrix.n_rows(); ++r)
        {
          double sum = 0.;
          for (int k = matrix.begin[r]; k < matrix.begin[r + 1]; ++k)
            sum += std::abs(matrix.value[k]);
          largest = std::max(largest, sum);
        }
      return Utilities::MPI::max(largest, communicator);
    }
  } // namespace



  SingleFinestLevel::SingleFinestLevel(
    TrilinosWrappers::PreconditionAMG &aggregation,
    const MatrixEntries               &exact,
    const unsigned int                 dim,
    const MPI_Comm                     communicator)
    : matrix(
        std::make_shared<BlockPattern>(std::vector<MatrixEntries>{exact},
                                       std::vector<types::global_dof_index>(),
                                       dim,
                                       communicator))
    , scale(size_for_single_precision(linfty_norm(exact, communicator)))
  {
    matrix.add(1. / scale, exact);
    from.reinit(matrix.pattern()->partitioner);
    to.reinit(matrix.pattern()->partitioner);

    const auto *ml = dynamic_cast<const ML_Epetra::MultiLevelPreconditioner *>(
      &aggregation.trilinos_operator());
    AssertThrow(ml, ExcMessage("deal.II's aggregation is not that of ML."));
    const ML *hierarchy = ml->GetML();
    level               = &hierarchy->Amat[hierarchy->ML_finest_level];
    data_of_level       = level->data;
    product_of_level    = level->matvec->func_ptr;
    // ML needs rows and diagonals only when it is set up.
    level->data             = this;
    level->matvec->func_ptr = &SingleFinestLevel::multiply;
  }



  SingleFinestLevel::~SingleFinestLevel()
  {
    level->data             = data_of_level;
    level->matvec->func_ptr = product_of_level;
  }



  int
  SingleFinestLevel::multiply(ML_Operator *level,
                              int /*n_columns*/,
                              double *vector,
                              int     n_rows,
                              double *result)
  {
    auto &self = *static_cast<SingleFinestLevel *>(level->data);
    // The same on all ranks, which exchange scaled values.
    double largest = 0.;
    for (int i = 0; i < n_rows; ++i)
      largest = std::max(largest, std::abs(vector[i]));
    const double size = size_for_single_precision(Utilities::MPI::max(
      largest,
      self.matrix.pattern()->partitioner->get_mpi_communicator()));
    for (int i = 0; i < n_rows; ++i)
      self.from.local_element(i) = static_cast<float>(vector[i] / size);
    self.matrix.vmult(self.to, self.from);
    for (int i = 0; i < n_rows; ++i)
      result[i] = self.to.local_element(i) * size * self.scale;
    return 1;
  }
} // namespace Ricochet
