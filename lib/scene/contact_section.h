// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_scene_contact_section_h
#define ricochet_scene_contact_section_h

#include <contact/treatments/contact_treatment.h>
#include <scene/named_sections.h>

#include <functional>

namespace Ricochet
{
  /// A contact as described in a section `Contact NAME`: its surfaces, and its
  /// treatment.
  struct ContactSection
  {
    explicit ContactSection(const NamedSection &section);

    const NamedSection section;

    /// A name for SurfaceNames.
    std::string surface;
    /// An obstacle or several, surfaces as above, or "itself".
    std::string against;
    /// An expression of the time t (m); empty for none.
    std::string interference;

    /// Zero where the value is to be computed.
    ContactParameters parameters;

    void
    add_parameters(dealii::ParameterHandler &handler);

    /// ContactPair::interference; empty without. @throws InputError
    std::function<double(const double time)>
    make_interference() const;

    std::string
    name_of(const std::string &name) const
    {
      return section.full_name() + "/" + name;
    }
  };
} // namespace Ricochet

#endif
