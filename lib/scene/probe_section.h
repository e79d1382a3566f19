// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_scene_probe_section_h
#define ricochet_scene_probe_section_h

#include <output/stress_probe.h>
#include <problems/impact.h>
#include <scene/named_sections.h>
#include <scene/surface_names.h>

#include <deal.II/base/index_set.h>

#include <array>
#include <memory>

namespace Ricochet
{
  /// Quantities to be written at each time, as described in a section `Probe
  /// NAME`: columns of the ledger.
  template <int dim>
  struct ProbeSection
  {
    explicit ProbeSection(const NamedSection &section)
      : section(section)
    {}

    const NamedSection section;

    std::string quantity = "displacement";
    std::string body;
    /// m; empty for the mean over the body.
    std::vector<double> point;

    void
    add_parameters(dealii::ParameterHandler &parameters);

    /**
     * Add the columns to @p loop, which @p impact must outlive.
     * @param first_part of each body, and the number of all.
     * @throws InputError for a body that does not exist, or a point that is not in it.
     */
    void
    add_to(TimeLoop                        &loop,
           const Impact<dim>               &impact,
           const SurfaceNames              &surfaces,
           const std::vector<unsigned int> &first_part) const;

    /// Check for the errors of add_to(). @throws InputError
    void
    check(const Impact<dim>               &impact,
          const SurfaceNames              &surfaces,
          const std::vector<unsigned int> &first_part) const;

    /// @throws InputError see add_to().
    unsigned int
    find_body(const SurfaceNames &surfaces) const;

    std::string
    name_of(const std::string &name) const
    {
      return section.full_name() + "/" + name;
    }

  private:
    std::shared_ptr<const StressProbe<dim>>
    stress_probe(const Impact<dim>               &impact,
                 const SurfaceNames              &surfaces,
                 const std::vector<unsigned int> &first_part) const;

    /// Unknowns that are prescribed on the boundary, by component.
    std::array<dealii::IndexSet, dim>
    held_unknowns(const Impact<dim>  &impact,
                  const SurfaceNames &surfaces) const;

    /// Force or impulse.
    void
    add_reaction_to(TimeLoop           &loop,
                    const Impact<dim>  &impact,
                    const SurfaceNames &surfaces) const;

    /// Unknowns of the parts from @p begin to before @p end.
    void
    add_rotation_to(TimeLoop          &loop,
                    const Impact<dim> &impact,
                    const unsigned int begin,
                    const unsigned int end) const;
  };
} // namespace Ricochet

#endif
