// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/matrix_entries.h>
#include <solvers/sparse_cholesky.h>

#include <Eigen/CholmodSupport>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Gives access to the factor.
    struct Cholmod
      : Eigen::CholmodDecomposition<Eigen::SparseMatrix<double>, Eigen::Lower>
    {
      const cholmod_factor &
      factor() const
      {
        return *m_cholmodFactor;
      }
    };

    /// The columns of a supernodal factor: supernodes are dense matrices of columns
    /// with the same rows below the diagonal.
    struct ColumnsOfSupernodes
    {
      explicit ColumnsOfSupernodes(const cholmod_factor &factor)
        : begin(factor.n)
        , first_value(factor.n)
        , n_entries(factor.n)
      {
        const auto *first = static_cast<const int *>(factor.super);
        const auto *rows  = static_cast<const int *>(factor.pi);
        const auto *value = static_cast<const int *>(factor.px);
        for (std::size_t s = 0; s < factor.nsuper; ++s)
          for (int column = first[s]; column < first[s + 1]; ++column)
            {
              const int n_rows = rows[s + 1] - rows[s], k = column - first[s];
              begin[column]       = rows[s] + k;
              first_value[column] = value[s] + k * (n_rows + 1);
              n_entries[column]   = n_rows - k;
            }
      }

      std::vector<int> begin, first_value, n_entries;
    };

    /// The factors of CHOLMOD in the order of solves; null if they are not of the
    /// requested kind.
    template <typename Value>
    std::unique_ptr<TriangularSolves>
    make_solves(const cholmod_factor &factor, const double *sign)
    {
      if (factor.itype != CHOLMOD_INT || factor.dtype != CHOLMOD_DOUBLE)
        return nullptr;
      const auto make = [&](const int *begin,
                            const int *first_value,
                            const int *n_entries,
                            const int *rows) {
        return std::make_unique<TriangularFactor<Value>>(
          typename TriangularFactor<Value>::Columns{
            static_cast<int>(factor.n),
            static_cast<const int *>(factor.Perm),
            begin,
            first_value,
            n_entries,
            rows,
            static_cast<const double *>(factor.x),
            factor.is_ll != 0,
            sign});
      };
      if (!factor.is_super)
        return make(static_cast<const int *>(factor.p),
                    static_cast<const int *>(factor.p),
                    static_cast<const int *>(factor.nz),
                    static_cast<const int *>(factor.i));
      const ColumnsOfSupernodes columns(factor);
      return make(columns.begin.data(),
                  columns.first_value.data(),
                  columns.n_entries.data(),
                  static_cast<const int *>(factor.s));
    }
  } // namespace



  struct SparseCholesky::Workshop
  {
    /// Indices of an entry of the lower triangle and of its mirror image among the
    /// values of the matrix.
    struct Place
    {
      int row, column, below, above;
    };

    void
    find_pattern(const MatrixEntries &matrix);

    /// Fill #symmetric, with the opposite sign in rows with a negative entry on the
    /// diagonal, if requested. @return whether the matrix is symmetric.
    bool
    fill(const double *values, const bool with_signs);

    /// @param prefer_blocks a supernodal factor of all but small matrices. Without it,
    /// whichever is computed faster: never in 2D, always in 3D.
    void
    analyse(const bool prefer_blocks)
    {
      // Operations per entry of the factor.
      cholesky.cholmod().supernodal_switch = prefer_blocks ? 10. : 200.;
      cholesky.analyzePattern(symmetric);
      is_analysed = true;
    }

    Eigen::SparseMatrix<double> symmetric;
    std::vector<Place>          places;
    std::vector<int>            diagonal;
    std::vector<double>         sign;
    // Whether an entry is between unknowns of both signs.
    bool    couples_signs = false;
    Cholmod cholesky;
    bool    is_analysed = false;
  };



  void
  SparseCholesky::Workshop::find_pattern(const MatrixEntries &matrix)
  {
    const int n = matrix.n_rows();
    // Columns may have another order than rows, even on one rank.
    std::vector<int> unknown_of(matrix.n_columns());
    for (unsigned int c = 0; c < unknown_of.size(); ++c)
      unknown_of[c] = matrix.row_number(matrix.column_index(c));

    // Entries on and below the diagonal, by columns. Rows are in ascending order in
    // each of them, as they are visited in order.
    symmetric.resize(n, n);
    int *begin = symmetric.outerIndexPtr();
    std::fill_n(begin, n + 1, 0);
    for (int i = 0; i < n; ++i)
      for (int k = matrix.begin[i]; k < matrix.begin[i + 1]; ++k)
        if (unknown_of[matrix.column[k]] <= i)
          ++begin[unknown_of[matrix.column[k]] + 1];
    std::partial_sum(begin, begin + n + 1, begin);
    symmetric.resizeNonZeros(begin[n]);
    places.resize(begin[n]);
    diagonal.resize(n);
    std::vector<int> end(begin, begin + n);
    for (int i = 0; i < n; ++i)
      for (int k = matrix.begin[i]; k < matrix.begin[i + 1]; ++k)
        if (const int j = unknown_of[matrix.column[k]]; j <= i)
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
        for (int k = matrix.begin[j]; k < matrix.begin[j + 1]; ++k)
          if (unknown_of[matrix.column[k]] >= j)
            above.emplace_back(unknown_of[matrix.column[k]], k);
        std::sort(above.begin(), above.end());
        bool is_symmetric =
          static_cast<int>(above.size()) == begin[j + 1] - begin[j];
        for (std::size_t a = 0; is_symmetric && a < above.size(); ++a)
          {
            Place &place = places[begin[j] + a];
            is_symmetric = place.row == above[a].first;
            place.above  = above[a].second;
          }
        AssertThrow(is_symmetric, ExcMessage("The pattern is not symmetric."));
      }
    sign.resize(n);
  }



  bool
  SparseCholesky::Workshop::fill(const double *values, const bool with_signs)
  {
    // Rows of multipliers may form a negative definite block.
    for (std::size_t i = 0; i < sign.size(); ++i)
      sign[i] = with_signs && values[diagonal[i]] < 0. ? -1. : 1.;
    double *entry        = symmetric.valuePtr();
    bool    is_symmetric = true;
    couples_signs        = false;
    for (std::size_t k = 0; k < places.size(); ++k)
      {
        const Place &place = places[k];
        const double below = sign[place.row] * values[place.below];
        const double above = sign[place.column] * values[place.above];
        entry[k]           = .5 * (below + above);
        if (place.row == place.column)
          continue;
        couples_signs = couples_signs ||
          (sign[place.row] != sign[place.column] &&
           (below != 0. || above != 0.));
        // The tolerance excludes round-off.
        is_symmetric = is_symmetric &&
          std::abs(below - above) <= 1e-10 *
              std::sqrt(std::abs(values[diagonal[place.row]] *
                                 values[diagonal[place.column]]));
      }
    return is_symmetric;
  }



  SparseCholesky::SparseCholesky(const Kind kind)
    : kind(kind)
  {}



  SparseCholesky::~SparseCholesky() = default;



  bool
  SparseCholesky::factorise(const Matrix &matrix)
  {
    solves.reset();
    const MatrixEntries entries(matrix);
    AssertThrow(entries.n_rows() == matrix.m(),
                ExcMessage("CHOLMOD needs all rows on one rank."));
    if (!workshop)
      {
        workshop = std::make_unique<Workshop>();
        workshop->find_pattern(entries);
      }
    // Unknowns of both signs are coupled in the matrix of an indefinite body.
    bool is_symmetric = workshop->fill(entries.value, true);
    if (workshop->couples_signs)
      is_symmetric = workshop->fill(entries.value, false);
    if (kind == Kind::exact && !is_symmetric)
      return false;
    Cholmod &cholesky = workshop->cholesky;
    if (!workshop->is_analysed)
      workshop->analyse(kind == Kind::exact);
    cholesky.factorize(workshop->symmetric);
    if (cholesky.info() != Eigen::Success && kind == Kind::exact)
      {
        // LDL^T, since the matrix may be indefinite.
        workshop->analyse(false);
        cholesky.factorize(workshop->symmetric);
      }
    if (cholesky.info() != Eigen::Success)
      return false;
    solves = kind == Kind::exact
      ? make_solves<double>(cholesky.factor(), workshop->sign.data())
      : make_solves<float>(cholesky.factor(), workshop->sign.data());
    // The matrix of a linear body is factored once: its memory is freed.
    if (kind == Kind::exact)
      workshop.reset();
    return solves != nullptr;
  }
} // namespace Ricochet
