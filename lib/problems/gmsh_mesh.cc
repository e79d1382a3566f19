// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <problems/gmsh_mesh.h>

#include <gmsh.h>

#include <map>

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
        gmsh::initialize();
        // Gmsh keeps quiet, and its random numbers begin the same each time.
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::option::setNumber("General.NumThreads", 1);
      }

      ~GmshSession()
      {
        gmsh::finalize();
      }
    };
  } // namespace



  void
  mesh_by_gmsh(const std::function<void()> &describe,
               Triangulation<3>            &triangulation)
  {
    std::vector<Point<3>>               points;
    std::vector<CellData<3>>            cells;
    std::map<std::size_t, unsigned int> number;
    try
      {
        const GmshSession session;
        gmsh::model::add("body");
        describe();
        gmsh::model::occ::synchronize();
        gmsh::model::mesh::generate(3);

        std::vector<std::size_t> tags;
        std::vector<double>      coordinates, parametric;
        gmsh::model::mesh::getNodes(tags, coordinates, parametric);
        std::map<std::size_t, std::size_t> place;
        for (std::size_t k = 0; k < tags.size(); ++k)
          place[tags[k]] = k;

        constexpr int            tetrahedron = 4;
        std::vector<std::size_t> elements, nodes;
        gmsh::model::mesh::getElementsByType(tetrahedron, elements, nodes);
        for (std::size_t e = 0; e < elements.size(); ++e)
          {
            CellData<3> cell(4);
            for (unsigned int v = 0; v < 4; ++v)
              {
                // Nodes that no tetrahedron has stay out.
                const auto [entry, is_new] =
                  number.emplace(nodes[4 * e + v], points.size());
                if (is_new)
                  {
                    const std::size_t k = 3 * place.at(entry->first);
                    points.emplace_back(coordinates[k],
                                        coordinates[k + 1],
                                        coordinates[k + 2]);
                  }
                cell.vertices[v] = entry->second;
              }
            cells.push_back(cell);
          }
      }
    catch (const std::exception &exception)
      {
        throw InputError(std::string("Gmsh cannot make the mesh: ") +
                         exception.what());
      }
    catch (const std::string &message)
      {
        throw InputError("Gmsh cannot make the mesh: " + message);
      }
    triangulation.create_triangulation(points, cells, SubCellData());
  }
} // namespace Ricochet
