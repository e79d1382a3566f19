// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/positive_system.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>

namespace Ricochet
{
  using namespace dealii;

  bool
  PositiveSystem::set(const std::vector<unsigned int>        &places,
                      const std::vector<double>              &diagonal,
                      const std::vector<std::vector<double>> &columns,
                      const bool                              may_update)
  {
    if (may_update && n_factored == base_places.size() &&
        update(places, diagonal, columns))
      return true;
    return factorise(places, diagonal, columns);
  }



  void
  PositiveSystem::forget()
  {
    rest.reset();
    base_places.clear();
    base_diagonal.clear();
    n_factored = 0;
  }



  double &
  PositiveSystem::factor(const unsigned int i, const unsigned int j)
  {
    return upper[i + std::size_t(j) * n_rows];
  }



  bool
  PositiveSystem::factorise(const std::vector<unsigned int>        &places,
                            const std::vector<double>              &diagonal,
                            const std::vector<std::vector<double>> &columns)
  {
    const unsigned int n = places.size();
    rest.reset();
    // With which places both sets begin, in whole blocks. A block has the same
    // operands whether the one before it was kept or not.
    unsigned int n_kept = 0;
    while (n_kept < std::min(n, n_factored) &&
           base_places[n_kept] == places[n_kept] &&
           base_diagonal[n_kept] == diagonal[n_kept])
      ++n_kept;
    n_kept -= n_kept % block_size;
    if (n > static_cast<unsigned int>(n_rows))
      {
        n_kept = 0;
        n_rows = n + n / 2;
        upper.assign(std::size_t(n_rows) * n_rows, 0.);
      }
    base_places   = places;
    base_diagonal = diagonal;

    for (n_factored = n_kept; n_factored < n;)
      {
        const unsigned int begin = n_factored;
        const int n_above = begin, n_columns = std::min(block_size, n - begin);
        for (int j = 0; j < n_columns; ++j)
          {
            const std::vector<double> &column = columns[places[begin + j]];
            for (unsigned int i = 0; i <= begin + j; ++i)
              factor(i, begin + j) = column[places[i]];
            factor(begin + j, begin + j) += diagonal[begin + j];
          }
        double *const corner = &factor(begin, begin);
        if (begin > 0)
          {
            double *const above = &factor(0, begin);
            solve_half("T", n_above, above, n_columns, n_rows);
            constexpr double minus_one = -1., one = 1.;
            syrk("U",
                 "T",
                 &n_columns,
                 &n_above,
                 &minus_one,
                 above,
                 &n_rows,
                 &one,
                 corner,
                 &n_rows);
          }
        int info;
        potrf("U", &n_columns, corner, &n_rows, &info);
        AssertThrow(info >= 0, ExcInternalError());
        if (info > 0)
          return false;
        n_factored += n_columns;
      }
    return true;
  }



  bool
  PositiveSystem::update(const std::vector<unsigned int>        &places,
                         const std::vector<double>              &diagonal,
                         const std::vector<std::vector<double>> &columns)
  {
    rest.reset();
    joined.clear();
    left.clear();
    place_in_base.clear();
    std::vector<double> joined_diagonal;
    const unsigned int  n = base_places.size();
    unsigned int        b = 0;
    for (unsigned int i = 0; i < places.size(); ++i)
      {
        for (; b < n && base_places[b] < places[i]; ++b)
          left.push_back(b);
        const bool is_there = b < n && base_places[b] == places[i];
        if (is_there && base_diagonal[b] == diagonal[i])
          {
            place_in_base.push_back(b++);
            continue;
          }
        // Another diagonal: leaves, and joins.
        if (is_there)
          left.push_back(b++);
        place_in_base.push_back(-1);
        joined.push_back(places[i]);
        joined_diagonal.push_back(diagonal[i]);
      }
    for (; b < n; ++b)
      left.push_back(b);

    // Is it worth it?
    const unsigned int n_joined = joined.size(),
                       n_rest   = n_joined + left.size();
    if (8 * n_rest > n)
      return false;
    if (n_rest == 0)
      return true;
    border.reinit(n, n_rest);
    for (unsigned int k = 0; k < n_joined; ++k)
      for (unsigned int i = 0; i < n; ++i)
        border(i, k) = columns[joined[k]][base_places[i]];
    for (unsigned int k = 0; k < left.size(); ++k)
      border(left[k], n_joined + k) = 1.;
    solve_half("T", n, &border(0, 0), n_rest, n);
    rest.emplace(n_rest, n_rest);
    border.Tmmult(*rest, border);
    *rest *= -1.;
    for (unsigned int k = 0; k < n_joined; ++k)
      {
        for (unsigned int l = 0; l < n_joined; ++l)
          (*rest)(k, l) += columns[joined[l]][joined[k]];
        (*rest)(k, k) += joined_diagonal[k];
      }
    try
      {
        rest->compute_lu_factorization();
      }
    catch (const LACExceptions::ExcSingular &)
      {
        return false;
      }
    return true;
  }



  void
  PositiveSystem::solve_half(const char *transpose,
                             const int   n,
                             double     *columns,
                             const int   n_columns,
                             const int   distance) const
  {
    int info;
    trtrs("U",
          transpose,
          "N",
          &n,
          &n_columns,
          upper.data(),
          &n_rows,
          columns,
          &distance,
          &info);
    AssertThrow(info == 0, ExcInternalError());
  }



  void
  PositiveSystem::solve(dealii::Vector<double> &vector) const
  {
    const int n = base_places.size();
    if (!rest)
      {
        solve_half("T", n, vector.begin(), 1, n);
        solve_half("N", n, vector.begin(), 1, n);
        return;
      }
    dealii::Vector<double> inner(n), outer(joined.size() + left.size()),
      seen(outer.size());
    for (unsigned int i = 0, k = 0; i < place_in_base.size(); ++i)
      if (place_in_base[i] >= 0)
        inner[place_in_base[i]] = vector[i];
      else
        outer[k++] = vector[i];
    solve_half("T", n, inner.begin(), 1, n);
    border.Tvmult(seen, inner);
    outer -= seen;
    rest->solve(outer);
    dealii::Vector<double> back(inner.size());
    border.vmult(back, outer);
    inner -= back;
    solve_half("N", n, inner.begin(), 1, n);
    for (unsigned int i = 0, k = 0; i < place_in_base.size(); ++i)
      vector[i] = place_in_base[i] >= 0 ? inner[place_in_base[i]] : outer[k++];
  }
} // namespace Ricochet
