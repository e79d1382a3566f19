// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/expressions.h>
#include <scene/contact_section.h>

#include <deal.II/base/utilities.h>

namespace Ricochet
{
  using namespace dealii;

  ContactSection::ContactSection(const NamedSection &section)
    : section(section)
  {
    parameters.section   = section.full_name();
    parameters.treatment = "persistent contact";
    parameters.leave_open();
  }



  void
  ContactSection::add_parameters(ParameterHandler &handler)
  {
    handler.enter_subsection(section.full_name());
    handler.add_parameter(
      "Surface",
      surface,
      "The surface in whose points contact is formulated: a body, or some of its "
      "boundaries by numbers or names, 'ball: 3, sole'; several bodies are "
      "separated by semicolons. Between bodies the softer one.",
      Patterns::Anything());
    handler.add_parameter(
      "Against",
      against,
      "What it may touch: an obstacle, or several separated by semicolons; "
      "surfaces of bodies, named as above; or 'itself'.",
      Patterns::Anything());
    handler.add_parameter(
      "Interference",
      interference,
      "By how much two bodies fit into each other too tightly (m), with Coupling = points: "
      "gaps are smaller by it. An expression of the time t, which static runs may "
      "raise from 0; in others it is constant, and was raised by a phase before. Empty: none.",
      Patterns::Anything());
    handler.leave_subsection();
    // 0 stands for the value that follows from moduli, density and mesh size.
    parameters.add_parameters(handler);
    // The methods of the papers have none.
    parameters.corners = true;
    parameters.add_pair_parameters(handler);
  }



  std::function<double(const double)>
  ContactSection::make_interference() const
  {
    if (Utilities::trim(interference).empty())
      return {};
    const Expressions expression("x,y,z",
                                 {interference},
                                 name_of("Interference"),
                                 /* of time */ true);
    return [expression](const double time) {
      return expression.value(0, Tensor<1, 3>(), time);
    };
  }
} // namespace Ricochet
