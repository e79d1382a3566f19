// SPDX-License-Identifier: LGPL-2.1-or-later

// Threads of a rank: the results of two of them are those of one, to the last
// digit.

#include <base/threads.h>
#include <solvers/block_matrix.h>
#include <solvers/triangular_factor.h>

#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <deal.II/base/index_set.h>

#include <atomic>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

using namespace Ricochet;

BOOST_AUTO_TEST_SUITE(threads)

namespace
{
  /// @p n threads as long as this lives.
  struct NumberOfThreads
  {
    explicit NumberOfThreads(const unsigned int n)
      : before(Threads::set_number(n))
    {}

    ~NumberOfThreads()
    {
      Threads::set_number(before);
    }

    const unsigned int before;
  };

  std::vector<double>
  some_values(const unsigned int n, const unsigned int seed)
  {
    std::mt19937                     generator(seed);
    std::uniform_real_distribution<> random(-1., 1.);
    std::vector<double>              values(n);
    for (double &value : values)
      value = random(generator);
    return values;
  }

  /// The result of @p action on one, two and three threads, the same each time.
  template <typename Action>
  std::vector<double>
  on_threads(const Action &action)
  {
    std::vector<double> result;
    for (const unsigned int n_threads : {1, 2, 3})
      {
        const NumberOfThreads     here(n_threads);
        const std::vector<double> again = action();
        if (n_threads == 1)
          result = again;
        BOOST_REQUIRE_EQUAL(again.size(), result.size());
        for (std::size_t i = 0; i < result.size(); ++i)
          BOOST_REQUIRE_EQUAL(again[i], result[i]);
      }
    return result;
  }
} // namespace



BOOST_AUTO_TEST_CASE(each_part_is_done_once)
{
  BOOST_CHECK_EQUAL(Threads::number(), 1);
  for (const unsigned int n_threads : {1, 2, 5})
    {
      const NumberOfThreads         here(n_threads);
      std::vector<std::atomic<int>> n_calls(40), n_elements(1000);
      std::atomic<unsigned int>     largest_number = 0;
      Threads::for_each_part(n_calls.size(), [&](const unsigned int part) {
        ++n_calls[part];
        if (Threads::number() > largest_number)
          largest_number = Threads::number();
      });
      for (const auto &n : n_calls)
        BOOST_CHECK_EQUAL(n, 1);
      // A part has no threads of its own.
      BOOST_CHECK_EQUAL(largest_number, 1);
      Threads::for_each_range(n_elements.size(),
                              10,
                              [&](const unsigned int begin,
                                  const unsigned int end) {
                                for (unsigned int i = begin; i < end; ++i)
                                  ++n_elements[i];
                              });
      for (const auto &n : n_elements)
        BOOST_CHECK_EQUAL(n, 1);
      // Nothing to do.
      Threads::for_each_part(0, [](const unsigned int) {
        throw std::runtime_error("none");
      });
      Threads::for_each_range(0,
                              64,
                              [](const unsigned int begin,
                                 const unsigned int end) {
                                BOOST_CHECK_EQUAL(begin, end);
                              });
    }
  BOOST_CHECK_EQUAL(Threads::number(), 1);
}

BOOST_AUTO_TEST_CASE(errors_of_parts_arrive)
{
  const NumberOfThreads     here(2);
  std::atomic<unsigned int> n_ended = 0;
  const auto                action  = [&](const unsigned int part) {
    if (part == 7 || part == 4)
      throw std::runtime_error("part " + std::to_string(part));
    ++n_ended;
  };
  BOOST_CHECK_EXCEPTION(Threads::for_each_part(10, action),
                        std::runtime_error,
                        [](const std::runtime_error &error) {
                          return error.what() == std::string("part 4");
                        });
  BOOST_CHECK_EQUAL(n_ended, 8);
}

BOOST_AUTO_TEST_CASE(parts_are_of_equal_work)
{
  const NumberOfThreads here(2);
  using Parts      = std::vector<unsigned int>;
  const auto check = [](const Parts               &cuts,
                        const std::vector<double> &work,
                        const Parts               &expected) {
    const Parts parts = Threads::balanced_parts(cuts, work);
    BOOST_CHECK_EQUAL_COLLECTIONS(parts.begin(),
                                  parts.end(),
                                  expected.begin(),
                                  expected.end());
  };
  check({0, 3, 5, 9}, {0., 10., 52., 100.}, {0, 5, 9});
  check({0, 3, 5, 9}, {0., 49., 90., 100.}, {0, 3, 9});
  // One body is much larger than the others, and nowhere to cut.
  check({0, 1, 2, 9}, {0., 1., 2., 100.}, {0, 2, 9});
  check({0, 1, 9}, {0., 90., 100.}, {0, 1, 9});
  check({0, 9}, {0., 100.}, {0, 9});
}

// Two chains of coupled unknowns, each with its neighbours and with a last one:
// the factors of two bodies, the first of which ends with a row of its own.
// Solves are those of one thread.
BOOST_AUTO_TEST_CASE(factors_of_two_bodies)
{
  // Entries of each column: the one on the diagonal, then those of L below.
  std::vector<int>    order, begin, n_entries, rows;
  std::vector<double> values;
  const auto          add_body = [&](const int n) {
    const int first = order.size(), last = first + n - 1;
    for (int k = first; k <= last; ++k)
      {
        order.push_back(k);
        begin.push_back(rows.size());
        for (int row = k; row <= std::min(k + 3, last); ++row)
          {
            rows.push_back(row);
            values.push_back(row == k ? 2. + .1 * (k % 7)
                                      : .2 + .05 * ((row + k) % 5));
          }
        if (k + 3 < last)
          {
            rows.push_back(last);
            values.push_back(.01 * (k % 3));
          }
        n_entries.push_back(static_cast<int>(rows.size()) - begin.back());
      }
  };
  add_body(4001);
  add_body(3500);
  const int n = order.size();
  // Unknowns are in an order of their own.
  std::mt19937 generator(5);
  std::shuffle(order.begin(), order.end(), generator);
  const std::vector<double>      sign(n, 1.);
  const TriangularFactor<double> factor({n,
                                         order.data(),
                                         begin.data(),
                                         begin.data(),
                                         n_entries.data(),
                                         rows.data(),
                                         values.data(),
                                         true,
                                         sign.data()});
  const std::vector<double>      right_hand_side = some_values(n, 1);
  const std::vector<double>      solution        = on_threads([&]() {
    std::vector<double> forward, result(n);
    factor.forward(right_hand_side.data(), forward);
    factor.backward(forward, result.data());
    return result;
  });
  // L^T x, then L of that.
  std::vector<double> product(n, 0.), rest(n);
  for (int k = 0; k < n; ++k)
    for (int e = begin[k]; e < begin[k] + n_entries[k]; ++e)
      product[k] += values[e] * solution[order[rows[e]]];
  for (int k = 0; k < n; ++k)
    rest[k] = -right_hand_side[order[k]];
  for (int k = 0; k < n; ++k)
    for (int e = begin[k]; e < begin[k] + n_entries[k]; ++e)
      rest[rows[e]] += values[e] * product[k];
  for (int k = 0; k < n; ++k)
    BOOST_REQUIRE_SMALL(rest[k], 1e-12);
}

BOOST_AUTO_TEST_CASE(products_of_two_bodies)
{
  // Nodes of two chains.
  const unsigned int                     n_first = 900, n_nodes = 1500, dim = 2;
  std::vector<std::vector<unsigned int>> rows(n_nodes);
  const auto                             is_last = [&](const unsigned int i) {
    return i == n_first - 1 || i == n_nodes - 1;
  };
  for (unsigned int i = 0; i < n_nodes; ++i)
    if (!is_last(i))
      rows[i] = {i + 1, i < n_first ? n_first - 1 : n_nodes - 1};
  const auto all = std::make_shared<const dealii::Utilities::MPI::Partitioner>(
    dealii::complete_index_set(n_nodes * dim),
    MPI_COMM_SELF);
  auto                links = rows;
  BlockMatrix<double> matrix(
    std::make_shared<const BlockPattern>(all, std::move(rows), dim));
  // A spring of each link.
  dealii::FullMatrix<double> spring(2 * dim, 2 * dim);
  for (unsigned int i = 0; i < n_nodes; ++i)
    for (const unsigned int j : links[i])
      {
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double entry =
                (c == d ? 2. : .3) + .01 * ((i + j) % 11) * (c + d);
              spring(c, d) = spring(dim + c, dim + d) = entry;
              spring(c, dim + d) = spring(dim + c, d) = -entry;
            }
        matrix.add_cell({dim * i, dim * i + 1, dim * j, dim * j + 1}, spring);
      }
  const std::vector<double> vector = some_values(n_nodes * dim, 2);
  const auto                result = on_threads([&]() {
    std::vector<double> product(n_nodes * dim, 7.);
    matrix.vmult(vector.data(), product.data());
    return product;
  });
  // The entries themselves.
  matrix.for_each_row([&](const unsigned int               row,
                          const std::vector<unsigned int> &columns,
                          const std::vector<double>       &values) {
    double sum = -result[row];
    for (unsigned int k = 0; k < columns.size(); ++k)
      sum += values[k] * vector[columns[k]];
    BOOST_CHECK_SMALL(sum, 1e-10);
  });
  BOOST_CHECK_GT(std::abs(result[2 * n_first + 3]), 1e-3);
}

BOOST_AUTO_TEST_SUITE_END()
