// SPDX-License-Identifier: LGPL-2.1-or-later

// Mesh files of Gmsh: whole ones pass and deal.II reads them; for damaged ones
// the file, the line and the reason are reported.

#include <base/exceptions.h>
#include <problems/gmsh_file_check.h>
#include <problems/gmsh_mesh.h>

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/tria.h>

#include <boost/test/unit_test.hpp>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using namespace Ricochet;

BOOST_AUTO_TEST_SUITE(gmsh_file_check)

namespace
{
  /// Two tetrahedra with a common face.
  const std::string format_2 = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
2 1 "contact"
3 10 "the body"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
9 1 1 1e0
$EndNodes
$Elements
5
1 15 2 0 1 1
2 1 2 0 1 1 2
3 2 2 1 2 1 3 2
4 4 2 10 1 1 2 3 4
5 4 2 10 1 9 3 2 4
$EndElements
)";

  /// The same with elements of second order.
  const std::string second_order = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
14
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
9 1 1 1e0
11 .5 0 0
12 .5 .5 0
13 0 .5 0
14 0 0 .5
15 0 .5 .5
16 .5 0 .5
17 .5 1 .5
18 1 .5 .5
19 .5 .5 1
$EndNodes
$Elements
4
2 8 2 0 1 1 2 11
3 9 2 1 2 1 3 2 13 12 11
4 11 2 10 1 1 2 3 4 11 12 13 14 15 16
5 11 2 10 1 9 3 2 4 17 12 18 19 16 15
$EndElements
)";

  /// The same as the first in format 4.1.
  const std::string format_4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
2 1 "contact"
3 10 "the body"
$EndPhysicalNames
$Entities
1 1 1 1
1 0 0 0 0
1 0 0 0 1 0 0 0 1 1
2 0 0 0 1 1 0 1 1 1 1
1 0 0 0 1 1 1 1 10 1 -2
$EndEntities
$Nodes
2 5 1 9
2 2 0 3
1
2
3
0 0 0
1 0 0
0 1 0
3 1 0 2
4
9
0 0 1
1 1 1
$EndNodes
$Elements
4 5 1 5
0 1 15 1
1 1
1 1 1 1
2 1 2
2 2 2 1
3 1 3 2
3 1 4 2
4 1 2 3 4
5 9 3 2 4
$EndElements
)";

  /// Two hexahedra.
  const std::string hexahedra = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
12
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 0 0 1
6 1 0 1
7 1 1 1
8 0 1 1
9 0 0 2
10 1 0 2
11 1 1 2
12 0 1 2
$EndNodes
$Elements
2
1 5 2 1 1 1 2 3 4 5 6 7 8
2 5 2 1 1 5 6 7 8 9 10 11 12
$EndElements
)";

  /// Two triangles, and a line of their boundary.
  const std::string triangles = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
4
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
$EndNodes
$Elements
3
1 1 2 1 1 1 2
2 2 2 1 1 1 2 3
3 2 2 1 1 1 3 4
$EndElements
)";

  /// A file in a folder of its own, which goes away with it.
  class TemporaryFile
  {
  public:
    explicit TemporaryFile(const std::string &text)
      : folder(std::filesystem::temp_directory_path() /
               ("ricochet_gmsh_file_check_" + std::to_string(getpid())))
    {
      std::filesystem::create_directories(folder);
      std::ofstream(name(), std::ios::binary) << text;
    }

    ~TemporaryFile()
    {
      std::error_code ignored;
      std::filesystem::remove_all(folder, ignored);
    }

    std::string
    name() const
    {
      return (folder / "mesh.msh").string();
    }

  private:
    const std::filesystem::path folder;
  };



  /// @return the message for a file with this text, without the file's name.
  std::string
  verdict(const std::string &text, const unsigned int dim = 3)
  {
    const TemporaryFile file(text);
    try
      {
        check_gmsh_file(file.name(), dim);
      }
    catch (const InputError &error)
      {
        const std::string begin = "The mesh file '" + file.name() + "'";
        const std::string said  = error.what();
        BOOST_TEST(said.substr(0, begin.size()) == begin);
        return said.substr(begin.size());
      }
    return "passes";
  }



  template <int dim>
  unsigned int
  n_cells_read(const std::string &text)
  {
    const TemporaryFile        file(text);
    std::ifstream              stream(file.name());
    dealii::Triangulation<dim> triangulation;
    dealii::GridIn<dim>(triangulation).read_msh(stream);
    return triangulation.n_active_cells();
  }



  std::string
  replace(std::string text, const std::string &from, const std::string &to)
  {
    const std::size_t place = text.find(from);
    BOOST_TEST_REQUIRE((place != std::string::npos), "no '" << from << "'");
    return text.replace(place, from.size(), to);
  }



  struct Damage
  {
    std::string from, to, expected;
  };



  void
  check_damages(const std::string         &text,
                const std::vector<Damage> &damages,
                const unsigned int         dim = 3)
  {
    for (const Damage &damage : damages)
      BOOST_TEST(verdict(replace(text, damage.from, damage.to), dim) ==
                 ", line " + damage.expected);
  }
} // namespace


BOOST_AUTO_TEST_CASE(whole_files)
{
  for (const std::string &text : {format_2, format_4, hexahedra})
    {
      BOOST_TEST(verdict(text) == "passes");
      BOOST_TEST(n_cells_read<3>(text) == 2);
    }
  BOOST_TEST(verdict(triangles, 2) == "passes");
  BOOST_TEST(n_cells_read<2>(triangles) == 2);
}

// By Gmsh itself. Cells have the nodes of their edges where they should be, also those
// that are turned around; a quadrilateral and a hexahedron have all of theirs.
BOOST_AUTO_TEST_CASE(whole_files_of_second_order)
{
  const std::string quadrilateral = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
9
1 0 0 0
2 2 0 0
3 2 2 0
4 0 2 0
5 1 -.1 0
6 2.2 1 0
7 1 2.3 0
8 -.4 1 0
9 1.05 1.07 0
$EndNodes
$Elements
2
1 8 2 7 1 1 2 5
2 10 2 3 1 1 2 3 4 5 6 7 8 9
$EndElements
)";
  BOOST_TEST(verdict(second_order) == "passes");
  BOOST_TEST(verdict(quadrilateral, 2) == "passes");
  for (const std::string &text : {second_order,
                                  replace(second_order,
                                          "1 2 3 4 11 12 13 14 15 16",
                                          "1 3 2 4 13 12 11 14 16 15")})
    {
      const TemporaryFile      file(text);
      dealii::Triangulation<3> mesh;
      const CellNodes<3>       nodes = read_gmsh_mesh(file.name(), mesh);
      BOOST_TEST_REQUIRE(nodes.size() == 2U);
      unsigned int n_marked = 0;
      for (const auto &cell : mesh.active_cell_iterators())
        {
          const auto &own = nodes[cell->active_cell_index()];
          BOOST_TEST_REQUIRE(own.size() == 10U);
          BOOST_TEST(cell->material_id() == 10U);
          for (const unsigned int l : cell->line_indices())
            BOOST_TEST(own[4 + l].distance(cell->line(l)->center()) < 1e-14);
          for (const auto &face : cell->face_iterators())
            n_marked += face->boundary_id() == 1;
        }
      BOOST_TEST(n_marked == 1U);
    }
  const TemporaryFile      file(quadrilateral);
  dealii::Triangulation<2> mesh;
  const CellNodes<2>       nodes = read_gmsh_mesh(file.name(), mesh);
  BOOST_TEST_REQUIRE(nodes.size() == 1U);
  const auto cell = mesh.begin_active();
  BOOST_TEST_REQUIRE(nodes[0].size() == 9U);
  for (const unsigned int l : cell->line_indices())
    {
      const dealii::Tensor<1, 2> from_edge =
        nodes[0][4 + l] - cell->line(l)->center();
      const dealii::Point<2> edge = cell->line(l)->center();
      const double           off  = edge[1] == 0. ? .1
                   : edge[0] == 2.                ? .2
                   : edge[1] == 2.                ? .3
                                                  : .4;
      BOOST_CHECK_CLOSE(from_edge.norm(), off, 1e-10);
      BOOST_TEST((cell->line(l)->boundary_id() == 7) == (off == .1));
    }
  BOOST_TEST(nodes[0][8].distance(dealii::Point<2>(1.05, 1.07)) < 1e-14);
}

BOOST_AUTO_TEST_CASE(damaged_nodes_of_second_order)
{
  check_damages(
    second_order,
    {{"17 12 18 19 16 15",
      "17 12 18 19 15 16",
      "26: the element 5, a tetrahedron of second order, has the node 15 between "
      "its vertices, but the element 4 (line 25) has another one there."},
     {"17 12 18 19 16 15",
      "17 14 18 19 16 15",
      "26: the element 5, a tetrahedron of second order, has the node 14 between "
      "its vertices, but the element 4 (line 25) has another one there."},
     {"17 12 18 19 16 15",
      "14 12 18 19 16 15",
      "26: the element 5, a tetrahedron of second order, has the node 14 between "
      "its vertices, which the element 4 (line 25) has somewhere else."},
     {"11 12 13 14 15 16",
      "11 12 13 9 15 16",
      "25: the element 4, a tetrahedron of second order, has the node 9 between its "
      "vertices, which is the vertex of another."},
     {"11 12 13 14 15 16",
      "11 12 13 14 15",
      "25: the element 4, a tetrahedron of second order, has only 9 of 10 nodes."},
     {"11 12 13 14 15 16",
      "11 12 13 14 15 4",
      "25: the element 4, a tetrahedron of second order, has the node 4 twice."},
     {"5 11 2 10 1 9 3 2 4 17 12 18 19 16 15",
      "5 4 2 10 1 9 3 2 4",
      "26: the element 5, a tetrahedron, is in one mesh with a tetrahedron of second "
      "order (line 25); the cells must all be of one shape."}});
}

BOOST_AUTO_TEST_CASE(harmless_variants)
{
  const std::vector<Damage> variants{
    {"2.2", "2", ""},
    {"2.2", "2.0", ""},
    {"2.2", "2.1", ""},
    {"5\n1 0", " 5 \r\n\n1\t0", ""},
    {"5\n1 0", "6\n77 8 8 8\n1 0", ""},
    {"$EndElements\n", "$EndElements", ""},
    {"$EndElements\n", "$EndElements\n$Periodic\n0\n$EndPeriodic\n", ""},
    // A cell of negative orientation.
    {"1 2 3 4\n", "1 3 2 4\n", ""}};
  for (const Damage &variant : variants)
    {
      const std::string text = replace(format_2, variant.from, variant.to);
      BOOST_TEST(verdict(text) == "passes");
      BOOST_TEST(n_cells_read<3>(text) == 2);
    }
}

BOOST_AUTO_TEST_CASE(what_is_no_file)
{
  const auto folder = std::filesystem::temp_directory_path().string();
  const auto said   = [](const std::string &name) {
    try
      {
        check_gmsh_file(name, 3);
      }
    catch (const InputError &error)
      {
        return std::string(error.what());
      }
    return std::string();
  };
  BOOST_TEST(said(folder) == "The mesh file '" + folder + "' is a directory.");
  BOOST_TEST(said("/dev/zero") == "The mesh file '/dev/zero' cannot be read.");
  BOOST_TEST(said("no such file") ==
             "The mesh file 'no such file' cannot be read.");
  BOOST_TEST(verdict("") == " is empty.");
  BOOST_TEST(verdict(" \n\n") == " is empty.");
}

BOOST_AUTO_TEST_CASE(damaged_format)
{
  check_damages(
    format_2,
    {{"2.2",
      "4.1",
      "10: the section begins with one number, as in format 2.2, but the "
      "version of the format is 4.1."},
     {"2.2",
      "5.0",
      "2: the version of the format is '5.0'; only 2.2 and 4.1 can be read."},
     {"2.2",
      "9.9",
      "2: the version of the format is '9.9'; only 2.2 and 4.1 can be read."},
     {"2.2",
      "2,2",
      "2: the version of the format must be a finite number, not '2,2'."},
     {"2.2 0", "2.2 1", "2: the file is binary; only ASCII files can be read."},
     {"0 8", "0 4", "2: the size of data is 4; only 8 can be read."},
     {"$MeshFormat",
      "solid \x01",
      "1: 'solid ?' stands where the section $MeshFormat should begin."}});
}

BOOST_AUTO_TEST_CASE(damaged_sections)
{
  check_damages(
    format_2,
    {{"$Nodes\n",
      "$Comments\n$EndComments\n$Nodes\n",
      "9: '$Comments' stands where the section $Nodes should begin."},
     {"$EndNodes\n",
      "",
      "16: '$Elements' stands where $EndNodes should follow after 5 nodes."},
     {"$EndNodes\n",
      "$EndNodes\n$Nodes\n0\n$EndNodes\n",
      "17: '$Nodes' stands where the section $Elements should begin."},
     {"$EndElements\n",
      "",
      "23: the file ends where $EndElements should follow after 5 elements."},
     {"$EndElements\n",
      "$EndElements\n$Nodes\n",
      "25: the section $Nodes must not stand after the section $Elements."},
     {"$EndElements\n",
      "$EndElements\n$NodeData\n1\n",
      "25: the section '$NodeData' has no end."},
     {"3 10 \"the body\"\n",
      "",
      "7: '$EndPhysicalNames' stands where physical name 2 of 2 should "
      "follow."}});
}

BOOST_AUTO_TEST_CASE(damaged_nodes)
{
  check_damages(
    format_2,
    {{"5\n1 0",
      "4\n1 0",
      "15: '9 1 1 1e0' stands where $EndNodes should follow after 4 nodes."},
     {"5\n1 0",
      "6\n1 0",
      "16: '$EndNodes' stands where node 6 of 6 should follow."},
     {"5\n1 0",
      "2000000000\n1 0",
      "10: the number of nodes is 2000000000, more than the rest of the file "
      "can hold."},
     {"5\n1 0",
      "-5\n1 0",
      "10: the number of nodes must be a whole number from 0 to 2147483647, "
      "not '-5'."},
     {"2 1 0 0\n",
      "1 1 0 0\n",
      "12: the node 1 is repeated; it is in line 11 already."},
     {"2 1 0 0\n",
      "0 1 0 0\n",
      "12: the number of a node must be a whole number from 1 to 2147483647, "
      "not '0'."},
     {"2 1 0 0\n",
      "2 nan 0 0\n",
      "12: a coordinate of a node must be a finite number, not 'nan'."},
     {"2 1 0 0\n",
      "2 1,5 0 0\n",
      "12: a coordinate of a node must be a finite number, not '1,5'."},
     {"2 1 0 0\n",
      "2 1 0\n",
      "12: the line ends where a coordinate of a node should follow."}});
}

BOOST_AUTO_TEST_CASE(damaged_elements)
{
  check_damages(
    format_2,
    {{"1 15 2",
      "1 16 2",
      "19: the type 16 of an element cannot be read; only points (15), lines "
      "(1), triangles (2), quadrilaterals (3), tetrahedra (4), hexahedra "
      "(5) and those of second order (8 to 12) can."},
     {"1 2 3 4\n",
      "1 2 3\n",
      "22: the element 4, a tetrahedron, has only 3 of 4 nodes."},
     {"1 2 3 4\n",
      "1 2 3 4 9\n",
      "22: the line should end after the last node of an element, but '9' "
      "follows."},
     {"1 2 3 4\n",
      "1 2 3 5\n",
      "22: the element 4, a tetrahedron, has the node 5, which does not "
      "exist."},
     {"1 2 3 4\n",
      "1 2 3 2\n",
      "22: the element 4, a tetrahedron, has the node 2 twice."},
     {"3 2 2 1 2",
      "3 2 2 -1 2",
      "21: the physical group of an element must be a whole number from 0 to "
      "2147483647, not '-1'."}});
  BOOST_TEST(verdict(format_2, 2) ==
             ", line 22: a tetrahedron cannot be in a mesh of dimension 2.");
  BOOST_TEST(verdict(triangles) ==
             ", line 11: the section $Elements has no "
             "element of dimension 3.");
}

BOOST_AUTO_TEST_CASE(what_elements_form)
{
  check_damages(
    format_2,
    {{"4 0 0 1\n",
      "4 1 1 1e-13\n",
      "22: the element 4, a tetrahedron, has no volume."},
     {"4 0 0 1\n",
      "4 0 0 1e300\n",
      "22: the element 4, a tetrahedron, has no volume."},
     {"9 3 2 4\n",
      "1 3 2 4\n",
      "23: the element 5, a tetrahedron, has the same nodes as the element 4 "
      "(line 22)."},
     {"1 3 2\n",
      "2 3 4\n",
      "21: the element 3, a triangle, lies between two cells; only those on "
      "the boundary can be read."},
     {"1 3 2\n",
      "1 3 9\n",
      "21: the element 3, a triangle, is not a face of any tetrahedron."},
     {"2 1 2 0 1 1 2\n",
      "2 2 2 5 1 1 2 3\n",
      "21: the element 3, a triangle, is in the physical group 1, but as the "
      "element 2 (line 20) in 5."}});
  check_damages(
    hexahedra,
    {{"2\n1 5",
      "3\n3 4 0 1 2 3 5\n1 5",
      "22: the element 1, a hexahedron, is in one mesh with a tetrahedron "
      "(line 21); the cells must all be of one shape."},
     {"1 1 5 6 7 8",
      "1 1 5 8 6 7",
      "22: the element 2, a hexahedron, shares a face with the element 1 "
      "(line 21), which has its nodes in another order."}});
  check_damages(
    triangles,
    {{"4 0 1 0\n",
      "4 .5 .5 0\n",
      "15: the element 3, a triangle, has no area."},
     {"1 1 1 2\n",
      "1 1 1 3\n",
      "13: the element 1, a line, lies between two cells; only those on the "
      "boundary can be read."}},
    2);
}

BOOST_AUTO_TEST_CASE(face_of_three_cells)
{
  const std::string one_more_node =
    replace(format_2, "5\n1 0 0 0\n", "6\n7 2 2 2\n1 0 0 0\n");
  check_damages(one_more_node,
                {{"1 15 2 0 1 1\n",
                  "1 4 2 10 1 7 2 3 4\n",
                  "24: the element 5, a tetrahedron, shares a face with the "
                  "element 4 (line 23) and the element 1 (line 20); a face can "
                  "be shared by two only."}});
}

BOOST_AUTO_TEST_CASE(line_within_the_body)
{
  // Four tetrahedra around the line from node 1 to node 2.
  const std::string around = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
6
1 0 0 -1
2 0 0 1
3 1 0 0
4 0 1 0
5 -1 0 0
6 0 -1 0
$EndNodes
$Elements
5
1 1 2 0 1 1 3
2 4 2 1 1 1 2 3 4
3 4 2 1 1 1 2 4 5
4 4 2 1 1 1 2 5 6
5 4 2 1 1 1 2 6 3
$EndElements
)";
  BOOST_TEST(verdict(around) == "passes");
  BOOST_TEST(n_cells_read<3>(around) == 4);
  check_damages(around,
                {{"0 1 1 3\n",
                  "0 1 1 2\n",
                  "15: the element 1, a line, lies within the body; only those "
                  "on the boundary can be read."}});
}

BOOST_AUTO_TEST_CASE(damaged_blocks)
{
  check_damages(
    format_4,
    {{"4.1",
      "2.2",
      "9: '$Entities' stands where the section $Nodes should begin."},
     {"2 5 1 9",
      "3 5 1 9",
      "30: '$EndNodes' stands where block of nodes 3 of 3 should follow."},
     {"2 5 1 9",
      "2 6 1 9",
      "29: the blocks have 1 nodes fewer than the total of the section says."},
     {"2 2 0 3\n",
      "2 2 0 8\n",
      "18: the number of nodes of a block is 8, but the total of the section "
      "leaves only 5."},
     {"2 2 0 3\n",
      "2 2 1 3\n",
      "18: nodes with parametric coordinates cannot be read."},
     {"2 2 0 3\n",
      "4 2 0 3\n",
      "18: the dimension of an entity must be a whole number from 0 to 3, not "
      "'4'."},
     {"3 1 4 2\n",
      "3 7 4 2\n",
      "39: the entity 7 of dimension 3 is not in the section $Entities."},
     {"3 1 4 2\n",
      "3 1 2 2\n",
      "39: a triangle cannot be in an entity of dimension 3."},
     {"1 1 1 1\n1 0",
      "1 2 1 1\n1 0",
      "15: '$EndEntities' stands where volume 1 of 1 should follow."},
     {"1 1 10 1 -2\n",
      "1 2 10 11 1 -2\n",
      "14: the entity 1 of dimension 3 is in 2 physical groups; only one can "
      "be read."}});
}

BOOST_AUTO_TEST_CASE(truncation_anywhere)
{
  // Only the last line break may be missing.
  for (const std::string &text : {format_2, format_4})
    for (std::size_t size = 0; size + 1 < text.size(); ++size)
      BOOST_TEST(verdict(text.substr(0, size)) != "passes");
}

BOOST_AUTO_TEST_SUITE_END()
