// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_scene_scene_h
#define ricochet_scene_scene_h

#include <base/program.h>
#include <contact/obstacles/obstacle_parameters.h>
#include <scene/body_section.h>
#include <scene/condition_section.h>
#include <scene/contact_section.h>
#include <scene/probe_section.h>
#include <scene/surface_names.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace Ricochet
{
  /// The dimension set in @p text by `set Dimension`. @throws InputError when
  /// it is neither 2 nor 3, or missing.
  unsigned int
  dimension_of(const ParameterText &text);

  /**
   * Bodies, obstacles, contacts, conditions and probes as named in a parameter
   * file, in any number of sections: see the program ricochet.
   *
   * The steps are those of run_program(): names first, then parameters, then
   * their combination.
   */
  template <int dim>
  class Scene
  {
  public:
    /// @throws InputError for sections that do not exist, see find_named_sections().
    explicit Scene(const ParameterText &text);

    void
    add_parameters(dealii::ParameterHandler &parameters);

    /// Meshes are made here, since the boundaries are known from them only.
    /// @throws InputError
    void
    validate();

    std::vector<UnusedParameter>
    unused_parameters() const;

    /// Description of the scene: bodies with volume, mass and boundaries,
    /// contacts with gaps and the default values that were computed for them.
    /// After validate().
    /// @param folder gets setup.vtk, the meshes with the numbers of parts and boundaries,
    /// and this text as setup.txt, unless it is empty.
    /// @throws InputError when bodies overlap.
    std::string
    description(const std::string &folder) const;

    void
    run(RunFolder &folder);

    /// Checksum of the bodies' cells, with places, materials' numbers and boundaries, after validate().
    /// Nodes of curved cells are left to the checkpoint.
    std::uint32_t
    checksum_of_bodies() const;

    /// Folder of a run that is resumed, which has the meshes that Gmsh has made; or empty.
    std::string kept_meshes;

  private:
    /// Cells of one body that are of one material: a part, see Body::part().
    struct PartOfScene
    {
      /// For columns of the ledger.
      std::string        name;
      unsigned int       body;
      MaterialParameters material;
      double             measure;
    };

    /// The sides of a contact.
    struct Touching
    {
      /// Names of obstacles, with surfaces; or
      std::vector<unsigned int> obstacles;
      /// surfaces of bodies; or
      std::set<dealii::types::boundary_id> master;
      bool                                 is_self = false;
      std::vector<SurfaceNames::Surface>   slave;
    };

    /// Names of unused sections.
    std::vector<std::string>
    notes() const;

    /// Contacts of an Impact whose gaps begin with an overlap, see ContactPair.
    std::vector<std::string>
    notes_on_fits(const std::vector<Contact> &assembled) const;

    Touching
    find_touching(const ContactSection &contact) const;

    void
    make_meshes();

    /// Number the parts of body @p b, and its cells by them.
    void
    make_parts(const unsigned int b);

    /// The material of the section @p name. @throws InputError
    const MaterialParameters &
    find_material(const std::string &name, const std::string &where) const;

    /// The parts with cells at the boundaries @p surface.
    std::set<unsigned int>
    parts_at(const SurfaceNames::Surface &surface) const;

    /// Give contacts the values that the user has left open.
    void
    find_missing_values();

    /// Refuse a combination of treatment, scheme, mass, material and what @p touching
    /// names that has no meaning. @throws InputError
    void
    check(const ContactSection &contact,
          const Touching       &touching,
          const bool            redistributed_mass) const;

    /// A doubt whether the numbers of a @p part are in the scene's units; empty without one.
    std::string
    note_on_units(const PartOfScene &part, const LinearElastic &elastic) const;

    /// The smallest gap at the start (m).
    double
    initial_gap(const ContactSection &contact) const;

    ImpactSetup<dim>
    make_setup() const;

    /// Nodes of all bodies, for cells of second order; otherwise nothing.
    CellNodes<dim>
    nodes_of_cells() const;

    /// All bodies in one triangulation.
    void
    join(dealii::Triangulation<dim> &whole) const;

    std::vector<BodySection<dim>>                                 bodies;
    std::vector<std::pair<NamedSection, MaterialParameters>>      materials;
    std::vector<std::pair<NamedSection, ObstacleParameters<dim>>> obstacles;
    std::vector<ContactSection>                                   contacts;
    std::vector<ConditionSection<dim>>                            conditions;
    std::vector<ProbeSection<dim>>                                probes;

    ImpactParameters       impact;
    unsigned int           degree = 1;
    dealii::Tensor<1, dim> gravity;
    double                 advance = 0.;
    std::string            start_from;
    unsigned int           meshing_time = 600;
    std::string            units_text   = "m, kg, s";

    // The handler that the parameters were added to, for computed defaults.
    dealii::ParameterHandler *handler = nullptr;

    // After validate().
    std::vector<std::unique_ptr<BodyMesh<dim>>> meshes;
    SurfaceNames                                surfaces;
    std::vector<PartOfScene>                    parts;
    // First part of each body, and the number of all parts.
    std::vector<unsigned int> first_part;
    // Centre of mass of each body (m).
    std::vector<dealii::Point<dim>> centres;
  };
} // namespace Ricochet

#endif
