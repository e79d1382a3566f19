// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/child_process.h>
#include <base/exceptions.h>
#include <base/files.h>
#include <base/one_rank.h>
#include <base/parameter_file.h>
#include <base/read_only_thread.h>
#include <problems/gmsh_element_types.h>
#include <problems/gmsh_file_check.h>
#include <problems/gmsh_mesh.h>
#include <problems/unv_groups.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>

#include <gmsh.h>

#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Gmsh's library is open while this lives.
    struct GmshSession
    {
      GmshSession()
      {
        // Without the files in the user's home, which would make other meshes.
        gmsh::initialize(0, nullptr, false);
        // Gmsh keeps quiet, and its random numbers begin the same each time.
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::option::setNumber("General.NumThreads", 1);
      }

      ~GmshSession()
      {
        gmsh::finalize();
      }
    };



    /// Elements of one dimension, with their nodes by Gmsh's tags.
    struct Elements
    {
      const GmshElementType   *type;
      int                      physical_group;
      std::vector<std::size_t> nodes;
    };



    /// The elements of dimension @p dim of Gmsh's model.
    std::vector<Elements>
    get_elements(const int dim)
    {
      std::vector<Elements> all;
      gmsh::vectorpair      entities;
      gmsh::model::getEntities(entities, dim);
      for (const auto &[entity_dim, tag] : entities)
        {
          std::vector<int> groups, types;
          gmsh::model::getPhysicalGroupsForEntity(entity_dim, tag, groups);
          std::vector<std::vector<std::size_t>> elements, nodes;
          gmsh::model::mesh::getElements(types,
                                         elements,
                                         nodes,
                                         entity_dim,
                                         tag);
          for (unsigned int k = 0; k < types.size(); ++k)
            all.push_back({find_gmsh_element_type(types[k]),
                           groups.empty() ? 0 : groups.front(),
                           nodes[k]});
        }
      return all;
    }



    /// The positions of nodes by Gmsh's tags (m).
    template <int dim>
    std::map<std::size_t, Point<dim>>
    get_positions()
    {
      std::vector<std::size_t> tags;
      std::vector<double>      coordinates, parametric;
      gmsh::model::mesh::getNodes(tags, coordinates, parametric);
      std::map<std::size_t, Point<dim>> positions;
      for (std::size_t k = 0; k < tags.size(); ++k)
        for (unsigned int d = 0; d < dim; ++d)
          positions[tags[k]][d] = coordinates[3 * k + d];
      return positions;
    }



    /// Input for deal.II's create_triangulation().
    template <int dim>
    struct Description
    {
      std::vector<Point<dim>>    points;
      std::vector<CellData<dim>> cells;
      SubCellData                boundary;
      /// Empty for cells of first order.
      NodesBetween<dim> between;
    };



    /// The position of vertex @p v of an element of Gmsh in deal.II's order.
    template <int dim>
    unsigned int
    place_of_vertex(const GmshElementType &type, const unsigned int v)
    {
      return type.n_vertices == (1U << dim) && dim > 1
        ? GeometryInfo<dim>::ucd_to_deal[v]
        : v;
    }



    /// The mesh of Gmsh's model.
    template <int dim>
    Description<dim>
    describe_model()
    {
      const std::map<std::size_t, Point<dim>> positions = get_positions<dim>();
      Description<dim>                        mesh;
      // Nodes that are vertices of no cell stay out.
      std::map<std::size_t, unsigned int> number;
      const auto sorted = [&](std::vector<unsigned int> vertices) {
        std::sort(vertices.begin(), vertices.end());
        return vertices;
      };
      for (const Elements &elements : get_elements(dim))
        {
          const GmshElementType &type = *elements.type;
          for (std::size_t begin = 0; begin < elements.nodes.size();
               begin += type.n_nodes)
            {
              CellData<dim> cell(type.n_vertices);
              cell.material_id = elements.physical_group;
              std::vector<unsigned int> vertices;
              for (unsigned int v = 0; v < type.n_vertices; ++v)
                {
                  const std::size_t tag = elements.nodes[begin + v];
                  const auto [entry, is_new] =
                    number.emplace(tag, mesh.points.size());
                  if (is_new)
                    mesh.points.push_back(positions.at(tag));
                  vertices.push_back(entry->second);
                  cell.vertices[place_of_vertex<dim>(type, v)] = entry->second;
                }
              mesh.cells.push_back(cell);
              if (type.order == 1)
                continue;
              unsigned int node = type.n_vertices;
              for (const auto &place : type.places)
                {
                  std::vector<unsigned int> around;
                  for (const unsigned int v : place)
                    around.push_back(vertices[v]);
                  mesh.between[sorted(around)] =
                    positions.at(elements.nodes[begin + node++]);
                }
              if (node < type.n_nodes)
                mesh.between[sorted(vertices)] =
                  positions.at(elements.nodes[begin + node]);
            }
        }
      for (const Elements &elements : get_elements(dim - 1))
        {
          const GmshElementType &type = *elements.type;
          for (std::size_t begin = 0;
               elements.physical_group != 0 && begin < elements.nodes.size();
               begin += type.n_nodes)
            {
              CellData<dim - 1> face(type.n_vertices);
              face.boundary_id = elements.physical_group;
              for (unsigned int v = 0; v < type.n_vertices; ++v)
                face.vertices[place_of_vertex<dim - 1>(type, v)] =
                  number.at(elements.nodes[begin + v]);
              if constexpr (dim == 2)
                mesh.boundary.boundary_lines.push_back(face);
              else
                mesh.boundary.boundary_quads.push_back(face);
            }
        }
      return mesh;
    }



    /// Make a mesh of the cells in the order of Hilbert's curve: cells that are beside each other in the body
    /// are so in memory, and so are their unknowns, which are numbered cell by cell. Gmsh's
    /// order is that in which it has found them.
    template <int dim>
    void
    create_along_curve(const std::vector<Point<dim>> &points,
                       std::vector<CellData<dim>>   &&cells,
                       const SubCellData             &boundary,
                       Triangulation<dim>            &triangulation)
    {
      std::vector<Point<dim>> centers;
      for (const CellData<dim> &cell : cells)
        {
          Point<dim> center;
          for (const unsigned int v : cell.vertices)
            center += points[v] / double(cell.vertices.size());
          centers.push_back(center);
        }
      const auto places =
        Utilities::inverse_Hilbert_space_filling_curve(centers, 20);
      std::vector<unsigned int> order(cells.size());
      std::iota(order.begin(), order.end(), 0U);
      std::stable_sort(order.begin(),
                       order.end(),
                       [&](const unsigned int a, const unsigned int b) {
                         return places[a] < places[b];
                       });
      std::vector<CellData<dim>> ordered;
      ordered.reserve(cells.size());
      for (const unsigned int c : order)
        ordered.push_back(std::move(cells[c]));
      triangulation.create_triangulation(points, ordered, boundary);
    }



    /// Run @p work, which calls Gmsh; errors are reported as "Gmsh cannot @p
    /// do_what".
    template <typename Result>
    Result
    with_gmsh(const std::string &do_what, const std::function<Result()> &work)
    {
      try
        {
          const GmshSession session;
          return work();
        }
      catch (const std::bad_alloc &)
        {
          throw;
        }
      catch (const std::logic_error &)
        {
          // A sentence for the user in place of "vector larger than
          // max_size()".
          throw InputError("Gmsh cannot " + do_what +
                           ": its numbers make no sense.");
        }
      catch (const std::exception &exception)
        {
          throw InputError("Gmsh cannot " + do_what + ": " + exception.what());
        }
      catch (const std::string &message)
        {
          throw InputError("Gmsh cannot " + do_what + ": " + message);
        }
    }



    /// Check that elements of a given length are not far too many for any
    /// machine: Gmsh would crash only after a long time.
    void
    check_number_of_elements(const unsigned int dim, const double mesh_size)
    {
      std::array<double, 3> lower, upper;
      gmsh::model::getBoundingBox(-1,
                                  -1,
                                  lower[0],
                                  lower[1],
                                  lower[2],
                                  upper[0],
                                  upper[1],
                                  upper[2]);
      double n = 1.;
      for (unsigned int c = 0; c < dim; ++c)
        n *= std::max(1., (upper[c] - lower[c]) / mesh_size);
      if (n > 1e9)
        throw std::runtime_error("with elements of the length " +
                                 to_text(mesh_size) +
                                 " the mesh would be too fine.");
    }



    /// A folder for a temporary file, removed with this object.
    class TemporaryFolder
    {
    public:
      TemporaryFolder()
      {
        std::error_code             error;
        const std::filesystem::path parent =
          std::filesystem::temp_directory_path(error);
        name = (parent / "ricochet-XXXXXX").string();
        if (error || mkdtemp(name.data()) == nullptr)
          throw std::runtime_error(
            "no folder for temporary files can be made: " +
            (error ? error.message() : std::strerror(errno)) +
            ". The environment variable TMPDIR says where.");
      }

      ~TemporaryFolder()
      {
        std::error_code ignored;
        std::filesystem::remove_all(name, ignored);
      }

      TemporaryFolder(const TemporaryFolder &) = delete;
      TemporaryFolder &
      operator=(const TemporaryFolder &) = delete;

      std::string
      file(const std::string &file_name) const
      {
        return name + "/" + file_name;
      }

    private:
      std::string name;
    };



    /// A file in memory, which a child process can fill.
    class MemoryFile
    {
    public:
      MemoryFile()
        : descriptor(memfd_create("ricochet-mesh", MFD_CLOEXEC))
      {
        if (descriptor < 0)
          throw ComputationError(
            std::string("No file in memory can be made: ") +
            std::strerror(errno) + ".");
      }

      ~MemoryFile()
      {
        close(descriptor);
      }

      MemoryFile(const MemoryFile &) = delete;
      MemoryFile &
      operator=(const MemoryFile &) = delete;

      std::string
      name() const
      {
        return "/proc/self/fd/" + std::to_string(descriptor);
      }

    private:
      const int descriptor;
    };



    /// Gmsh reads options beside a file without a word. @throws InputError
    void
    refuse_options_beside(const std::string &file_name)
    {
      const std::string options = file_name + ".opt";
      if (std::filesystem::exists(options))
        throw InputError("Beside '" + file_name + "' lies '" + options +
                         "', which Gmsh would follow without a word. Write "
                         "its options into the geometry, and remove it.");
    }



    /// Write Gmsh's mesh into @p msh_file, which may have any name, while Gmsh wants one
    /// that ends with .msh. Signals are blocked for this short time: a run that
    /// is killed leaves no files behind.
    void
    write_msh(const std::string &msh_file)
    {
      prctl(PR_SET_PDEATHSIG, 0);
      for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        std::signal(signal, SIG_IGN);
      // mpirun kills whole groups.
      setpgid(0, 0);
      const TemporaryFolder folder;
      const std::string     file = folder.file("mesh.msh");
      gmsh::write(file);
      // Gmsh does not report a full disk.
      std::ifstream     in(file, std::ios::binary);
      const std::string text((std::istreambuf_iterator<char>(in)), {});
      std::ofstream     out(msh_file, std::ios::binary);
      if (text.rfind("$EndElements") == std::string::npos ||
          !out.write(text.data(), text.size()).flush())
        throw std::runtime_error("the mesh cannot be written to '" + file +
                                 "': there may be no space left.");
    }
    /// The ending of a name, in small letters.
    std::string
    ending_of(const std::string &file_name)
    {
      std::string ending =
        std::filesystem::path(file_name).extension().string();
      for (char &c : ending)
        c = std::tolower(static_cast<unsigned char>(c));
      return ending;
    }



    /// Make the groups of a universal file physical ones, in a model that has the same mesh.
    void
    apply_groups(const UnvGroups &groups)
    {
      std::vector<std::size_t> nodes;
      std::vector<double>      places, parameters;
      gmsh::model::mesh::getNodes(nodes, places, parameters);
      // Types of elements by dimension and group.
      struct Elements
      {
        std::vector<std::size_t> numbers, nodes;
      };
      std::map<std::pair<int, int>, std::map<int, Elements>> entities;
      std::vector<int>                                       types;
      std::vector<std::vector<std::size_t>>                  numbers, corners;
      gmsh::model::mesh::getElements(types, numbers, corners);
      for (unsigned int t = 0; t < types.size(); ++t)
        {
          std::string         name;
          int                 dimension, order, n, n_primary;
          std::vector<double> unit_places;
          gmsh::model::mesh::getElementProperties(types[t],
                                                  name,
                                                  dimension,
                                                  order,
                                                  n,
                                                  unit_places,
                                                  n_primary);
          for (std::size_t e = 0; e < numbers[t].size(); ++e)
            {
              const auto group = groups.group_of_element.find(numbers[t][e]);
              Elements  &own   = entities[{dimension,
                                        group == groups.group_of_element.end()
                                             ? 0
                                             : group->second}][types[t]];
              own.numbers.push_back(numbers[t][e]);
              own.nodes.insert(own.nodes.end(),
                               corners[t].begin() + e * n,
                               corners[t].begin() + (e + 1) * n);
            }
        }
      gmsh::model::add("with groups");
      bool has_nodes = false;
      for (const auto &[key, by_type] : entities)
        {
          const auto [dimension, group] = key;
          const int entity = gmsh::model::addDiscreteEntity(dimension);
          if (!has_nodes)
            gmsh::model::mesh::addNodes(dimension, entity, nodes, places);
          has_nodes = true;
          for (const auto &[type, elements] : by_type)
            gmsh::model::mesh::addElementsByType(entity,
                                                 type,
                                                 elements.numbers,
                                                 elements.nodes);
          if (group == 0)
            continue;
          gmsh::model::addPhysicalGroup(dimension, {entity}, group);
          gmsh::model::setPhysicalName(dimension,
                                       group,
                                       groups.names.at(group));
        }
    }



    /// Make the body that the triangles of a file of stereolithography enclose. Edges between
    /// triangles that meet at more than 40 degrees separate parts of its boundary.
    void
    make_body_of_triangles()
    {
      gmsh::model::mesh::classifySurfaces(40. * numbers::PI / 180.,
                                          /* boundary */ true,
                                          /* for a new mesh of it */ true,
                                          numbers::PI);
      gmsh::model::mesh::createGeometry();
      gmsh::vectorpair surfaces;
      gmsh::model::getEntities(surfaces, 2);
      std::vector<int> tags;
      for (const auto &surface : surfaces)
        tags.push_back(surface.second);
      gmsh::model::geo::addVolume({gmsh::model::geo::addSurfaceLoop(tags)});
      gmsh::model::geo::synchronize();
    }
  } // namespace



  void
  mesh_by_gmsh(const std::function<void()> &describe,
               Triangulation<3>            &triangulation,
               CellNodes<3>                *curved)
  {
    auto mesh = with_gmsh<Description<3>>("make the mesh", [&]() {
      gmsh::model::add("body");
      describe();
      gmsh::model::occ::synchronize();
      gmsh::model::mesh::generate(3);
      if (curved)
        gmsh::model::mesh::setOrder(2);
      return describe_model<3>();
    });
    create_along_curve(mesh.points,
                       std::move(mesh.cells),
                       mesh.boundary,
                       triangulation);
    if (curved)
      *curved = collect_cell_nodes(triangulation, mesh.between);
  }



  template <int dim>
  CellNodes<dim>
  read_gmsh_mesh(const std::string  &file_name,
                 Triangulation<dim> &triangulation)
  {
    const bool       is_curved = check_gmsh_file(file_name, dim) == 2;
    Description<dim> mesh;
    if (is_curved)
      {
        refuse_options_beside(file_name);
        mesh = with_gmsh<Description<dim>>("read the mesh '" + file_name + "'",
                                           [&]() {
                                             gmsh::open(file_name);
                                             return describe_model<dim>();
                                           });
      }
    try
      {
        if (!is_curved)
          {
            std::ifstream file(file_name);
            GridIn<dim>   reader(triangulation);
            reader.read_msh(file);
            auto [points, cells, boundary] =
              GridTools::get_coarse_mesh_description(triangulation);
            triangulation.clear();
            create_along_curve(points,
                               std::move(cells),
                               boundary,
                               triangulation);
            return {};
          }
        GridTools::invert_cells_with_negative_measure(mesh.points, mesh.cells);
        if (mesh.cells.front().vertices.size() == (1U << dim))
          GridTools::consistently_order_cells(mesh.cells);
        create_along_curve(mesh.points,
                           std::move(mesh.cells),
                           mesh.boundary,
                           triangulation);
      }
    catch (const std::exception &)
      {
        // Known errors were excluded by the checks above.
        throw InputError("The mesh file '" + file_name +
                         "' cannot be made a mesh of: its cells do not fit "
                         "together.");
      }
    return collect_cell_nodes(triangulation, mesh.between);
  }


  std::map<std::string, unsigned int>
  physical_groups(const std::string &file_name, const unsigned int dim)
  {
    std::map<std::string, unsigned int> groups;
    std::ifstream                       file(file_name);
    std::string                         line;
    while (std::getline(file, line) && line.rfind("$PhysicalNames", 0) != 0)
      ;
    std::getline(file, line);
    while (std::getline(file, line) && line.rfind("$End", 0) != 0)
      {
        std::istringstream words(line);
        unsigned int       group_dim = 0, number = 0;
        const std::size_t  begin = line.find('"'), end = line.rfind('"');
        if (!(words >> group_dim >> number) || group_dim != dim || begin >= end)
          continue;
        const std::string name = line.substr(begin + 1, end - begin - 1);
        if (!groups.emplace(name, number).second)
          throw InputError("The mesh file '" + file_name +
                           "' has two physical groups of one dimension with "
                           "the name '" +
                           name + "', " + std::to_string(groups[name]) +
                           " and " + std::to_string(number) + ".");
        if (name.find_first_not_of("0123456789") == std::string::npos &&
            name != std::to_string(number))
          throw InputError("The mesh file '" + file_name +
                           "' calls its physical group " +
                           std::to_string(number) + " '" + name +
                           "', which is the number of another one.");
      }
    return groups;
  }



  void
  convert_to_gmsh_mesh(const std::string &file_name,
                       const std::string &msh_file,
                       const unsigned int dim,
                       const double       mesh_size,
                       const unsigned int seconds)
  {
    // A geometry is a script, which may come from an untrusted source.
    const auto make_mesh = [&]() {
      if (mesh_size > 0.)
        for (const std::string bound : {"Min", "Max"})
          gmsh::option::setNumber("Mesh.MeshSize" + bound, mesh_size);
      gmsh::open(file_name);
      if (ending_of(file_name) == ".unv")
        apply_groups(read_unv_groups(read_file(file_name)));
      if (dim == 3 && ending_of(file_name) == ".stl")
        make_body_of_triangles();
      gmsh::vectorpair bodies;
      gmsh::model::getEntities(bodies, dim);
      if (bodies.empty())
        throw std::runtime_error("there is nothing of dimension " +
                                 std::to_string(dim) + " in it.");
      if (get_elements(dim).empty())
        {
          if (mesh_size > 0.)
            check_number_of_elements(dim, mesh_size);
          gmsh::model::mesh::generate(dim);
        }
      gmsh::vectorpair groups;
      gmsh::model::getPhysicalGroups(groups, dim);
      // Solids of a part from CAD can be taken one by one, by their numbers.
      if (groups.empty())
        for (const auto &entity : bodies)
          gmsh::model::addPhysicalGroup(dim, {entity.second}, entity.second);
      gmsh::model::getPhysicalGroups(groups, dim - 1);
      gmsh::vectorpair boundaries;
      gmsh::model::getBoundary(bodies,
                               boundaries,
                               /* combined */ true,
                               /* oriented */ false);
      if (groups.empty())
        for (const auto &entity : boundaries)
          gmsh::model::addPhysicalGroup(dim - 1,
                                        {entity.second},
                                        entity.second);
    };
    const auto convert = [&]() {
      run_read_only(make_mesh);
      gmsh::option::setNumber("Mesh.MshFileVersion", 2.2);
      gmsh::option::setNumber("Mesh.Binary", 0);
      // Scripts can ask for files to be left at the end.
      for (const std::string file : {"Options", "Session"})
        gmsh::option::setNumber("General.Save" + file, 0);
      write_msh(msh_file);
      return true;
    };
    // Gmsh crashes on some geometries, and a script may end the process it is in.
    run_apart(
      "Gmsh",
      [&]() { with_gmsh<bool>("read '" + file_name + "'", convert); },
      seconds);
  }



  namespace
  {
    /// Whether Gmsh reads a file that has a mesh already.
    bool
    is_mesh_of_others(const std::string &file_name)
    {
      const std::string ending = ending_of(file_name);
      return ending == ".vtk" || ending == ".unv";
    }



    /// Meshes that Gmsh has made of files in this process, as texts in its format; by file
    /// name, contents and mesh size.
    std::string &
    converted(const std::string &file_name, const double mesh_size)
    {
      static std::map<std::string, std::string> texts;
      return texts[file_name + '\n' + std::to_string(mesh_size) + '\n' +
                   read_file(file_name)];
    }

    /// Convert a file as convert_to_gmsh_mesh() does. @return the mesh. @throws InputError
    std::string
    convert_in_memory(const std::string &file_name,
                      const unsigned int dim,
                      const double       mesh_size,
                      const unsigned int seconds)
    {
      const MemoryFile file;
      try
        {
          convert_to_gmsh_mesh(file_name, file.name(), dim, mesh_size, seconds);
          return read_file(file.name());
        }
      catch (const InputError &error)
        {
          throw InputError("The mesh file '" + file_name +
                           "' cannot be taken: " + error.what());
        }
    }
  } // namespace



  bool
  is_geometry(const std::string &file_name)
  {
    const std::string ending = ending_of(file_name);
    return ending == ".geo" || ending == ".step" || ending == ".stp" ||
      ending == ".stl";
  }



  std::string
  mesh_of_geometry(const std::string &file_name, const double mesh_size)
  {
    return converted(file_name, mesh_size);
  }



  template <int dim>
  CellNodes<dim>
  read_any_mesh(const std::string                         &file_name,
                const double                               mesh_size,
                Triangulation<dim>                        &triangulation,
                std::map<std::string, types::boundary_id> &boundary_names,
                std::map<std::string, types::material_id> &material_names,
                const unsigned int                         seconds,
                const std::string                         &kept_file)
  {
    const auto read_msh = [&](const std::string &msh_file) {
      CellNodes<dim> nodes = read_gmsh_mesh(msh_file, triangulation);
      boundary_names.clear();
      material_names.clear();
      for (const auto &[name, number] : physical_groups(msh_file, dim - 1))
        boundary_names[name] = number;
      for (const auto &[name, number] : physical_groups(msh_file, dim))
        material_names[name] = number;
      return nodes;
    };
    if (ending_of(file_name) == ".msh")
      return read_msh(file_name);
    if (!is_geometry(file_name) && !is_mesh_of_others(file_name))
      throw InputError(
        "The mesh file '" + file_name +
        "' should end with .msh, .vtk, .unv, .stl, .geo, .step or .stp. Of .inp and .med and many "
        "others the free program meshio makes one: meshio convert '" +
        file_name + "' mesh.msh --output-format gmsh22");
    if (!std::filesystem::exists(file_name))
      throw InputError("The mesh file '" + file_name + "' does not exist.");
    // Also that it is a file, and not a pipe whose end never comes.
    check_mesh_file(file_name);
    refuse_options_beside(file_name);
    const std::string script =
      ending_of(file_name) == ".geo" ? read_file(file_name) : "";
    if (!script.empty() && script.back() != '\n')
      throw InputError(
        "The geometry '" + file_name +
        "' does not end with a new line, without which Gmsh "
        "leaves out statements of the last line. Add one at its end.");
    std::string   &mesh         = converted(file_name, mesh_size);
    const MPI_Comm communicator = OneRank::communicator();
    on_first_rank(communicator, [&]() {
      if (mesh.empty())
        mesh = std::filesystem::exists(kept_file)
          ? read_file(kept_file)
          : convert_in_memory(file_name, dim, mesh_size, seconds);
    });
    mesh = Utilities::MPI::broadcast(communicator, mesh);
    const MemoryFile file;
    std::ofstream(file.name()) << mesh;
    try
      {
        return read_msh(file.name());
      }
    catch (const InputError &error)
      {
        mesh.clear();
        std::string       message = error.what();
        const std::string name    = "The mesh file '" + file.name() + "'";
        const std::size_t place   = message.find(name);
        if (place != std::string::npos)
          message.replace(place, name.size(), "The mesh that Gmsh makes of it");
        throw InputError("The mesh file '" + file_name +
                         "' cannot be taken: " + message);
      }
  }


  template CellNodes<2>
  read_gmsh_mesh(const std::string &, Triangulation<2> &);
  template CellNodes<3>
  read_gmsh_mesh(const std::string &, Triangulation<3> &);
  template CellNodes<2>
  read_any_mesh(const std::string &,
                const double,
                Triangulation<2> &,
                std::map<std::string, types::boundary_id> &,
                std::map<std::string, types::material_id> &,
                const unsigned int,
                const std::string &);
  template CellNodes<3>
  read_any_mesh(const std::string &,
                const double,
                Triangulation<3> &,
                std::map<std::string, types::boundary_id> &,
                std::map<std::string, types::material_id> &,
                const unsigned int,
                const std::string &);
} // namespace Ricochet
