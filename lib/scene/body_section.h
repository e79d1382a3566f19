// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_scene_body_section_h
#define ricochet_scene_body_section_h

#include <base/run_folder.h>
#include <discretization/curved_geometry.h>
#include <materials/material_parameters.h>
#include <scene/named_sections.h>

#include <deal.II/grid/tria.h>

#include <map>
#include <string>
#include <vector>

namespace Ricochet
{
  /// The mesh of one body, placed.
  template <int dim>
  struct BodyMesh
  {
    /// Not refined.
    dealii::Triangulation<dim> cells;
    /// Nodes of cells of second order, otherwise nothing.
    CellNodes<dim> nodes;
    /// Boundary ids by the names that the shape or the file has for them.
    std::map<std::string, dealii::types::boundary_id> boundary_names;
    /// The same for material ids.
    std::map<std::string, dealii::types::material_id> material_names;
    /// The cells with one material id.
    struct Share
    {
      /// m^dim
      double measure = 0.;
      /// Integral of the position (m^(dim+1)).
      dealii::Tensor<1, dim> moment;
    };
    std::map<dealii::types::material_id, Share> shares;
    /// The faces with one boundary id.
    struct Boundary
    {
      /// m^(dim-1)
      double area = 0.;
      /// Integrals of the position (m^dim) and of the outer normal (m^(dim-1)).
      dealii::Tensor<1, dim> moment, normal;
    };
    std::map<dealii::types::boundary_id, Boundary> boundaries;
  };

  /// The default material of a body.
  MaterialParameters
  default_material();

  /// A body as described in a section `Body NAME`: its mesh, position, material
  /// and initial motion.
  template <int dim>
  struct BodySection
  {
    explicit BodySection(const NamedSection &section);

    const NamedSection section;

    std::string file;
    /// The cells of the file that are this body; empty for all.
    std::string group;
    std::string shape = "none";
    /// m
    double                    radius = 1., inner_radius = .5;
    std::vector<double>       size;
    std::vector<unsigned int> cells_along;
    unsigned int              nodes_around = 64, nodes_across = 4, nodes = 0;
    double                    mesh_size = 0.;
    std::string  generator = "hyper_cube", generator_arguments = "0 : 1 : true";
    unsigned int refinements = 0;
    /// "quadrilaterals or hexahedra", "triangles or tetrahedra"; of files and shapes
    /// that have one kind only "automatic".
    std::string cells  = "automatic";
    bool        curved = false;

    double scale = 1.;
    /// rad; the second rotation follows the first one, in 3D.
    double                 angle = 0., second_angle = 0.;
    dealii::Tensor<1, 3>   axis, second_axis;
    dealii::Tensor<1, dim> translation;

    MaterialParameters material;
    /// A section Material that replaces it; empty for none.
    std::string material_name;
    /// Materials of their own for some material ids: "3: rubber; core: steel".
    std::string            materials;
    dealii::Tensor<1, dim> velocity;
    dealii::Tensor<1, 3>   spin;
    /// Expressions of x, y, z and t (m/s^2); empty for none.
    std::string acceleration;

    /// Time that a library may take for the mesh (s); 0 for any time.
    unsigned int meshing_time = 0;

    void
    add_parameters(dealii::ParameterHandler &parameters);

    std::vector<UnusedParameter>
    unused_parameters() const;

    /**
     * Make, or read, and place the mesh.
     * @param advance time of flight from the given position (s).
     * @param kept_meshes folder of a run that is resumed, see keep_mesh(); or empty.
     * @throws InputError when it cannot be made.
     */
    void
    make_mesh(BodyMesh<dim>     &mesh,
              const double       advance,
              const std::string &kept_meshes) const;

    /// Keep the mesh that Gmsh has made of a geometry in the folder of the run, which may be
    /// resumed and finds another one then, see read_any_mesh().
    void
    keep_mesh(RunFolder &folder) const;

    /// A lower bound of the number of vertices, before any mesh is made; for
    /// files it is hardly more than zero.
    double
    vertices_at_least() const;

    /// The names of the materials by material id of the @p mesh; those without
    /// an entry have the body's own. @throws InputError
    std::map<dealii::types::material_id, std::string>
    named_materials(const BodyMesh<dim> &mesh) const;

    /// The name of this section's parameter @p name, for messages.
    std::string
    name_of(const std::string &name) const
    {
      return section.full_name() + "/" + name;
    }

  private:
    void
    place(BodyMesh<dim> &mesh, const double advance) const;
  };
} // namespace Ricochet

#endif
