// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_scene_condition_section_h
#define ricochet_scene_condition_section_h

#include <problems/impact.h>
#include <scene/named_sections.h>
#include <scene/surface_names.h>

namespace Ricochet
{
  /// A boundary condition as described in a section `Condition NAME`: a part of
  /// the boundary that is held, moved or loaded.
  template <int dim>
  struct ConditionSection
  {
    explicit ConditionSection(const NamedSection &section)
      : section(section)
    {}

    const NamedSection section;

    /// A name for SurfaceNames, or that of a body of which #point chooses a vertex.
    std::string boundary;
    /// m; empty for all of the boundary.
    std::vector<double> point;
    std::string         kind = "fixed";
    /// "x, y"; empty for all.
    std::string components;
    /// Expressions of x, y, z and t, separated by semicolons.
    std::string value;
    /// A file for TimeTable, whose values #value is multiplied by; empty for none.
    std::string table;
    /// Pa/m, Pa s/m
    double stiffness = 0., damping = 0.;

    void
    add_parameters(dealii::ParameterHandler &parameters);

    std::vector<UnusedParameter>
    unused_parameters() const;

    /// Enter it into @p setup. @throws InputError for a boundary that does not exist,
    /// expressions that cannot be read, and a direction that is prescribed twice.
    /// @param first_part of each body, and the number of all parts.
    void
    add_to(const SurfaceNames              &surfaces,
           const std::vector<unsigned int> &first_part,
           ImpactSetup<dim>                &setup) const;

    std::string
    name_of(const std::string &name) const
    {
      return section.full_name() + "/" + name;
    }

  private:
    std::array<bool, dim>
    which_components() const;

    /// The boundaries, or the id of the vertex, which is entered into @p setup.
    std::set<dealii::types::boundary_id>
    find_ids(const SurfaceNames              &surfaces,
             const std::vector<unsigned int> &first_part,
             ImpactSetup<dim>                &setup) const;

    /// Component @p c of #n functions of the time and the place: #value times #table.
    using Field = std::function<double(const unsigned int c,
                                       const double       time,
                                       const dealii::Point<dim> &)>;

    Field
    field(const unsigned int n) const;

    void
    prescribe(const dealii::types::boundary_id id,
              const VectorField<dim>          &value,
              ImpactSetup<dim>                &setup) const;
  };

  /// The vector field that @p text, dim expressions of x, y, z and t separated by
  /// semicolons, describes. @param name of the parameter. @throws InputError
  template <int dim>
  VectorField<dim>
  parse_vector_field(const std::string &text, const std::string &name);
} // namespace Ricochet

#endif
