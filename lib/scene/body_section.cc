// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/child_process.h>
#include <base/exceptions.h>
#include <problems/ball_mesh.h>
#include <problems/cell_group.h>
#include <problems/gmsh_mesh.h>
#include <problems/round_meshes.h>
#include <scene/body_section.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/utilities.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/physics/transformations.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <set>
#include <stdexcept>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// A body shape with its name.
    template <int dim>
    struct Shape
    {
      std::string name;
      /// The parameters of the shape.
      std::set<std::string> uses;
      /// Names of its boundary ids.
      std::map<std::string, types::boundary_id> boundary_names;
      std::function<
        void(const BodySection<dim> &, Triangulation<dim> &, CellNodes<dim> &)>
        make;
    };

    template <typename Number>
    void
    check_list(const std::vector<Number> &list,
               const unsigned int         n,
               const std::string         &name)
    {
      bool good = list.size() == n;
      for (const Number number : list)
        good = good && number > 0;
      if (!good)
        throw InputError(name + " needs " + std::to_string(n) +
                         " positive numbers, separated by commas.");
    }

    /// A block with a corner at the origin.
    template <int dim>
    void
    make_block(const BodySection<dim> &p, Triangulation<dim> &cells)
    {
      check_list(p.size, dim, p.name_of("Size"));
      check_list(p.cells_along, dim, p.name_of("Cells along"));
      Point<dim> end;
      for (unsigned int c = 0; c < dim; ++c)
        end[c] = p.size[c];
      GridGenerator::subdivided_hyper_rectangle(cells,
                                                p.cells_along,
                                                Point<dim>(),
                                                end,
                                                /* colorize */ true);
      // GridGenerator colours cells, too.
      for (const auto &cell : cells.active_cell_iterators())
        cell->set_material_id(0);
    }

    /// Conditions that deal.II's generators assume without a check.
    template <int dim>
    bool
    can_be_generated(const std::string &name, const std::string &arguments)
    {
      const auto        list  = Utilities::split_string_list(arguments, ':');
      const std::string first = list.empty() ? "" : list.front();
      const auto        has_points = [&](const std::size_t n) {
        return Utilities::split_string_list(first, ';').size() == n;
      };
      if (name == "subdivided_cylinder" || name == "cylinder_shell")
        return dim == 3;
      if (name == "moebius")
        return std::atoi(first.c_str()) > 0;
      if (name == "concentric_hyper_shells")
        return list.size() > 3 && std::atoi(list[3].c_str()) > 0 &&
          std::atof(list[1].c_str()) < std::atof(list[2].c_str());
      if (name == "general_cell")
        return has_points(1U << dim);
      if (name == "simplex")
        return has_points(dim + 1);
      return true;
    }

    /// A trial in a process of its own: generators may still crash, or make
    /// meshes that no memory holds.
    template <int dim>
    void
    make_by_generator(const BodySection<dim> &p, Triangulation<dim> &cells)
    {
      const auto make = [&p](Triangulation<dim> &mesh) {
        try
          {
            if (!can_be_generated<dim>(p.generator, p.generator_arguments))
              throw std::invalid_argument(p.generator);
            GridGenerator::generate_from_name_and_arguments(
              mesh,
              p.generator,
              p.generator_arguments);
          }
        catch (const std::bad_alloc &)
          {
            throw;
          }
        catch (const std::exception &)
          {
            throw InputError(
              "deal.II's GridGenerator cannot make '" + p.generator +
              "' with the arguments '" + p.generator_arguments + "' in " +
              std::to_string(dim) + "D (" + p.name_of("Generator") +
              "). Names and arguments are those of its functions, all arguments, "
              "separated by colons: hyper_shell with 0, 0 : 1 : 2 : 12 : true.");
          }
      };
      run_apart(
        "deal.II's GridGenerator (" + p.name_of("Generator") + ")",
        [&make]() {
          Triangulation<dim> mesh;
          make(mesh);
        },
        p.meshing_time);
      make(cells);
    }

    bool
    wants_simplices(const std::string &cells)
    {
      return cells == "triangles or tetrahedra";
    }

    // The table of all shapes: a new one is one entry here.
    template <int dim>
    const std::vector<Shape<dim>> &
    table()
    {
      using P                                     = BodySection<dim>;
      using Cells                                 = Triangulation<dim>;
      using Nodes                                 = CellNodes<dim>;
      static const std::vector<Shape<dim>> shapes = [] {
        std::vector<Shape<dim>> list;
        const auto              block = [](const P &p, Cells &cells, Nodes &) {
          make_block(p, cells);
        };
        if constexpr (dim == 2)
          {
            list.push_back({"disk",
                            {"Radius", "Nodes around", "Nodes"},
                            {{"outer", 0}},
                            [](const P &p, Cells &cells, Nodes &) {
                              if (wants_simplices(p.cells))
                                make_disk_of_triangles(
                                  Point<2>(),
                                  p.radius,
                                  p.nodes_around,
                                  p.nodes > 0
                                    ? p.nodes
                                    // As the disks of papers A and B have them.
                                    : static_cast<unsigned int>(std::ceil(
                                        .09 * p.nodes_around * p.nodes_around +
                                        .5 * p.nodes_around)),
                                  cells);
                              else
                                make_disk_of_quadrilaterals(Point<2>(),
                                                            p.radius,
                                                            p.nodes_around,
                                                            cells);
                            }});
            list.push_back(
              {"ring",
               {"Radius", "Inner radius", "Nodes around", "Nodes across"},
               {{"outer", 0}, {"inner", 1}},
               [](const P &p, Cells &cells, Nodes &) {
                 if (p.inner_radius >= p.radius)
                   throw InputError(
                     p.name_of("Inner radius") + " is " +
                     to_text(p.inner_radius) + ", and has to be smaller than " +
                     p.name_of("Radius") + ", " + to_text(p.radius) + ".");
                 make_ring(Point<2>(),
                           p.inner_radius,
                           p.radius,
                           p.nodes_around,
                           p.nodes_across,
                           wants_simplices(p.cells) ? CellShape::triangles
                                                    : CellShape::quadrilaterals,
                           cells);
               }});
            list.push_back(
              {"rectangle",
               {"Size", "Cells along"},
               {{"left", 0}, {"right", 1}, {"lower", 2}, {"upper", 3}},
               block});
          }
        else
          {
            list.push_back(
              {"ball",
               {"Radius", "Mesh size", "Curved cells"},
               {{"lower", BallBoundary::lower_half},
                {"upper", BallBoundary::upper_half}},
               [](const P &p, Cells &cells, Nodes &nodes) {
                 if (p.cells == "automatic" || wants_simplices(p.cells))
                   make_ball_of_tetrahedra(Point<3>(),
                                           p.radius,
                                           p.mesh_size,
                                           cells,
                                           p.curved ? &nodes : nullptr);
                 else
                   make_ball_of_hexahedra(Point<3>(),
                                          p.radius,
                                          p.mesh_size,
                                          cells);
               }});
            list.push_back({"block",
                            {"Size", "Cells along"},
                            {{"left", 0},
                             {"right", 1},
                             {"front", 2},
                             {"back", 3},
                             {"lower", 4},
                             {"upper", 5}},
                            block});
          }
        list.push_back({"generator",
                        {"Generator", "Generator arguments"},
                        {},
                        [](const P &p, Cells &cells, Nodes &) {
                          make_by_generator(p, cells);
                        }});
        return list;
      }();
      return shapes;
    }

    /// Null for "none".
    template <int dim>
    const Shape<dim> *
    find(const std::string &name)
    {
      for (const Shape<dim> &shape : table<dim>())
        if (shape.name == name)
          return &shape;
      return nullptr;
    }

    /// The one of the material ids @p present that @p text names, by its number or one of
    /// @p names. @param where for messages. @throws InputError
    types::material_id
    find_group(const std::string                               &text,
               const std::string                               &where,
               const std::set<types::material_id>              &present,
               const std::map<std::string, types::material_id> &names)
    {
      std::string list;
      for (const auto id : present)
        {
          std::vector<std::string> own = {std::to_string(id)};
          for (const auto &[name, named_id] : names)
            if (named_id == id)
              own.push_back(name);
          if (std::find(own.begin(), own.end(), text) != own.end())
            return id;
          for (const std::string &name : own)
            list += (list.empty() ? "" : ", ") + name;
        }
      throw InputError(where + ": the mesh has no cells '" +
                       text.substr(0, 100) + "'. There is: " + list + ".");
    }

    /// The mesh without its history of refinement; simplices if wanted.
    template <int dim>
    void
    flatten(Triangulation<dim> &fine,
            const bool          to_simplices,
            Triangulation<dim> &flat)
    {
      if (!to_simplices || fine.all_reference_cells_are_simplex())
        return GridGenerator::flatten_triangulation(fine, flat);
      Triangulation<dim> quadrilaterals;
      GridGenerator::flatten_triangulation(fine, quadrilaterals);
      GridGenerator::convert_hypercube_to_simplex_mesh(quadrilaterals, flat);
    }
  } // namespace



  MaterialParameters
  default_material()
  {
    MaterialParameters material;
    material.law                     = "neo-Hookean";
    material.plane_state             = "plane strain";
    material.values["Poisson ratio"] = .3;
    material.values["Young modulus"] = 1e6;
    return material;
  }



  template <int dim>
  BodySection<dim>::BodySection(const NamedSection &section)
    : section(section)
    , size(dim, 1.)
    , cells_along(dim, 8)
  {
    axis[2]          = 1.;
    second_axis[2]   = 1.;
    material         = default_material();
    material.section = section.full_name();
  }



  template <int dim>
  void
  BodySection<dim>::add_parameters(ParameterHandler &parameters)
  {
    material.add_parameters(parameters);
    std::string shapes = "none";
    for (const Shape<dim> &entry : table<dim>())
      shapes += "|" + entry.name;

    parameters.enter_subsection(section.full_name());
    parameters.add_parameter(
      "File",
      file,
      "Mesh file: of Gmsh (.msh, format 2.2 or 4.1), universal (.unv) or .vtk, or a "
      "geometry (.geo, .step, .stl) that Gmsh is to mesh. Boundaries are known by the "
      "numbers and names of physical groups. In a parameter file the path counts "
      "from the folder of that file.",
      Patterns::FileName());
    parameters.add_parameter(
      "Group",
      group,
      "The physical group of cells in the file that is this body, by its number or name, "
      "where the file has several bodies. Empty: all cells.",
      Patterns::Anything());
    parameters.add_parameter("Shape",
                             shape,
                             "What to make where there is no file. generator: "
                             "one of deal.II's GridGenerator.",
                             Patterns::Selection(shapes));
    parameters.add_parameter("Radius",
                             radius,
                             "Radius of the shape, the outer one (m).",
                             Patterns::Double(1e-30));
    parameters.add_parameter("Size",
                             size,
                             "Extents of the block along x, y and z (m); one "
                             "corner is at the origin.");
    parameters.add_parameter("Cells along",
                             cells_along,
                             "Numbers of cells along x, y and z.");
    if constexpr (dim == 2)
      {
        parameters.add_parameter("Inner radius",
                                 inner_radius,
                                 "Inner radius of the ring (m).",
                                 Patterns::Double(1e-30));
        parameters.add_parameter(
          "Nodes around",
          nodes_around,
          "Vertices on the circle; of a disk of quadrilaterals 8, 16, 32, ...",
          Patterns::Integer(8, 100000));
        parameters.add_parameter("Nodes across",
                                 nodes_across,
                                 "Vertices through the wall of the ring.",
                                 Patterns::Integer(2, 10000));
        parameters.add_parameter(
          "Nodes",
          nodes,
          "All vertices of a disk of triangles; 0 for as "
          "many as make them nearly equilateral.",
          Patterns::Integer(0, 10000000));
      }
    else
      parameters.add_parameter("Curved cells",
                               curved,
                               "Whether the edges of tetrahedra are curved, so "
                               "that the ball is round; takes Mesh/Degree = 2. "
                               "In a file the order of the elements is used.");
    parameters.add_parameter(
      "Mesh size",
      mesh_size,
      "Length of elements where Gmsh makes the mesh (m).",
      Patterns::Double(0.));
    parameters.add_parameter("Generator",
                             generator,
                             "Name of a function of GridGenerator.",
                             Patterns::Anything());
    parameters.add_parameter("Generator arguments",
                             generator_arguments,
                             "All its arguments after the mesh, separated by "
                             "colons: 0, 0 : 1 : 2 : 12 : true.",
                             Patterns::Anything());
    parameters.add_parameter(
      "Refinements",
      refinements,
      "How often all cells are halved in each direction; "
      "boundaries of shapes stay round.",
      Patterns::Integer(0, 8));
    parameters.add_parameter(
      "Cells",
      cells,
      "Kind of the cells that are made. automatic: tetrahedra of a ball, "
      "otherwise quadrilaterals or hexahedra; those of the file.",
      Patterns::Selection("automatic|quadrilaterals or hexahedra|triangles or "
                          "tetrahedra"));
    parameters.add_parameter(
      "Material",
      material_name,
      "The name of a section 'Material NAME' that replaces law, density, "
      "moduli and viscosity here: for several bodies of one material.",
      Patterns::Anything());
    parameters.add_parameter(
      "Materials",
      materials,
      "Which cells are of a material with a section 'Material NAME' of its own, by "
      "the number or the name of their physical group: '3: rubber; core: steel'. All "
      "others are of the material that is described here.",
      Patterns::Anything());
    parameters.add_parameter("Scale",
                             scale,
                             "Factor by which the mesh is made larger, before "
                             "it is turned and moved.",
                             Patterns::Double(1e-30));
    parameters.add_parameter("Rotation",
                             angle,
                             "Angle by which it is then turned about the "
                             "origin, against the clock (rad).");
    if constexpr (dim == 3)
      {
        parameters.add_parameter("Rotation axis",
                                 axis,
                                 "The axis about which it is turned, of any "
                                 "length.");
        parameters.add_parameter(
          "Second rotation",
          second_angle,
          "Angle by which it is turned after that, about the "
          "origin (rad).");
        parameters.add_parameter(
          "Second rotation axis",
          second_axis,
          "The axis of the second rotation, of any length.");
      }
    parameters.add_parameter("Translation",
                             translation,
                             "By how much it is then moved (m).");
    parameters.add_parameter("Velocity",
                             velocity,
                             "Velocity of the middle of its mass at the start "
                             "(m/s).");
    if constexpr (dim == 2)
      parameters.add_parameter("Spin",
                               spin[2],
                               "Angular velocity at the start about the middle "
                               "of its mass, against the clock (rad/s).");
    else
      parameters.add_parameter("Spin",
                               spin,
                               "Angular velocity at the start about the middle "
                               "of its mass (rad/s).");
    parameters.add_parameter(
      "Acceleration",
      acceleration,
      "Force per mass beside gravity (m/s^2): expressions of x, y, z and the "
      "time t, separated by semicolons; empty for none.",
      Patterns::Anything());
    parameters.leave_subsection();
  }



  template <int dim>
  std::vector<UnusedParameter>
  BodySection<dim>::unused_parameters() const
  {
    std::vector<UnusedParameter> unused = material.unused_parameters();
    if (!material_name.empty())
      {
        unused.clear();
        for (const std::string &name : MaterialParameters::names())
          unused.push_back({name_of(name),
                            "bodies with a material of their own; " +
                              name_of("Material") + " is " + material_name});
      }
    const Shape<dim>     *own = find<dim>(shape);
    std::set<std::string> names;
    for (const Shape<dim> &entry : table<dim>())
      names.insert(entry.uses.begin(), entry.uses.end());
    for (const std::string &name : names)
      if (!own || own->uses.count(name) == 0)
        {
          if (name == "Mesh size" && !file.empty())
            continue;
          std::string owners;
          for (const Shape<dim> &entry : table<dim>())
            if (entry.uses.count(name) > 0)
              owners += (owners.empty() ? "" : " and ") + entry.name;
          unused.push_back(
            {name_of(name), owners + "; " + name_of("Shape") + " is " + shape});
        }
    if (!file.empty() && !is_geometry(file))
      unused.push_back(
        {name_of("Mesh size"),
         "geometries that Gmsh meshes; " + name_of("File") + " is " + file});
    if (shape == "disk" && !wants_simplices(cells))
      unused.push_back(
        {name_of("Nodes"),
         "disks of triangles; " + name_of("Cells") + " is " + cells});
    if (file.empty())
      unused.push_back(
        {name_of("Group"),
         "bodies from a file; " + name_of("Shape") + " is " + shape});
    if (!file.empty() && cells != "automatic")
      unused.push_back(
        {name_of("Cells"),
         "shapes that are made; " + name_of("File") + " is " + file});
    for (const auto &[name, own_angle] :
         {std::pair<std::string, double>{"Rotation", angle},
          {"Second rotation", second_angle}})
      if (own_angle == 0. && dim == 3)
        unused.push_back(
          {name_of(name + " axis"), "rotation; " + name_of(name) + " is 0"});
    return unused;
  }



  template <int dim>
  void
  BodySection<dim>::keep_mesh(RunFolder &folder) const
  {
    if (!is_geometry(file))
      return;
    const std::string name = RunFolder::name_of_mesh(section.column_name());
    if (folder.resume)
      {
        // Nothing is touched before the checkpoint has been found to belong to this run.
        if (std::filesystem::exists(folder.file(name)))
          folder.log("the mesh of '" + section.name + "' is the one of " +
                     name);
        return;
      }
    folder.begin();
    on_first_rank(folder.communicator, [&]() {
      write_atomically(folder.file(name), mesh_of_geometry(file, mesh_size));
    });
  }



  template <int dim>
  void
  BodySection<dim>::make_mesh(BodyMesh<dim>     &mesh,
                              const double       advance,
                              const std::string &kept_meshes) const
  {
    const Shape<dim> *own = find<dim>(shape);
    if (file.empty() == (own == nullptr))
      throw InputError(section.where + ": the body '" + section.name +
                       "' needs either a " + name_of("File") + " or a " +
                       name_of("Shape") +
                       (file.empty() ? "; it has neither." : "; it has both."));
    if (own && own->uses.count("Mesh size") > 0 && mesh_size == 0.)
      throw InputError(name_of("Mesh size") +
                       " has to be given for the shape '" + shape + "'.");
    if (curved && (refinements > 0 || cells == "quadrilaterals or hexahedra"))
      throw InputError(name_of("Curved cells") +
                       " is for tetrahedra that are not refined.");

    Triangulation<dim> fine;
    if (own)
      {
        own->make(*this, fine, mesh.nodes);
        mesh.boundary_names = own->boundary_names;
      }
    else
      mesh.nodes =
        read_any_mesh(file,
                      mesh_size,
                      fine,
                      mesh.boundary_names,
                      mesh.material_names,
                      meshing_time,
                      kept_meshes.empty() ? ""
                                          : kept_meshes + "/" +
                          RunFolder::name_of_mesh(section.column_name()));
    if (!group.empty() && !own)
      {
        std::set<types::material_id> present;
        for (const auto &cell : fine.active_cell_iterators())
          present.insert(cell->material_id());
        keep_cells_of(
          find_group(group, name_of("Group"), present, mesh.material_names),
          fine,
          mesh.nodes);
      }
    if (!mesh.nodes.empty() && refinements > 0)
      throw InputError("The mesh '" + file +
                       "' has elements of second order, which cannot be "
                       "refined: set " +
                       name_of("Refinements") + " to 0.");
    fine.refine_global(refinements);
    flatten(fine, own && wants_simplices(cells), mesh.cells);
    place(mesh, advance);
  }



  template <int dim>
  double
  BodySection<dim>::vertices_at_least() const
  {
    double n = 1.;
    if (shape == "rectangle" || shape == "block")
      for (const unsigned int along : cells_along)
        n *= along;
    else if (shape == "disk")
      n = .02 * nodes_around * static_cast<double>(nodes_around);
    else if (shape == "ring")
      n = static_cast<double>(nodes_around) * nodes_across;
    else if (shape == "ball" && mesh_size > 0.)
      n = std::pow(radius / mesh_size, 3);
    return std::floor(n * std::pow(2., dim * static_cast<double>(refinements)));
  }



  template <int dim>
  std::map<types::material_id, std::string>
  BodySection<dim>::named_materials(const BodyMesh<dim> &mesh) const
  {
    std::map<types::material_id, std::string> names;
    for (const std::string &item : Utilities::split_string_list(materials, ';'))
      {
        const std::size_t colon    = item.find(':');
        const std::string group    = Utilities::trim(item.substr(0, colon));
        const std::string material = colon == std::string::npos
          ? ""
          : Utilities::trim(item.substr(colon + 1));
        if (material.empty())
          throw InputError(
            name_of("Materials") + ": '" + item.substr(0, 100) +
            "' should be 'number or name of the cells: name of a "
            "material'.");
        std::set<types::material_id> present;
        for (const auto &share : mesh.shares)
          present.insert(share.first);
        const auto id =
          find_group(group, name_of("Materials"), present, mesh.material_names);
        if (!names.emplace(id, material).second)
          throw InputError(name_of("Materials") + " gives the cells '" + group +
                           "' two materials.");
      }
    return names;
  }



  template <int dim>
  void
  BodySection<dim>::place(BodyMesh<dim> &mesh, const double advance) const
  {
    const auto rotation_about = [this](const Tensor<1, 3> &direction,
                                       const double        by_angle,
                                       const std::string  &name) {
      if (direction.norm() == 0.)
        throw InputError(name_of(name) + " is a vector of no length.");
      return Physics::Transformations::Rotations::rotation_matrix_3d(
        Point<3>(direction / direction.norm()),
        by_angle);
    };
    const Tensor<2, 3> rotation =
      rotation_about(second_axis, second_angle, "Second rotation axis") *
      rotation_about(axis, angle, "Rotation axis");
    const bool is_turned = angle != 0. || second_angle != 0.;
    const auto placed    = [&](const Point<dim> &x) {
      Tensor<1, 3> scaled;
      for (unsigned int c = 0; c < dim; ++c)
        scaled[c] = scale * x[c];
      const Tensor<1, 3> turned = is_turned ? rotation * scaled : scaled;
      Point<dim>         result;
      for (unsigned int c = 0; c < dim; ++c)
        result[c] = turned[c] + translation[c] + advance * velocity[c];
      return result;
    };
    GridTools::transform(placed, mesh.cells);
    for (auto &cell : mesh.nodes)
      for (Point<dim> &node : cell)
        node = placed(node);

    // Volumes of straight cells are accurate enough for output, and for the
    // centre of mass.
    const bool simplices = mesh.cells.all_reference_cells_are_simplex();
    std::unique_ptr<Mapping<dim>>        mapping;
    std::unique_ptr<Quadrature<dim>>     rule;
    std::unique_ptr<Quadrature<dim - 1>> face_rule;
    std::unique_ptr<FiniteElement<dim>>  element;
    if (simplices)
      {
        mapping   = std::make_unique<MappingFE<dim>>(FE_SimplexP<dim>(1));
        rule      = std::make_unique<QGaussSimplex<dim>>(2);
        face_rule = std::make_unique<QGaussSimplex<dim - 1>>(2);
        element   = std::make_unique<FE_Nothing<dim>>(
          dim == 2 ? ReferenceCells::Triangle : ReferenceCells::Tetrahedron);
      }
    else
      {
        mapping   = std::make_unique<MappingQ<dim>>(1);
        rule      = std::make_unique<QGauss<dim>>(2);
        face_rule = std::make_unique<QGauss<dim - 1>>(2);
        element   = std::make_unique<FE_Nothing<dim>>();
      }
    FEValues<dim>     values(*mapping,
                         *element,
                         *rule,
                         update_JxW_values | update_quadrature_points);
    FEFaceValues<dim> face_values(*mapping,
                                  *element,
                                  *face_rule,
                                  update_JxW_values | update_normal_vectors |
                                    update_quadrature_points);
    for (const auto &cell : mesh.cells.active_cell_iterators())
      {
        values.reinit(cell);
        auto &share = mesh.shares[cell->material_id()];
        for (const unsigned int q : values.quadrature_point_indices())
          {
            share.measure += values.JxW(q);
            share.moment +=
              values.JxW(q) * Tensor<1, dim>(values.quadrature_point(q));
          }
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            {
              face_values.reinit(cell, f);
              auto &boundary = mesh.boundaries[cell->face(f)->boundary_id()];
              for (const unsigned int q :
                   face_values.quadrature_point_indices())
                {
                  const double area = face_values.JxW(q);
                  boundary.area += area;
                  boundary.moment +=
                    area * Tensor<1, dim>(face_values.quadrature_point(q));
                  boundary.normal += area * face_values.normal_vector(q);
                }
            }
      }
  }


  template struct BodySection<2>;
  template struct BodySection<3>;
} // namespace Ricochet
