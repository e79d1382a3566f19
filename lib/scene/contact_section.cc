// SPDX-License-Identifier: LGPL-2.1-or-later
#include <scene/contact_section.h>

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
    handler.leave_subsection();
    // 0 stands for the value that follows from moduli, density and mesh size.
    parameters.add_parameters(handler);
    // The methods of the papers have none.
    parameters.corners = true;
    parameters.add_pair_parameters(handler);
  }
} // namespace Ricochet
