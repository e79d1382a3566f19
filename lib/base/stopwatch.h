// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_stopwatch_h
#define ricochet_base_stopwatch_h

#include <chrono>

namespace Ricochet
{
  /// Adds the wall time of its own life to a sum (s).
  class Stopwatch
  {
  public:
    explicit Stopwatch(double &sum)
      : sum(sum)
      , start(std::chrono::steady_clock::now())
    {}

    ~Stopwatch()
    {
      sum +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
          .count();
    }

    Stopwatch(const Stopwatch &) = delete;
    Stopwatch &
    operator=(const Stopwatch &) = delete;

  private:
    double                                     &sum;
    const std::chrono::steady_clock::time_point start;
  };
} // namespace Ricochet

#endif
