// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/vector_operations.h>
#include <solvers/factorisation.h>

#include <Amesos.h>
#include <Eigen/CholmodSupport>
#include <Epetra_LinearProblem.h>

#include <algorithm>
#include <cmath>
#include <numeric>

extern "C"
{
  // BLAS
  void
  dgemv_(const char   *transpose,
         const int    *n_rows,
         const int    *n_columns,
         const double *factor,
         const double *matrix,
         const int    *stride,
         const double *vector,
         const int    *step,
         const double *old_factor,
         double       *result,
         const int    *result_step);
  void
  dtrsm_(const char   *side,
         const char   *triangle,
         const char   *transpose,
         const char   *diagonal,
         const int    *n_rows,
         const int    *n_columns,
         const double *factor,
         const double *matrix,
         const int    *stride,
         double       *result,
         const int    *result_stride);
  void
  dgemm_(const char   *transpose_left,
         const char   *transpose_right,
         const int    *n_rows,
         const int    *n_columns,
         const int    *n_inner,
         const double *factor,
         const double *left,
         const int    *left_stride,
         const double *right,
         const int    *right_stride,
         const double *old_factor,
         double       *result,
         const int    *result_stride);
}

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    class LUFactorisation : public Factorisation
    {
    public:
      explicit LUFactorisation(const std::string &package)
        : package(package)
      {}

      bool
      factorise(const Matrix &matrix, const bool keep_pivots) override
      {
        int error = 0;
        Assert(!solver || entries == entries_of(matrix),
               ExcMessage("Another matrix needs a factorisation of its own."));
        if (!solver)
          {
            entries = entries_of(matrix);
            problem = std::make_unique<Epetra_LinearProblem>();
            problem->SetOperator(
              const_cast<Epetra_CrsMatrix *>(&matrix.trilinos_matrix()));
            const std::string name = "Amesos_" + package;
            solver.reset(Amesos().Create(name, *problem));
            AssertThrow(solver,
                        ExcMessage("Trilinos was built without " + name));
            error = solver->SymbolicFactorization();
          }
        else if (package == "Mumps" && !keep_pivots)
          // MUMPS looks at the values already when it orders the unknowns.
          error = solver->SymbolicFactorization();
        // KLU looks at its pivots and chooses others when they are no longer
        // good.
        Teuchos::ParameterList list;
        list.set("Refactorize", keep_pivots);
        solver->SetParameters(list);
        if (error == 0)
          error = solver->NumericFactorization();
        if (error != 0)
          solver.reset();
        return error == 0;
      }

      void
      solve(const Vector &right_hand_side, Vector &solution) override
      {
        problem->SetLHS(&solution.trilinos_vector());
        problem->SetRHS(const_cast<Epetra_MultiVector *>(
          static_cast<const Epetra_MultiVector *>(
            &right_hand_side.trilinos_vector())));
        if (solver->Solve() != 0)
          throw NewtonFailure("The linear system cannot be solved.");
      }

      using Factorisation::solve;

    private:
      /// Where the entries of a matrix lie, to which the packages keep pointers.
      static const double *
      entries_of(const Matrix &matrix)
      {
        int    *row_start = nullptr, *columns = nullptr;
        double *values = nullptr;
        matrix.trilinos_matrix().ExtractCrsDataPointers(row_start,
                                                        columns,
                                                        values);
        return values;
      }

      const std::string                     package;
      const double                         *entries = nullptr;
      std::unique_ptr<Epetra_LinearProblem> problem;
      std::unique_ptr<Amesos_BaseSolver>    solver;
    };



    /// A matrix is S + C, with S symmetric and C the couplings of one side.
    /// With C = 0 in the unknowns that it leads to, (S + C) x = f is solved by
    /// x = S^{-1} (f - C S^{-1} f).
    class CholeskyFactorisation : public Factorisation
    {
    public:
      explicit CholeskyFactorisation(const bool approximate)
        : approximate(approximate)
      {}

      bool
      factorise(const Matrix &matrix, const bool /*keep_pivots*/) override
      {
        int    *row_start = nullptr, *columns = nullptr;
        double *values = nullptr;
        if (matrix.trilinos_matrix().ExtractCrsDataPointers(row_start,
                                                            columns,
                                                            values) != 0)
          throw ComputationError("The matrix is not stored in one piece.");
        if (symmetric.rows() == 0)
          find_pattern(matrix, row_start, columns);

        // Rows of multipliers may be negative definite.
        const int n = symmetric.rows();
        for (int i = 0; i < n; ++i)
          sign[i] = values[diagonal[i]] < 0. ? -1. : 1.;
        one_sided.clear();
        double *entry        = symmetric.valuePtr();
        bool    is_symmetric = true;
        couples_signs        = false;
        for (std::size_t k = 0; k < places.size(); ++k)
          {
            const Place &place = places[k];
            const double below = sign[place.row] * values[place.below];
            const double above = sign[place.column] * values[place.above];
            entry[k]           = .5 * (below + above);
            couples_signs |= sign[place.row] != sign[place.column] &&
              (below != 0. || above != 0.);
            // Round-off is no asymmetry.
            if (std::abs(below - above) <= 1e-10 *
                  std::sqrt(std::abs(values[diagonal[place.row]] *
                                     values[diagonal[place.column]])))
              continue;
            if (below != 0. && above != 0.)
              {
                is_symmetric = false;
                continue;
              }
            entry[k] = 0.;
            one_sided.push_back(
              above == 0. ? Coupling{place.row, place.column, k, below}
                          : Coupling{place.column, place.row, k, above});
          }
        if (!approximate && !is_symmetric)
          return false;
        if (!has_own_equations())
          {
            if (!approximate)
              return false;
            for (const Coupling &coupling : one_sided)
              entry[coupling.entry] = .5 * coupling.value;
            one_sided.clear();
          }
        // Bodies that do not change are factored once and solved with often, best by
        // dense blocks; of others, the factor has to be at hand column by column.
        if (!is_analysed)
          analyse(!approximate);
        cholesky.factorize(symmetric);
        if (cholesky.info() != Eigen::Success && prefers_blocks)
          {
            // It may be indefinite.
            analyse(false);
            cholesky.factorize(symmetric);
          }
        if (cholesky.info() != Eigen::Success)
          return false;
        find_supernodes();
        return true;
      }

      const TriangularFactor<float> *
      triangular_factor() override
      {
        const cholmod_factor *factor = cholesky.factor();
        if (factor->is_super || factor->itype != CHOLMOD_INT ||
            factor->dtype != CHOLMOD_DOUBLE)
          return nullptr;
        rough = std::make_unique<TriangularFactor<float>>(
          TriangularFactor<float>::Columns{
            static_cast<int>(factor->n),
            static_cast<const int *>(factor->Perm),
            static_cast<const int *>(factor->p),
            static_cast<const int *>(factor->p),
            static_cast<const int *>(factor->nz),
            static_cast<const int *>(factor->i),
            static_cast<const double *>(factor->x),
            factor->is_ll != 0,
            sign.data()});
        return rough.get();
      }

      bool
      has_halves() const override
      {
        return !supernode_of.empty() && one_sided.empty() && !couples_signs;
      }

      void
      go_forwards(const Vector        &right_hand_side,
                  std::vector<double> &half) override
      {
        const int     n      = symmetric.rows();
        const double *values = right_hand_side.trilinos_vector()[0];
        work.resize(n);
        for (int i = 0; i < n; ++i)
          work[i] = sign[i] * values[i];
        accurate_factor().go_forwards(work.data(), half);
        for (int k = 0; k < n; ++k)
          half[k] /= diagonal_of_factor[k];
      }

      HalfColumns
      go_forwards(const Functionals &right_hand_sides) override
      {
        HalfColumns       half;
        std::vector<bool> is_needed(supernodes.size(), false);
        for (const Index unknown : right_hand_sides.index)
          is_needed[supernode_of[place_in_factor[unknown]]] = true;
        half.region    = with_ancestors(is_needed);
        half.n_columns = right_hand_sides.size();
        // Place of a supernode in the region less that in the factor.
        std::vector<int> shift(supernodes.size());
        int              n_rows = 0;
        for (const int s : half.region)
          {
            half.first_row.push_back(n_rows);
            shift[s] = n_rows - supernodes[s].first_column;
            n_rows += supernodes[s].n_columns;
          }
        half.first_row.push_back(n_rows);
        const auto row_of = [&](const int place) {
          return half.values.data() +
            static_cast<std::size_t>(place + shift[supernode_of[place]]) *
            half.n_columns;
        };
        half.values.assign(static_cast<std::size_t>(n_rows) * half.n_columns,
                           0.);
        for (int c = 0; c < half.n_columns; ++c)
          for (std::size_t k = right_hand_sides.begin[c];
               k < right_hand_sides.begin[c + 1];
               ++k)
            row_of(place_in_factor[right_hand_sides.index[k]])[c] +=
              right_hand_sides.value[k];

        // A row has all columns beside each other, so what BLAS sees is the
        // transposed.
        const double        one = 1., zero = 0.;
        std::vector<double> below_columns(
          static_cast<std::size_t>(largest_below) * half.n_columns);
        for (const int s : half.region)
          {
            const Supernode &node = supernodes[s];
            double          *own  = row_of(node.first_column);
            dtrsm_("R",
                   "L",
                   "T",
                   "N",
                   &half.n_columns,
                   &node.n_columns,
                   &one,
                   node.values,
                   &node.n_rows,
                   own,
                   &half.n_columns);
            const int n_below = node.n_below();
            if (n_below == 0)
              continue;
            dgemm_("N",
                   "T",
                   &half.n_columns,
                   &n_below,
                   &node.n_columns,
                   &one,
                   own,
                   &half.n_columns,
                   node.values + node.n_columns,
                   &node.n_rows,
                   &zero,
                   below_columns.data(),
                   &half.n_columns);
            const double *change = below_columns.data();
            for (int i = 0; i < n_below; ++i)
              {
                double *row = row_of(node.rows[node.n_columns + i]);
                for (int c = 0; c < half.n_columns; ++c)
                  row[c] -= *change++;
              }
          }
        return half;
      }

      void
      multiply(const HalfColumns   &left,
               const HalfColumns   &right,
               std::vector<double> &products) const override
      {
        products.assign(static_cast<std::size_t>(left.n_columns) *
                          right.n_columns,
                        0.);
        const std::vector<double> *right_values = &right.values;
        std::vector<double>        signed_values;
        if (!negative.empty())
          {
            signed_values = right.values;
            right_values  = &signed_values;
            change_signs(right, [&](const int row) {
              double *values =
                &signed_values[static_cast<std::size_t>(row) * right.n_columns];
              for (int c = 0; c < right.n_columns; ++c)
                values[c] = -values[c];
            });
          }
        const double      one     = 1.;
        const std::size_t n_left  = left.region.size(),
                          n_right = right.region.size();
        for (std::size_t l = 0, r = 0; l < n_left && r < n_right;)
          {
            if (left.region[l] != right.region[r])
              {
                ++(left.region[l] < right.region[r] ? l : r);
                continue;
              }
            // As far as both go the same way.
            const std::size_t first_l = l, first_r = r;
            while (l < n_left && r < n_right &&
                   left.region[l] == right.region[r])
              {
                ++l;
                ++r;
              }
            const int  n_rows = left.first_row[l] - left.first_row[first_l];
            const auto row    = [](const HalfColumns         &half,
                                const std::vector<double> &values,
                                const std::size_t          k) {
              return values.data() +
                static_cast<std::size_t>(half.first_row[k]) * half.n_columns;
            };
            dgemm_("N",
                   "T",
                   &left.n_columns,
                   &right.n_columns,
                   &n_rows,
                   &one,
                   row(left, left.values, first_l),
                   &left.n_columns,
                   row(right, *right_values, first_r),
                   &right.n_columns,
                   &one,
                   products.data(),
                   &left.n_columns);
          }
      }

      void
      observe(const HalfColumns         &columns,
              const std::vector<double> &half,
              double                    *values) const override
      {
        // In one piece, so that BLAS is called once.
        seen_half.resize(columns.first_row.back());
        for_each_node(columns,
                      [&](const int n, const int first, const int row) {
                        std::copy_n(half.data() + first,
                                    n,
                                    seen_half.data() + row);
                      });
        multiply_by("N", columns, seen_half.data(), values);
      }

      void
      subtract(const HalfColumns   &columns,
               const double        *coefficients,
               std::vector<double> &half) const override
      {
        seen_half.resize(columns.first_row.back());
        multiply_by("T", columns, coefficients, seen_half.data());
        change_signs(columns,
                     [&](const int row) { seen_half[row] = -seen_half[row]; });
        for_each_node(columns,
                      [&](const int n, const int first, const int row) {
                        for (int i = 0; i < n; ++i)
                          half[first + i] -= seen_half[row + i];
                      });
      }

      void
      go_backwards(const std::vector<double> &half, Vector &solution) override
      {
        work = half;
        for (std::size_t k = 0; k < half.size(); ++k)
          work[k] *= diagonal_of_factor[k];
        accurate_factor().go_backwards(work, solution.trilinos_vector()[0]);
      }

      void
      solve(const Vector &right_hand_side, Vector &solution) override
      {
        const int n = symmetric.rows();
        right.resize(n, 1);
        right.col(0) = entries(right_hand_side);
        back_substitute();
        entries(solution) = result.col(0);
      }

      void
      solve(const std::vector<Vector> &right_hand_sides,
            std::vector<Vector>       &solutions) override
      {
        const int n = symmetric.rows();
        right.resize(n, right_hand_sides.size());
        for (unsigned int c = 0; c < right_hand_sides.size(); ++c)
          right.col(c) = entries(right_hand_sides[c]);
        back_substitute();
        for (unsigned int c = 0; c < right_hand_sides.size(); ++c)
          entries(solutions[c]) = result.col(c);
      }

    private:
      /// Gives access to the factor.
      struct Cholesky
        : Eigen::CholmodDecomposition<Eigen::SparseMatrix<double>, Eigen::Lower>
      {
        const cholmod_factor *
        factor() const
        {
          return m_cholmodFactor;
        }
      };

      /// Columns of the factor with the same rows below them, as CHOLMOD keeps them:
      /// a dense matrix of all these rows, the columns' own ones first.
      struct Supernode
      {
        int           first_column, n_columns, n_rows;
        const int    *rows;
        const double *values;
        /// The one to which the first row below belongs; -1: none.
        int parent;

        int
        n_below() const
        {
          return n_rows - n_columns;
        }
      };

      /// None where the factor has none.
      void
      find_supernodes()
      {
        supernodes.clear();
        supernode_of.clear();
        accurate.reset();
        const cholmod_factor *factor = cholesky.factor();
        if (!factor->is_super || !factor->is_ll ||
            factor->itype != CHOLMOD_INT || factor->dtype != CHOLMOD_DOUBLE)
          return;
        const auto *order = static_cast<const int *>(factor->Perm);
        place_in_factor.resize(factor->n);
        negative.clear();
        for (unsigned int k = 0; k < factor->n; ++k)
          {
            place_in_factor[order[k]] = k;
            if (sign[order[k]] < 0.)
              negative.push_back(k);
          }
        const auto *first       = static_cast<const int *>(factor->super);
        const auto *first_row   = static_cast<const int *>(factor->pi);
        const auto *first_value = static_cast<const int *>(factor->px);
        const auto *rows        = static_cast<const int *>(factor->s);
        const auto *values      = static_cast<const double *>(factor->x);
        supernode_of.resize(factor->n);
        largest_below = 0;
        for (unsigned int s = 0; s < factor->nsuper; ++s)
          {
            supernodes.push_back({first[s],
                                  first[s + 1] - first[s],
                                  first_row[s + 1] - first_row[s],
                                  rows + first_row[s],
                                  values + first_value[s],
                                  -1});
            for (int column = first[s]; column < first[s + 1]; ++column)
              supernode_of[column] = s;
            largest_below =
              std::max(largest_below, supernodes.back().n_below());
          }
        for (Supernode &node : supernodes)
          if (node.n_below() > 0)
            node.parent = supernode_of[node.rows[node.n_columns]];
      }

      /// The supernodal factor in the order in which single right hand sides pass
      /// through it, made when it is first asked for.
      const TriangularFactor<double> &
      accurate_factor()
      {
        if (!accurate)
          {
            const cholmod_factor *factor = cholesky.factor();
            const auto           *begin  = static_cast<const int *>(factor->pi);
            const auto       *entries    = static_cast<const int *>(factor->px);
            const std::size_t n          = factor->n;
            std::vector<int>  first_row(n), first_value(n), n_entries(n);
            diagonal_of_factor.resize(n);
            for (std::size_t column = 0; column < n; ++column)
              {
                const int        s         = supernode_of[column];
                const Supernode &node      = supernodes[s];
                const int        k         = column - node.first_column;
                first_row[column]          = begin[s] + k;
                first_value[column]        = entries[s] + k * (node.n_rows + 1);
                n_entries[column]          = node.n_rows - k;
                diagonal_of_factor[column] = node.values[k * (node.n_rows + 1)];
              }
            const std::vector<double> no_signs(n, 1.);
            accurate = std::make_unique<TriangularFactor<double>>(
              TriangularFactor<double>::Columns{
                static_cast<int>(n),
                static_cast<const int *>(factor->Perm),
                first_row.data(),
                first_value.data(),
                n_entries.data(),
                static_cast<const int *>(factor->s),
                static_cast<const double *>(factor->x),
                true,
                no_signs.data()});
          }
        return *accurate;
      }

      /// The supernodes that are needed, and all that come after them, in their order.
      std::vector<int>
      with_ancestors(std::vector<bool> &is_needed) const
      {
        std::vector<int> region;
        for (unsigned int s = 0; s < supernodes.size(); ++s)
          if (is_needed[s])
            {
              region.push_back(s);
              if (supernodes[s].parent >= 0)
                is_needed[supernodes[s].parent] = true;
            }
        return region;
      }

      /// Call @p action(n_rows, first, row) for the supernodes of the columns: their
      /// rows from @p row on are those of the unknowns from @p first on, in the order of
      /// the factor.
      template <typename Action>
      void
      for_each_node(const HalfColumns &columns, const Action &action) const
      {
        for (std::size_t k = 0; k < columns.region.size(); ++k)
          {
            const Supernode &node = supernodes[columns.region[k]];
            action(node.n_columns, node.first_column, columns.first_row[k]);
          }
      }

      /// Call @p action(row) for the rows of the columns of which the sign is negative.
      template <typename Action>
      void
      change_signs(const HalfColumns &columns, const Action &action) const
      {
        if (negative.empty())
          return;
        for_each_node(columns,
                      [&](const int n, const int first, const int row) {
                        for (auto place = std::lower_bound(negative.begin(),
                                                           negative.end(),
                                                           first);
                             place != negative.end() && *place < first + n;
                             ++place)
                          action(row + *place - first);
                      });
      }

      /// @p result = the columns' values times @p vector; as they are stored, with rows
      /// for columns and columns for rows, or with "T" transposed.
      static void
      multiply_by(const char        *transpose,
                  const HalfColumns &columns,
                  const double      *vector,
                  double            *result)
      {
        const int    n_rows = columns.first_row.back(), one = 1;
        const double plus_one = 1., zero = 0.;
        dgemv_(transpose,
               &columns.n_columns,
               &n_rows,
               &plus_one,
               columns.values.data(),
               &columns.n_columns,
               vector,
               &one,
               &zero,
               result,
               &one);
      }

      /// Where an entry of the lower triangle and its mirror image are among
      /// the values of the matrix.
      struct Place
      {
        int row, column, below, above;
      };

      struct Coupling
      {
        int row, column;
        /// Place among the values of #symmetric.
        std::size_t entry;
        double      value;
      };

      /// From all columns of #right to those of #result.
      void
      back_substitute()
      {
        right  = sign.asDiagonal() * right;
        result = cholesky.solve(right);
        // Again for the columns that have couplings of one side.
        std::vector<int> coupled;
        for (int c = 0; c < right.cols(); ++c)
          {
            bool is_coupled = false;
            for (const Coupling &coupling : one_sided)
              if (result(coupling.column, c) != 0.)
                {
                  right(coupling.row, c) -=
                    coupling.value * result(coupling.column, c);
                  is_coupled = true;
                }
            if (is_coupled)
              coupled.push_back(c);
          }
        if (coupled.empty())
          return;
        Eigen::MatrixXd again(right.rows(), coupled.size());
        for (unsigned int k = 0; k < coupled.size(); ++k)
          again.col(k) = right.col(coupled[k]);
        again = cholesky.solve(again).eval();
        for (unsigned int k = 0; k < coupled.size(); ++k)
          result.col(coupled[k]) = again.col(k);
      }

      void
      find_pattern(const Matrix &matrix,
                   const int    *row_start,
                   const int    *columns)
      {
        using EpetraIndex  = TrilinosWrappers::types::int_type;
        const auto &epetra = matrix.trilinos_matrix();
        AssertThrow(epetra.Comm().NumProc() == 1,
                    ExcMessage("CHOLMOD works on one rank."));
        const int n = epetra.NumMyRows();
        // Columns have an order of their own, even on one rank.
        std::vector<int> unknown_of(epetra.NumMyCols());
        for (unsigned int c = 0; c < unknown_of.size(); ++c)
          unknown_of[c] =
            epetra.LRID(static_cast<EpetraIndex>(epetra.GCID64(c)));

        // What is on and below the diagonal, by columns. Rows rise in each of them, for
        // they are gone through in their order.
        symmetric.resize(n, n);
        int *begin = symmetric.outerIndexPtr();
        std::fill_n(begin, n + 1, 0);
        for (int i = 0; i < n; ++i)
          for (int k = row_start[i]; k < row_start[i + 1]; ++k)
            if (unknown_of[columns[k]] <= i)
              ++begin[unknown_of[columns[k]] + 1];
        std::partial_sum(begin, begin + n + 1, begin);
        symmetric.resizeNonZeros(begin[n]);
        places.resize(begin[n]);
        diagonal.resize(n);
        std::vector<int> end(begin, begin + n);
        for (int i = 0; i < n; ++i)
          for (int k = row_start[i]; k < row_start[i + 1]; ++k)
            if (const int j = unknown_of[columns[k]]; j <= i)
              {
                symmetric.innerIndexPtr()[end[j]] = i;
                places[end[j]]                    = {i, j, k, -1};
                ++end[j];
                if (i == j)
                  diagonal[i] = k;
              }

        // Their mirror images, above the diagonal.
        std::vector<std::pair<int, int>> above;
        for (int j = 0; j < n; ++j)
          {
            above.clear();
            for (int k = row_start[j]; k < row_start[j + 1]; ++k)
              if (unknown_of[columns[k]] >= j)
                above.emplace_back(unknown_of[columns[k]], k);
            std::sort(above.begin(), above.end());
            bool is_symmetric =
              static_cast<int>(above.size()) == begin[j + 1] - begin[j];
            for (std::size_t a = 0; is_symmetric && a < above.size(); ++a)
              {
                Place &place = places[begin[j] + a];
                is_symmetric = place.row == above[a].first;
                place.above  = above[a].second;
              }
            AssertThrow(is_symmetric,
                        ExcMessage("The pattern is not symmetric."));
          }
        sign.resize(n);
      }

      /// @param prefer_blocks a supernodal factor of all but small matrices. Without it,
      /// where it is made faster: never in the plane, always in 3D.
      void
      analyse(const bool prefer_blocks)
      {
        // Operations per entry of the factor.
        cholesky.cholmod().supernodal_switch = prefer_blocks ? 10. : 200.;
        cholesky.analyzePattern(symmetric);
        is_analysed    = true;
        prefers_blocks = prefer_blocks;
      }

      /// Whether the unknowns from which couplings of one side lead are not
      /// coupled to others in any other way.
      bool
      has_own_equations()
      {
        if (one_sided.empty())
          return true;
        std::vector<bool> leads(symmetric.rows(), false);
        for (const Coupling &coupling : one_sided)
          leads[coupling.column] = true;
        for (const Coupling &coupling : one_sided)
          if (leads[coupling.row])
            return false;
        const double *entry = symmetric.valuePtr();
        for (std::size_t k = 0; k < places.size(); ++k)
          if (entry[k] != 0. && leads[places[k].row] != leads[places[k].column])
            return false;
        return true;
      }

      const bool                  approximate;
      Eigen::SparseMatrix<double> symmetric;
      std::vector<Place>          places;
      std::vector<int>            diagonal;
      std::vector<Coupling>       one_sided;
      Eigen::VectorXd             sign;
      // Whether an entry is between unknowns of both signs.
      bool            couples_signs = false;
      Eigen::MatrixXd right, result;
      Cholesky        cholesky;
      bool            is_analysed = false, prefers_blocks = false;
      std::unique_ptr<TriangularFactor<float>>  rough;
      std::unique_ptr<TriangularFactor<double>> accurate;
      // Of a supernodal factor; by its order of the unknowns.
      std::vector<Supernode> supernodes;
      std::vector<int>       supernode_of, place_in_factor;
      // Places of unknowns whose sign is.
      std::vector<int> negative;
      int              largest_below = 0;
      // In the order of the factor.
      std::vector<double>         diagonal_of_factor;
      std::vector<double>         work;
      mutable std::vector<double> seen_half;
    };
  } // namespace



  void
  Factorisation::solve(const std::vector<Vector> &right_hand_sides,
                       std::vector<Vector>       &solutions)
  {
    for (unsigned int c = 0; c < right_hand_sides.size(); ++c)
      solve(right_hand_sides[c], solutions[c]);
  }



  std::unique_ptr<Factorisation>
  make_lu_factorisation(const std::string &package)
  {
    return std::make_unique<LUFactorisation>(package == "KLU" ? "Klu"
                                                              : "Mumps");
  }



  std::unique_ptr<Factorisation>
  make_cholesky_factorisation(const bool approximate)
  {
    return std::make_unique<CholeskyFactorisation>(approximate);
  }
} // namespace Ricochet
