// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_parameter_schema_h
#define ricochet_base_parameter_schema_h

#include <base/exceptions.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Ricochet
{
  class JsonWriter;

  /**
   * Describe the parameters as a JSON Schema (draft 2020-12) of an object with a member for each
   * section: types, bounds, allowed words, default values, documentation and units. A section
   * "Body NAME" stands for any number of sections with names of the user's.
   */
  void
  add_schema(const dealii::ParameterHandler &parameters, JsonWriter &json);

  /**
   * A refusal as JSON:
   *
   *     {"code": "unknown_parameter", "exit": 1, "file": "mine.prm", "line": 3,
   *      "key": "Time/Tme step", "nearest": ["Time/Time step"], "sentence": "..."}
   *
   * File and line are those with which the sentence begins; null where there are none.
   *
   * @param exit_code of the program.
   */
  std::string
  refusal_as_json(const std::string         &sentence,
                  const InputError::Details &details,
                  const unsigned int         exit_code);
} // namespace Ricochet

#endif
