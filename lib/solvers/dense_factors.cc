// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/threads.h>
#include <solvers/dense_factors.h>

#include <Teuchos_BLAS.hpp>
#include <Teuchos_LAPACK.hpp>

#include <algorithm>

namespace Ricochet
{
  namespace
  {
    // Columns that are factored at once, and that a thread takes at once.
    constexpr int panel_width = 64, task_width = 128;
  } // namespace



  template <typename Number>
  void
  DenseFactors<Number>::reinit(const unsigned int n)
  {
    size = n;
    values.resize(static_cast<std::size_t>(n) * n);
    pivots.resize(n);
  }



  template <typename Number>
  bool
  DenseFactors<Number>::factorise_panel(const int first, const int width)
  {
    int info = 0;
    Teuchos::LAPACK<int, Number>().GETRF(size - first,
                                         width,
                                         &(*this)(first, first),
                                         size,
                                         pivots.data() + first,
                                         &info);
    for (int k = first; k < first + width; ++k)
      pivots[k] += first;
    return info == 0;
  }



  template <typename Number>
  void
  DenseFactors<Number>::subtract_panel(const int first,
                                       const int width,
                                       const int column,
                                       const int n_columns)
  {
    const int                        below = first + width;
    const Teuchos::BLAS<int, Number> blas;
    Teuchos::LAPACK<int, Number>().LASWP(n_columns,
                                         &(*this)(0, column),
                                         size,
                                         first + 1,
                                         below,
                                         pivots.data(),
                                         1);
    blas.TRSM(Teuchos::LEFT_SIDE,
              Teuchos::LOWER_TRI,
              Teuchos::NO_TRANS,
              Teuchos::UNIT_DIAG,
              width,
              n_columns,
              Number(1),
              &(*this)(first, first),
              size,
              &(*this)(first, column),
              size);
    blas.GEMM(Teuchos::NO_TRANS,
              Teuchos::NO_TRANS,
              size - below,
              n_columns,
              width,
              Number(-1),
              &(*this)(below, first),
              size,
              &(*this)(first, column),
              size,
              Number(1),
              &(*this)(below, column),
              size);
  }



  template <typename Number>
  bool
  DenseFactors<Number>::factorise()
  {
    const int n     = size;
    bool is_regular = n == 0 || factorise_panel(0, std::min(panel_width, n));
    for (int first = 0; first + panel_width < n && is_regular;
         first += panel_width)
      {
        // The next panel, which is then factored, and what is behind it.
        const int next       = first + panel_width;
        const int next_width = std::min(panel_width, n - next);
        const int behind     = next + next_width;
        const int n_tasks    = (n - behind + task_width - 1) / task_width;
        Threads::for_each_part(1 + n_tasks, [&](const unsigned int task) {
          if (task == 0)
            {
              subtract_panel(first, panel_width, next, next_width);
              is_regular = factorise_panel(next, next_width);
              return;
            }
          const int column = behind + (task - 1) * task_width;
          subtract_panel(first,
                         panel_width,
                         column,
                         std::min(task_width, n - column));
        });
      }
    // What was exchanged later, in the columns before.
    Threads::for_each_part((n + panel_width - 1) / panel_width,
                           [&](const unsigned int panel) {
                             const int first = panel * panel_width;
                             const int next  = first + panel_width;
                             if (next < n && is_regular)
                               Teuchos::LAPACK<int, Number>().LASWP(
                                 panel_width,
                                 &(*this)(0, first),
                                 n,
                                 next + 1,
                                 n,
                                 pivots.data(),
                                 1);
                           });
    return is_regular;
  }



  template <typename Number>
  void
  DenseFactors<Number>::solve(Number *vector) const
  {
    if (size == 0)
      return;
    int info = 0;
    Teuchos::LAPACK<int, Number>().GETRS('N',
                                         size,
                                         1,
                                         values.data(),
                                         size,
                                         pivots.data(),
                                         vector,
                                         size,
                                         &info);
  }



  template class DenseFactors<float>;
  template class DenseFactors<double>;
} // namespace Ricochet
