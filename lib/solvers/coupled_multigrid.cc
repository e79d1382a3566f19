// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/stopwatch.h>
#include <base/vector_operations.h>
#include <solvers/aggregation_parameters.h>
#include <solvers/coupled_multigrid.h>
#include <solvers/flexible_gmres.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/solver_control.h>

#include <EpetraExt_MatrixMatrix.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_Map.h>
#include <Epetra_Vector.h>

#include <algorithm>

namespace Ricochet
{
  using namespace dealii;

  CoupledMultigrid::CoupledMultigrid(CoarseSpace coarse_space)
    : space(std::move(coarse_space))
    , modes(values_of_modes(space))
  {
    AssertThrow(space.prolongation.m() == 0,
                ExcMessage("Bodies in contact are aggregated as they are."));
    displacement_part.reinit(space.rigid_body_modes[0]);
    displacement_result.reinit(space.rigid_body_modes[0]);
  }



  CoupledMultigrid::~CoupledMultigrid() = default;



  namespace
  {
    using EpetraIndex = TrilinosWrappers::types::int_type;

    EpetraIndex
    index_of(const Epetra_Map &map, const int row)
    {
      return static_cast<EpetraIndex>(map.GID64(row));
    }

    /// @p values of the rows of @p matrix, in the order of its local columns.
    Epetra_Vector
    in_columns(const Epetra_CrsMatrix &matrix, const Epetra_Vector &values)
    {
      Epetra_Vector result(matrix.ColMap());
      if (const Epetra_Import *importer = matrix.Importer())
        result.Import(values, *importer, Insert);
      else
        result = values;
      return result;
    }
  } // namespace



  void
  CoupledMultigrid::split()
  {
    const Epetra_CrsMatrix &all = matrix.trilinos_matrix();
    const int n_displacements   = displacement_part.locally_owned_size();
    const int n_multipliers     = all.NumMyRows() - n_displacements;
    if (!displacements)
      {
        displacements = std::make_unique<Epetra_Map>(EpetraIndex(-1),
                                                     n_displacements,
                                                     EpetraIndex(0),
                                                     all.Comm());
        multipliers   = std::make_unique<Epetra_Map>(EpetraIndex(-1),
                                                   n_multipliers,
                                                   EpetraIndex(0),
                                                   all.Comm());
      }

    // The number of each row among displacements, or a negative one among
    // multipliers. Numbers are integers, which a double represents exactly.
    Epetra_Vector number(all.RowMap());
    for (int row = 0; row < all.NumMyRows(); ++row)
      number[row] = row < n_displacements
        ? static_cast<double>(displacements->GID64(row))
        : -1. - static_cast<double>(multipliers->GID64(row - n_displacements));
    const Epetra_Vector numbers = in_columns(all, number);

    copy_body(numbers);
    from_multipliers =
      std::make_unique<Epetra_CrsMatrix>(Copy, *displacements, 0);
    to_multipliers = std::make_unique<Epetra_CrsMatrix>(Copy, *multipliers, 0);
    Epetra_Vector diagonal(all.RowMap());
    all.ExtractDiagonalCopy(diagonal);
    const Epetra_Vector      diagonals = in_columns(all, diagonal);
    std::vector<EpetraIndex> columns, multiplier_columns;
    std::vector<double>      values, multiplier_values;
    inverse_diagonal = std::make_unique<Epetra_Vector>(*multipliers);
    for (int row = 0; row < all.NumMyRows(); ++row)
      {
        int     n_entries = 0;
        double *entries   = nullptr;
        int    *indices   = nullptr;
        all.ExtractMyRowView(row, n_entries, entries, indices);
        columns.clear();
        values.clear();
        multiplier_columns.clear();
        multiplier_values.clear();
        // Compliance of the constraint with the stiffness of its nodes.
        double square = 0.;
        for (int k = 0; k < n_entries; ++k)
          if (const double column = numbers[indices[k]]; column >= 0.)
            {
              columns.push_back(static_cast<EpetraIndex>(column));
              values.push_back(entries[k]);
              square += entries[k] * entries[k] / diagonals[indices[k]];
            }
          else if (entries[k] != 0.)
            {
              multiplier_columns.push_back(
                static_cast<EpetraIndex>(-1. - column));
              multiplier_values.push_back(entries[k]);
            }
        if (row < n_displacements)
          {
            from_multipliers->InsertGlobalValues(index_of(*displacements, row),
                                                 multiplier_columns.size(),
                                                 multiplier_values.data(),
                                                 multiplier_columns.data());
            continue;
          }
        to_multipliers->InsertGlobalValues(index_of(*multipliers,
                                                    row - n_displacements),
                                           columns.size(),
                                           values.data(),
                                           columns.data());
        (*inverse_diagonal)[row - n_displacements] =
          1. / (diagonal[row] - square / local_values(*scaling)[row]);
      }
    from_multipliers->FillComplete(*multipliers, *displacements);
    to_multipliers->FillComplete(*displacements, *multipliers);
    multiplier_part = std::make_unique<Epetra_Vector>(*multipliers);
    work            = std::make_unique<Epetra_Vector>(*displacements);
  }



  void
  CoupledMultigrid::copy_body(const Epetra_Vector &numbers)
  {
    const Epetra_CrsMatrix &all = matrix.trilinos_matrix();
    const int  n_displacements  = displacement_part.locally_owned_size();
    const auto for_each_entry   = [&](const auto &action) {
      int    *indices   = nullptr;
      double *entries   = nullptr;
      int     n_entries = 0;
      for (int row = 0; row < n_displacements; ++row)
        {
          all.ExtractMyRowView(row, n_entries, entries, indices);
          for (int k = 0; k < n_entries; ++k)
            if (const double column = numbers[indices[k]]; column >= 0.)
              action(row, static_cast<EpetraIndex>(column), entries[k]);
        }
    };
    if (!body || pattern_of_body != pattern)
      {
        pattern_of_body = pattern;
        body = std::make_unique<Epetra_CrsMatrix>(Copy, *displacements, 0);
        std::vector<EpetraIndex> columns;
        std::vector<double>      zeros;
        int                      current = 0;
        const auto               insert  = [&]() {
          zeros.resize(columns.size());
          body->InsertGlobalValues(index_of(*displacements, current),
                                   columns.size(),
                                   zeros.data(),
                                   columns.data());
          columns.clear();
        };
        for_each_entry([&](const int row, const EpetraIndex column, double) {
          if (row != current)
            insert();
          current = row;
          columns.push_back(column);
        });
        if (n_displacements > 0)
          insert();
        body->FillComplete(*displacements, *displacements);
        places.clear();
        int    *begin = nullptr, *sorted = nullptr;
        double *values = nullptr;
        body->ExtractCrsDataPointers(begin, sorted, values);
        for_each_entry([&](const int row, const EpetraIndex column, double) {
          const int *const place = std::find(sorted + begin[row],
                                             sorted + begin[row + 1],
                                             body->LCID(column));
          Assert(place != sorted + begin[row + 1], ExcInternalError());
          places.push_back(place - sorted);
        });
      }
    int    *begin = nullptr, *sorted = nullptr;
    double *values = nullptr;
    body->ExtractCrsDataPointers(begin, sorted, values);
    std::size_t k = 0;
    for_each_entry([&](int, EpetraIndex, const double value) {
      values[places[k++]] = value;
    });
  }



  void
  CoupledMultigrid::set_up()
  {
    const Stopwatch stopwatch(spent.factorising);
    ++spent.n_factorisations;
    finest_level.reset();
    if (multipliers->NumGlobalElements64() == 0)
      schur_complement = std::make_unique<Epetra_CrsMatrix>(*body);
    else
      add_springs();
    auto list = aggregation_parameters(space, modes);
    // Two of ML's polynomials for all but the lowest twentieth of the spectrum need
    // more iterations (162 instead of 136), each of which takes longer.
    list.set("smoother: sweeps", 1);
    seed_aggregation(Utilities::MPI::this_mpi_process(
      displacement_part.get_mpi_communicator()));
    aggregation = std::make_unique<TrilinosWrappers::PreconditionAMG>();
    aggregation->initialize(*schur_complement, list);
    finest_level = std::make_unique<SingleFinestLevel>(
      *aggregation,
      MatrixEntries(*schur_complement),
      space.dim(),
      displacement_part.get_mpi_communicator());
  }



  void
  CoupledMultigrid::add_springs()
  {
    // A - G C~^-1 H.
    Epetra_CrsMatrix scaled(*to_multipliers);
    scaled.LeftScale(*inverse_diagonal);
    Epetra_CrsMatrix springs(Copy, *displacements, 0);
    int error = EpetraExt::MatrixMatrix::Multiply(*from_multipliers,
                                                  false,
                                                  scaled,
                                                  false,
                                                  springs);
    AssertThrow(error == 0, ExcTrilinosError(error));
    Epetra_CrsMatrix *sum = nullptr;
    error =
      EpetraExt::MatrixMatrix::Add(*body, false, 1., springs, false, -1., sum);
    AssertThrow(error == 0, ExcTrilinosError(error));
    schur_complement.reset(sum);
    schur_complement->FillComplete(*displacements, *displacements);
  }



  void
  CoupledMultigrid::vmult(Vector &result, const Vector &vector) const
  {
    // u = S^-1 (r_u - G C~^-1 r_m), m = C~^-1 (r_m - H u).
    const unsigned int n    = displacement_part.locally_owned_size();
    const unsigned int n_m  = multipliers->NumMyElements();
    const double      *from = local_values(vector);
    double            *to   = local_values(result);
    double            *part = local_values(displacement_part);
    for (unsigned int i = 0; i < n_m; ++i)
      (*multiplier_part)[i] = (*inverse_diagonal)[i] * from[n + i];
    from_multipliers->Multiply(false, *multiplier_part, *work);
    for (unsigned int i = 0; i < n; ++i)
      part[i] = from[i] - (*work)[i];
    aggregation->vmult(displacement_result, displacement_part);
    const double *solved = local_values(displacement_result);
    std::copy(solved, solved + n, to);
    std::copy(solved, solved + n, work->Values());
    to_multipliers->Multiply(false, *work, *multiplier_part);
    for (unsigned int i = 0; i < n_m; ++i)
      to[n + i] =
        (*inverse_diagonal)[i] * (from[n + i] - (*multiplier_part)[i]);
  }



  int
  CoupledMultigrid::iterate(const Vector &forces,
                            Vector       &solution,
                            const double  tolerance) const
  {
    solution = 0.;
    SolverControl control(400, tolerance);
    try
      {
        SolverFGMRES<Vector>(control, flexible_gmres_settings())
          .solve(matrix, solution, forces, *this);
      }
    catch (const SolverControl::NoConvergence &)
      {
        return -1;
      }
    return control.last_step();
  }



  bool
  CoupledMultigrid::solve(const Tangent &tangent,
                          const Vector  &right_hand_side,
                          Vector        &solution,
                          const bool     may_reuse,
                          const double   tolerance)
  {
    if (stage_begins || !may_reuse)
      {
        if (pattern != tangent.pattern)
          {
            matrix.clear();
            pattern = tangent.pattern;
          }
        assemble(tangent, matrix);
        scaling = tangent.row_scaling;
        const_cast<Epetra_CrsMatrix &>(matrix.trilinos_matrix())
          .LeftScale(*scaling->trilinos_vector()(0));
        split();
      }
    // The preconditioner is set up once for a stage, unless iterations become
    // too many; never for longer, so that results do not depend on the history.
    const bool is_first = stage_begins;
    stage_begins        = false;
    Vector forces(right_hand_side);
    forces.scale(*scaling);
    const double norm = forces.l2_norm();
    // A frozen tangent reduces the residual by about the factor of the last
    // iteration, or little more: a smaller tolerance is of no use.
    const double wanted = may_reuse && !is_first
      ? std::max(tolerance, std::min(.01 * norm / last_norm, 1e-2))
      : tolerance;
    last_norm           = norm;
    const auto go       = [&]() {
      const Stopwatch stopwatch(spent.substituting);
      return iterate(forces, solution, wanted * norm);
    };
    if (is_first)
      set_up();
    int n_iterations = go();
    if (is_first)
      budget.begin(n_iterations, wanted);
    else if (budget.is_exceeded(n_iterations, wanted))
      {
        // The next solution of this stage has a new preconditioner.
        set_up();
        if (n_iterations < 0)
          n_iterations = go();
      }
    return n_iterations >= 0;
  }
} // namespace Ricochet
