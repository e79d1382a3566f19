// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/certificate.h>
#include <base/json_writer.h>

#include <cmath>
#include <cstdio>
#include <limits>

namespace Ricochet
{
  const std::vector<Refinement> refinements_of_certificate = {
    {"", 0, 0},
    {"cells_2_steps_2", 1, 1},
    {"cells_4_steps_4", 2, 2},
    {"cells_2", 1, 0},
    {"steps_2", 0, 1}};



  std::string
  certificate_as_json(const std::vector<ErrorBar>               &bars,
                      const std::vector<std::vector<RunResult>> &results)
  {
    // The change of a number by one of the refinements alone; not a number without it.
    const auto change = [&](const unsigned int k, const ErrorBar &bar) {
      for (const RunResult &result : results[k])
        if (result.name == bar.name)
          return result.value - bar.values[0];
      return std::numeric_limits<double>::quiet_NaN();
    };
    JsonWriter json;
    json.add("format", 1U);
    std::vector<std::string> names;
    for (const Refinement &refinement : refinements_of_certificate)
      names.push_back(refinement.name);
    json.add("runs", names);
    json.begin_object("numbers");
    for (const ErrorBar &bar : bars)
      {
        json.begin_object(bar.name);
        json.add("value", bar.values[0]);
        json.add("unit", bar.unit);
        json.add("error_bar", bar.bar);
        json.add("order", bar.order);
        if (!bar.why_none.empty())
          json.add("why_none", bar.why_none);
        json.add("values",
                 std::vector<double>(bar.values.begin(), bar.values.end()));
        json.add("change_by_halved_cells", change(3, bar));
        json.add("change_by_halved_steps", change(4, bar));
        json.end_object();
      }
    json.end_object();
    return json.finished();
  }



  std::vector<std::string>
  lines_of_certificate(const std::vector<ErrorBar> &bars)
  {
    std::vector<std::string> lines = {
      "certificate: exact values are expected within these bars"};
    for (const ErrorBar &bar : bars)
      {
        // Works that do not exist.
        if (bar.values[0] == 0. && bar.values[2] == 0.)
          continue;
        char text[300], order[40] = "";
        if (std::isfinite(bar.order))
          std::snprintf(order, sizeof(order), "order %.2g, ", bar.order);
        if (bar.why_none.empty())
          std::snprintf(text,
                        sizeof(text),
                        "  %-45s %13.6g +- %.2g %s (%sfinest %.6g)",
                        bar.name.c_str(),
                        bar.values[0],
                        bar.bar,
                        bar.unit.c_str(),
                        order,
                        bar.values[2]);
        else
          std::snprintf(text,
                        sizeof(text),
                        "  %-45s %13.6g %s, no bar: %s",
                        bar.name.c_str(),
                        bar.values[0],
                        bar.unit.c_str(),
                        bar.why_none.c_str());
        lines.push_back(text);
      }
    return lines;
  }
} // namespace Ricochet
