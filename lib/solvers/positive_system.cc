// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/positive_system.h>

#include <deal.II/lac/lapack_templates.h>

namespace Ricochet
{
  using namespace dealii;

  bool
  PositiveSystem::set(const std::vector<unsigned int>        &places,
                      const std::vector<double>              &diagonal,
                      const std::vector<std::vector<double>> &columns,
                      const bool                              may_update)
  {
    if (may_update && is_factored && update(places, diagonal, columns))
      return true;
    return factorise(places, diagonal, columns);
  }



  bool
  PositiveSystem::factorise(const std::vector<unsigned int>        &places,
                            const std::vector<double>              &diagonal,
                            const std::vector<std::vector<double>> &columns)
  {
    const unsigned int n = places.size();
    rest.reset();
    base_places   = places;
    base_diagonal = diagonal;
    base.reinit(n, n);
    // LAPACK reads the lower triangle.
    for (unsigned int j = 0; j < n; ++j)
      {
        const std::vector<double> &column = columns[places[j]];
        for (unsigned int i = j; i < n; ++i)
          base(i, j) = column[places[i]];
        base(j, j) += diagonal[j];
      }
    base.set_property(LAPACKSupport::symmetric);
    is_factored = true;
    try
      {
        base.compute_cholesky_factorization();
      }
    catch (const LACExceptions::ExcSingular &)
      {
        is_factored = false;
      }
    return is_factored;
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
    solve_half("N", &border(0, 0), n_rest);
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
                             double     *columns,
                             const int   n_columns) const
  {
    const int n = base_places.size();
    int       info;
    trtrs("L",
          transpose,
          "N",
          &n,
          &n_columns,
          &base(0, 0),
          &n,
          columns,
          &n,
          &info);
    AssertThrow(info == 0, ExcInternalError());
  }



  void
  PositiveSystem::solve(dealii::Vector<double> &vector) const
  {
    if (!rest)
      {
        base.solve(vector);
        return;
      }
    dealii::Vector<double> inner(base_places.size()),
      outer(joined.size() + left.size()), seen(outer.size());
    for (unsigned int i = 0, k = 0; i < place_in_base.size(); ++i)
      if (place_in_base[i] >= 0)
        inner[place_in_base[i]] = vector[i];
      else
        outer[k++] = vector[i];
    solve_half("N", inner.begin(), 1);
    border.Tvmult(seen, inner);
    outer -= seen;
    rest->solve(outer);
    dealii::Vector<double> back(inner.size());
    border.vmult(back, outer);
    inner -= back;
    solve_half("T", inner.begin(), 1);
    for (unsigned int i = 0, k = 0; i < place_in_base.size(); ++i)
      vector[i] = place_in_base[i] >= 0 ? inner[place_in_base[i]] : outer[k++];
  }
} // namespace Ricochet
