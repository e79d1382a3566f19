// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_scene_contact_section_h
#define ricochet_scene_contact_section_h

#include <contact/treatments/contact_treatment.h>
#include <scene/named_sections.h>

namespace Ricochet
{
  /// What a user says of a contact, in a section `Contact NAME`: what touches what, and
  /// how it is treated.
  struct ContactSection
  {
    explicit ContactSection(const NamedSection &section);

    const NamedSection section;

    /// As SurfaceNames knows it.
    std::string surface;
    /// An obstacle or several, surfaces as above, or "itself".
    std::string against;

    /// Zero where the value is to be found.
    ContactParameters parameters;

    void
    add_parameters(dealii::ParameterHandler &handler);

    std::string
    name_of(const std::string &name) const
    {
      return section.full_name() + "/" + name;
    }
  };
} // namespace Ricochet

#endif
