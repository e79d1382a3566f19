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

      using Factorisation::factorise;

      bool
      factorise(const Epetra_CrsMatrix &matrix, const bool keep_pivots) override
      {
        int error = 0;
        Assert(!solver || entries == entries_of(matrix),
               ExcMessage("Another matrix needs a factorisation of its own."));
        if (!solver)
          {
            entries = entries_of(matrix);
            problem = std::make_unique<Epetra_LinearProblem>();
            problem->SetOperator(const_cast<Epetra_CrsMatrix *>(&matrix));
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
      entries_of(const Epetra_CrsMatrix &matrix)
      {
        int    *row_start = nullptr, *columns = nullptr;
        double *values = nullptr;
        matrix.ExtractCrsDataPointers(row_start, columns, values);
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

      using Factorisation::factorise;

      bool
      factorise(const Epetra_CrsMatrix &matrix,
                const bool /*keep_pivots*/) override
      {
        int      *row_start = nullptr, *columns = nullptr;
        double   *values = nullptr;
        const int error =
          matrix.ExtractCrsDataPointers(row_start, columns, values);
        AssertThrow(error == 0,
                    ExcMessage("The matrix is not stored in one piece."));
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
        const double *values = right_hand_side.trilinos_vector()[0];
        if (!negative.empty())
          {
            work.assign(values, values + symmetric.rows());
            for (std::size_t i = 0; i < work.size(); ++i)
              work[i] *= sign[i];
            values = work.data();
          }
        accurate_factor().go_half_way(values, half);
      }

      HalfColumns
      go_forwards(const Functionals &right_hand_sides) override
      {
        HalfColumns half = find_ways(right_hand_sides);
        // Place of a member of the region in it, of a column in its piece, and of the
        // first row below all others.
        std::vector<int>         member_of(supernodes.size(), -1);
        std::vector<std::size_t> piece_of(half.region.size());
        std::vector<int> place_in_piece(half.pieces.size() * half.n_columns);
        for (std::size_t p = 0; p < half.pieces.size(); ++p)
          {
            const HalfColumns::Piece &piece = half.pieces[p];
            for (std::size_t k = piece.begin; k < piece.end; ++k)
              {
                member_of[half.region[k]] = k;
                piece_of[k]               = p;
              }
            for (std::size_t c = piece.begin_column; c < piece.end_column; ++c)
              place_in_piece[p * half.n_columns + half.columns[c]] =
                c - piece.begin_column;
          }
        // A row has all columns of its piece beside each other.
        struct Row
        {
          double    *values;
          const int *place_of_column;
        };
        const auto row_at = [&](const int place) -> Row {
          const int                 s = supernode_of[place], k = member_of[s];
          const HalfColumns::Piece &piece = half.pieces[piece_of[k]];
          const int row = half.first_row[k] - half.first_row[piece.begin] +
            place - supernodes[s].first_column;
          return {half.values.data() + piece.first_value +
                    static_cast<std::size_t>(row) * piece.n_columns(),
                  place_in_piece.data() + piece_of[k] * half.n_columns};
        };
        for (int c = 0; c < half.n_columns; ++c)
          for (std::size_t k = right_hand_sides.begin[c];
               k < right_hand_sides.begin[c + 1];
               ++k)
            {
              const Row row =
                row_at(place_in_factor[right_hand_sides.index[k]]);
              row.values[row.place_of_column[c]] += right_hand_sides.value[k];
            }

        // What BLAS sees is the transposed.
        const double        one = 1., zero = 0.;
        std::vector<double> below_columns(
          static_cast<std::size_t>(largest_below) * half.n_columns);
        for (std::size_t k = 0; k < half.region.size(); ++k)
          {
            const Supernode          &node  = supernodes[half.region[k]];
            const HalfColumns::Piece &piece = half.pieces[piece_of[k]];
            const int    *columns   = half.columns.data() + piece.begin_column;
            const int     n_columns = piece.n_columns();
            double *const own       = row_at(node.first_column).values;
            dtrsm_("R",
                   "L",
                   "T",
                   "N",
                   &n_columns,
                   &node.n_columns,
                   &one,
                   node.values,
                   &node.n_rows,
                   own,
                   &n_columns);
            const int n_below = node.n_below();
            if (n_below == 0)
              continue;
            dgemm_("N",
                   "T",
                   &n_columns,
                   &n_below,
                   &node.n_columns,
                   &one,
                   own,
                   &n_columns,
                   node.values + node.n_columns,
                   &node.n_rows,
                   &zero,
                   below_columns.data(),
                   &n_columns);
            const double *change = below_columns.data();
            for (int i = 0; i < n_below; ++i)
              {
                const Row row = row_at(node.rows[node.n_columns + i]);
                for (int c = 0; c < n_columns; ++c)
                  row.values[row.place_of_column[columns[c]]] -= *change++;
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
            std::vector<double> sign_of(right.first_row.back(), 1.);
            change_signs(right, [&](const int row) { sign_of[row] = -1.; });
            for (const HalfColumns::Piece &piece : right.pieces)
              rows_of(right, signed_values, piece).array().rowwise() *=
                Eigen::Map<const Eigen::ArrayXd>(sign_of.data() +
                                                   right.first_row[piece.begin],
                                                 n_rows_of(right, piece))
                  .transpose();
          }
        Eigen::MatrixXd part;
        std::size_t     l = 0, r = 0;
        for (auto of_left  = left.pieces.begin(),
                  of_right = right.pieces.begin();
             of_left != left.pieces.end() && of_right != right.pieces.end();)
          {
            // As far as both go the same way.
            while (l < of_left->end && r < of_right->end &&
                   left.region[l] != right.region[r])
              ++(left.region[l] < right.region[r] ? l : r);
            const std::size_t first_l = l, first_r = r;
            while (l < of_left->end && r < of_right->end &&
                   left.region[l] == right.region[r])
              {
                ++l;
                ++r;
              }
            if (l > first_l)
              {
                const int n_rows = left.first_row[l] - left.first_row[first_l];
                part.noalias()   = rows_of(left, left.values, *of_left)
                                   .middleCols(left.first_row[first_l] -
                                                 left.first_row[of_left->begin],
                                               n_rows) *
                  rows_of(right, *right_values, *of_right)
                    .middleCols(right.first_row[first_r] -
                                  right.first_row[of_right->begin],
                                n_rows)
                    .transpose();
                for (int j = 0; j < part.cols(); ++j)
                  {
                    double *const column = products.data() +
                      static_cast<std::size_t>(
                        right.columns[of_right->begin_column + j]) *
                        left.n_columns;
                    for (int i = 0; i < part.rows(); ++i)
                      column[left.columns[of_left->begin_column + i]] +=
                        part(i, j);
                  }
              }
            const bool left_ends = l == of_left->end;
            if (r == of_right->end)
              ++of_right;
            if (left_ends)
              ++of_left;
          }
      }

      void
      observe(const HalfColumns         &columns,
              const std::vector<double> &half,
              double                    *values) const override
      {
        gather(columns, half);
        std::fill_n(values, columns.n_columns, 0.);
        for (const HalfColumns::Piece &piece : columns.pieces)
          {
            of_columns.noalias() =
              rows_of(columns, columns.values, piece) *
              Eigen::Map<const Eigen::VectorXd>(
                seen_half.data() + columns.first_row[piece.begin],
                n_rows_of(columns, piece));
            for (int c = 0; c < piece.n_columns(); ++c)
              values[columns.columns[piece.begin_column + c]] += of_columns[c];
          }
      }

      void
      subtract(const HalfColumns   &columns,
               const double        *coefficients,
               std::vector<double> &half) const override
      {
        seen_half.resize(columns.first_row.back());
        for (const HalfColumns::Piece &piece : columns.pieces)
          {
            of_columns.resize(piece.n_columns());
            for (int c = 0; c < piece.n_columns(); ++c)
              of_columns[c] =
                coefficients[columns.columns[piece.begin_column + c]];
            Eigen::Map<Eigen::VectorXd>(seen_half.data() +
                                          columns.first_row[piece.begin],
                                        n_rows_of(columns, piece))
              .noalias() =
              rows_of(columns, columns.values, piece).transpose() * of_columns;
          }
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
        accurate_factor().go_other_half_way(half,
                                            work,
                                            solution.trilinos_vector()[0]);
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
            for (std::size_t column = 0; column < n; ++column)
              {
                const int        s    = supernode_of[column];
                const Supernode &node = supernodes[s];
                const int        k    = column - node.first_column;
                first_row[column]     = begin[s] + k;
                first_value[column]   = entries[s] + k * (node.n_rows + 1);
                n_entries[column]     = node.n_rows - k;
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

      /// The supernodes that each of the @p right_hand_sides goes through on its way to
      /// the last one, and places for what it leaves there: zeros.
      HalfColumns
      find_ways(const Functionals &right_hand_sides) const
      {
        HalfColumns half;
        half.n_columns = right_hand_sides.size();
        std::vector<std::vector<bool>> goes_through(supernodes.size());
        const auto                     ways_of = [&](const int s) -> auto &
        {
          goes_through[s].resize(half.n_columns, false);
          return goes_through[s];
        };
        for (int c = 0; c < half.n_columns; ++c)
          for (std::size_t k = right_hand_sides.begin[c];
               k < right_hand_sides.begin[c + 1];
               ++k)
            ways_of(
              supernode_of[place_in_factor[right_hand_sides.index[k]]])[c] =
              true;
        half.first_row.push_back(0);
        std::size_t n_values = 0;
        for (unsigned int s = 0; s < supernodes.size(); ++s)
          {
            const std::vector<bool> &own = goes_through[s];
            if (own.empty())
              continue;
            if (supernodes[s].parent >= 0)
              {
                std::vector<bool> &next = ways_of(supernodes[s].parent);
                for (int c = 0; c < half.n_columns; ++c)
                  next[c] = next[c] || own[c];
              }
            if (half.region.empty() || own != goes_through[half.region.back()])
              {
                const std::size_t first = half.columns.size();
                for (int c = 0; c < half.n_columns; ++c)
                  if (own[c])
                    half.columns.push_back(c);
                half.pieces.push_back({half.region.size(),
                                       half.region.size(),
                                       first,
                                       half.columns.size(),
                                       n_values});
              }
            HalfColumns::Piece &piece = half.pieces.back();
            half.region.push_back(s);
            half.first_row.push_back(half.first_row.back() +
                                     supernodes[s].n_columns);
            n_values += static_cast<std::size_t>(supernodes[s].n_columns) *
              piece.n_columns();
            ++piece.end;
          }
        half.values.assign(n_values, 0.);
        return half;
      }

      static int
      n_rows_of(const HalfColumns &columns, const HalfColumns::Piece &piece)
      {
        return columns.first_row[piece.end] - columns.first_row[piece.begin];
      }

      /// A matrix of the @p values of @p piece, with a row for each of its columns and a
      /// column for each of its rows.
      static Eigen::Map<const Eigen::MatrixXd>
      rows_of(const HalfColumns         &columns,
              const std::vector<double> &values,
              const HalfColumns::Piece  &piece)
      {
        return {values.data() + piece.first_value,
                piece.n_columns(),
                n_rows_of(columns, piece)};
      }

      static Eigen::Map<Eigen::MatrixXd>
      rows_of(const HalfColumns        &columns,
              std::vector<double>      &values,
              const HalfColumns::Piece &piece)
      {
        return {values.data() + piece.first_value,
                piece.n_columns(),
                n_rows_of(columns, piece)};
      }

      /// #seen_half = the values of @p half where @p columns are, in one piece.
      void
      gather(const HalfColumns &columns, const std::vector<double> &half) const
      {
        seen_half.resize(columns.first_row.back());
        for_each_node(columns,
                      [&](const int n, const int first, const int row) {
                        std::copy_n(half.data() + first,
                                    n,
                                    seen_half.data() + row);
                      });
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
      find_pattern(const Epetra_CrsMatrix &matrix,
                   const int              *row_start,
                   const int              *columns)
      {
        using EpetraIndex = TrilinosWrappers::types::int_type;
        AssertThrow(matrix.NumMyRows() == matrix.NumGlobalRows64(),
                    ExcMessage("CHOLMOD needs all rows on one rank."));
        const int n = matrix.NumMyRows();
        // Columns have an order of their own, even on one rank.
        std::vector<int> unknown_of(matrix.NumMyCols());
        for (unsigned int c = 0; c < unknown_of.size(); ++c)
          unknown_of[c] =
            matrix.LRID(static_cast<EpetraIndex>(matrix.GCID64(c)));

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
      std::vector<int>            negative;
      int                         largest_below = 0;
      std::vector<double>         work;
      mutable std::vector<double> seen_half;
      mutable Eigen::VectorXd     of_columns;
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
