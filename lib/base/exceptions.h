// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_exceptions_h
#define ricochet_base_exceptions_h

#include <stdexcept>
#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * A request of the user that cannot be met: a typo in a parameter, a value
   * out of range, a combination of methods that has no meaning, a file that
   * cannot be read or written. The text is a complete sentence for the user; it
   * is printed once, without a stack trace, and the program ends with code 1.
   */
  class InputError : public std::runtime_error
  {
  public:
    /// Data for programs that read messages, besides the sentence: see refusal_as_json().
    struct Details
    {
      /// The kind of mistake; the same in each version.
      std::string code = "input";
      /// "Section/Name" of the parameter, or the name that does not exist.
      std::string key = {};
      /// Names that may be meant, best first.
      std::vector<std::string> nearest = {};
    };

    explicit InputError(const std::string &text)
      : std::runtime_error(text)
    {}

    InputError(const std::string &text, const Details &details)
      : std::runtime_error(text)
      , details(details)
    {}

    Details details;
  };

  /**
   * A computation failed although the input was valid: Newton's method did not
   * converge, or the state is not finite. Earlier steps are on disk. The
   * program ends with code 2.
   */
  class ComputationError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /**
   * A run ended after a complete step because a signal asked for it. All that was computed
   * is on disk, with a checkpoint. The program ends with code 128 and the signal's number.
   */
  class StoppedBySignal : public std::runtime_error
  {
  public:
    StoppedBySignal(const int signal, const std::string &text)
      : std::runtime_error(text)
      , signal(signal)
    {}

    const int signal;
  };

  /**
   * Newton's method did not converge in one stage of one step. The time loop
   * catches this, halves the step as often as it may, and only then gives up.
   */
  class NewtonFailure : public ComputationError
  {
  public:
    using ComputationError::ComputationError;
  };

  /**
   * Points went through a body or an obstacle in one step without touching it. The time
   * loop halves the step.
   */
  class StepTooLong : public NewtonFailure
  {
  public:
    using NewtonFailure::NewtonFailure;
  };
} // namespace Ricochet

#endif
