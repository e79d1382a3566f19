// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <problems/gmsh_element_types.h>
#include <problems/gmsh_file_check.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace Ricochet
{
  namespace
  {
    /// Type in which deal.II's reader stores numbers of nodes, elements and
    /// groups.
    constexpr int largest = std::numeric_limits<int>::max();

    /// A cell whose volume is less than this times the cube of its size (in 2D,
    /// the square) is flat.
    constexpr double smallest_volume = 1e-12;

    /// No node: fills the entries of an element with fewer nodes.
    constexpr unsigned int no_node = std::numeric_limits<unsigned int>::max();



    /// The words of a file, line by line. Lines without words are passed over.
    class MeshFile
    {
    public:
      explicit MeshFile(const std::string &name);

      /// Go to the next line. @return whether there is one.
      bool
      next_line();

      /// Go to the next line, which should be @p what, number @p k of @p n.
      void
      next_entry(const char *what, const int k = 0, const int n = 0);

      /// The next word of this line, empty at its end.
      std::string_view
      word();

      /// The rest of this line without white space around it.
      std::string_view
      rest_of_line() const;

      int
      integer(const char *what, const int lowest, const int highest = largest);

      double
      number(const char *what);

      /// Number of entries that follow, each in @p n_bytes at least. A count
      /// that the rest of the file cannot hold is refused before memory is set
      /// aside.
      int
      count(const char *what, const std::size_t n_bytes);

      /// Check that this line has no more words.
      void
      end_line(const char *what);

      /// Go to the next section, which is one of @p names.
      std::string_view
      begin_section(const std::vector<std::string_view> &names);

      void
      end_section(const std::string &name, const std::string &content);

      std::size_t
      line() const
      {
        return line_number;
      }

      [[noreturn]] void
      fail(const std::string &sentence) const
      {
        fail(line_number, sentence);
      }

      [[noreturn]] void
      fail(const std::size_t line, const std::string &sentence) const
      {
        throw InputError("The mesh file '" + name + "', line " +
                         std::to_string(line) + ": " + sentence);
      }

    private:
      void
      read();

      const std::string name;
      std::string       content;
      std::string_view  this_line, following;
      std::size_t       line_number = 0;
    };



    constexpr std::string_view white_space = " \t\v\f\r";



    std::string_view
    trim(std::string_view text)
    {
      const std::size_t first = text.find_first_not_of(white_space);
      if (first == std::string_view::npos)
        return {};
      return text.substr(first, text.find_last_not_of(white_space) + 1 - first);
    }



    /// Words of a damaged file may be anything; show them in a readable way.
    std::string
    in_quotes(const std::string_view text)
    {
      constexpr std::size_t longest = 40;
      std::string           result  = "'";
      for (const char c : text.substr(0, longest))
        result += (c >= ' ' && c <= '~') ? c : '?';
      return result + (text.size() > longest ? "...'" : "'");
    }



    MeshFile::MeshFile(const std::string &name)
      : name(name)
    {
      read();
      following = content;
    }



    void
    MeshFile::read()
    {
      check_mesh_file(name);
      std::error_code      error;
      const std::uintmax_t size = std::filesystem::file_size(name, error);
      std::ifstream        file(name, std::ios::binary);
      if (error || !file)
        throw InputError("The mesh file '" + name + "' cannot be read.");
      content.resize(size);
      file.read(content.data(), static_cast<std::streamsize>(size));
      if (!file)
        throw InputError("The mesh file '" + name + "' cannot be read.");
      if (content.find_first_not_of(std::string(white_space) + '\n') ==
          std::string::npos)
        throw InputError("The mesh file '" + name + "' is empty.");
    }



    bool
    MeshFile::next_line()
    {
      while (!following.empty())
        {
          const std::size_t length = following.find('\n');
          this_line                = trim(following.substr(0, length));
          following.remove_prefix(
            length == std::string_view::npos ? following.size() : length + 1);
          ++line_number;
          if (!this_line.empty())
            return true;
        }
      return false;
    }



    void
    MeshFile::next_entry(const char *what, const int k, const int n)
    {
      const auto expected = [&]() {
        return std::string(what) +
          (n == 0 ? "" : " " + std::to_string(k) + " of " + std::to_string(n));
      };
      if (!next_line())
        fail("the file ends where " + expected() + " should follow.");
      if (this_line.front() == '$')
        fail(in_quotes(this_line) + " stands where " + expected() +
             " should follow.");
    }



    std::string_view
    MeshFile::word()
    {
      const std::size_t length = this_line.find_first_of(white_space);
      const auto        result = this_line.substr(0, length);
      this_line                = trim(this_line.substr(result.size()));
      return result;
    }



    std::string_view
    MeshFile::rest_of_line() const
    {
      return this_line;
    }



    int
    MeshFile::integer(const char *what, const int lowest, const int highest)
    {
      const std::string_view text  = word();
      const char *const      end   = text.data() + text.size();
      int                    value = 0;
      if (text.empty())
        fail("the line ends where " + std::string(what) + " should follow.");
      const auto [stop, error] = std::from_chars(text.data(), end, value);
      if (error != std::errc() || stop != end || value < lowest ||
          value > highest)
        fail(std::string(what) + " must be a whole number from " +
             std::to_string(lowest) + " to " + std::to_string(highest) +
             ", not " + in_quotes(text) + ".");
      return value;
    }



    double
    MeshFile::number(const char *what)
    {
      const std::string_view text  = word();
      const char *const      end   = text.data() + text.size();
      double                 value = 0.;
      if (text.empty())
        fail("the line ends where " + std::string(what) + " should follow.");
      const auto [stop, error] = std::from_chars(text.data(), end, value);
      if (error != std::errc() || stop != end || !std::isfinite(value))
        fail(std::string(what) + " must be a finite number, not " +
             in_quotes(text) + ".");
      return value;
    }



    int
    MeshFile::count(const char *what, const std::size_t n_bytes)
    {
      const int value = integer(what, 0);
      if (static_cast<std::size_t>(value) > following.size() / n_bytes)
        fail(std::string(what) + " is " + std::to_string(value) +
             ", more than the rest of the file can hold.");
      return value;
    }



    void
    MeshFile::end_line(const char *what)
    {
      if (!this_line.empty())
        fail("the line should end after " + std::string(what) + ", but " +
             in_quotes(this_line) + " follows.");
    }



    std::string_view
    MeshFile::begin_section(const std::vector<std::string_view> &names)
    {
      std::string expected;
      for (const std::string_view name : names)
        expected += (expected.empty() ? "$" : " or $") + std::string(name);
      if (!next_line())
        fail("the file ends where the section " + expected + " should begin.");
      for (const std::string_view name : names)
        if (this_line.front() == '$' && this_line.substr(1) == name)
          return name;
      fail(in_quotes(this_line) + " stands where the section " + expected +
           " should begin.");
    }



    void
    MeshFile::end_section(const std::string &name, const std::string &content)
    {
      const std::string after = content.empty()
        ? " should follow."
        : " should follow after " + content + ".";
      if (!next_line())
        fail("the file ends where $End" + name + after);
      if (this_line != "$End" + name)
        fail(in_quotes(this_line) + " stands where $End" + name + after);
    }



    struct Node
    {
      int                   number;
      std::size_t           line;
      std::array<double, 3> x;
    };



    struct Element
    {
      const GmshElementType *type;
      int                    number;
      int                    physical_group;
      std::size_t            line;
      /// Places in Mesh::nodes: its vertices, and its nodes after them.
      std::array<unsigned int, 8>  nodes;
      std::array<unsigned int, 19> more_nodes;
    };



    struct Mesh
    {
      unsigned int dim;
      /// Sorted by their numbers.
      std::vector<Node>    nodes;
      std::vector<Element> cells, faces, lines;
    };



    /// "the element 5, a line,"
    std::string
    describe(const Element &element)
    {
      return "the element " + std::to_string(element.number) + ", a " +
        element.type->name + ",";
    }



    // Reading: the sections of the file.

    /// The entities of a geometry, which exist only in format 4.1: their tags
    /// with their physical groups, for each dimension, sorted by tags.
    using Entities = std::array<std::vector<std::pair<int, int>>, 4>;



    /// @return whether the format is 4.1, not 2.2.
    bool
    read_format(MeshFile &file)
    {
      file.begin_section({"MeshFormat"});
      file.next_entry("the version of the format");
      const std::string version(file.rest_of_line().substr(
        0,
        file.rest_of_line().find_first_of(white_space)));
      const double      value      = file.number("the version of the format");
      const bool        has_blocks = (value == 4.1);
      if (!has_blocks && value != 2. && value != 2.1 && value != 2.2)
        file.fail("the version of the format is " + in_quotes(version) +
                  "; only 2.2 and 4.1 can be read.");
      if (file.integer("the type of the file", 0) != 0)
        file.fail("the file is binary; only ASCII files can be read.");
      const int size = file.integer("the size of data", 0);
      if (size != sizeof(double))
        file.fail("the size of data is " + std::to_string(size) +
                  "; only 8 can be read.");
      file.end_line("the size of data");
      file.end_section("MeshFormat", "the version");
      return has_blocks;
    }



    void
    read_physical_names(MeshFile &file)
    {
      file.next_entry("the number of physical names");
      const int n = file.count("the number of physical names", 7);
      file.end_line("the number of physical names");
      for (int k = 0; k < n; ++k)
        {
          file.next_entry("physical name", k + 1, n);
          file.integer("the dimension of a physical name", 0, 3);
          file.integer("the number of a physical name", -largest);
          const std::string_view text = file.rest_of_line();
          if (text.size() < 2 || text.front() != '"' || text.back() != '"')
            file.fail("a physical name must be in quotation marks, but is " +
                      in_quotes(text) + ".");
          // deal.II's reader continues after these words wherever they stand.
          if (text.find("$EndPhysicalNames") != std::string_view::npos)
            file.fail("a physical name must not have $EndPhysicalNames in it.");
        }
      file.end_section("PhysicalNames", std::to_string(n) + " physical names");
    }



    /// @return the tag of an entity and its physical group (0 for none).
    std::pair<int, int>
    read_entity(MeshFile &file, const unsigned int dim)
    {
      const int tag = file.integer("the tag of an entity", -largest);
      // A point, or for other entities the corners of a bounding box.
      for (unsigned int d = 0; d < (dim == 0 ? 3 : 6); ++d)
        file.number("a coordinate of an entity");
      int       group    = 0;
      const int n_groups = file.integer("the number of physical groups", 0);
      if (n_groups > 1)
        file.fail("the entity " + std::to_string(tag) + " of dimension " +
                  std::to_string(dim) + " is in " + std::to_string(n_groups) +
                  " physical groups; only one can be read.");
      if (n_groups == 1)
        group = file.integer("the number of a physical group", 0);
      if (dim > 0)
        {
          const int n = file.integer("the number of bounding entities", 0);
          for (int k = 0; k < n; ++k)
            file.integer("the tag of a bounding entity", -largest);
        }
      file.end_line("the last tag of an entity");
      return {tag, group};
    }



    Entities
    read_entities(MeshFile &file)
    {
      file.next_entry("the numbers of entities");
      std::array<int, 4> n;
      std::size_t        total = 0;
      for (int &n_of_dim : n)
        {
          n_of_dim = file.count("the number of entities", 9);
          total += n_of_dim;
        }
      file.end_line("the numbers of entities");
      constexpr std::array<const char *, 4> name{
        {"point", "curve", "surface", "volume"}};
      Entities entities;
      for (unsigned int dim = 0; dim < 4; ++dim)
        {
          for (int k = 0; k < n[dim]; ++k)
            {
              file.next_entry(name[dim], k + 1, n[dim]);
              entities[dim].push_back(read_entity(file, dim));
            }
          std::sort(entities[dim].begin(), entities[dim].end());
          for (std::size_t k = 1; k < entities[dim].size(); ++k)
            if (entities[dim][k].first == entities[dim][k - 1].first)
              file.fail("the entity " + std::to_string(entities[dim][k].first) +
                        " of dimension " + std::to_string(dim) +
                        " is repeated.");
        }
      file.end_section("Entities", std::to_string(total) + " entities");
      return entities;
    }



    void
    read_coordinates(MeshFile &file, Node &node)
    {
      for (double &x : node.x)
        x = file.number("a coordinate of a node");
      file.end_line("the three coordinates of a node");
    }



    Node
    read_node_number(MeshFile &file)
    {
      const int number = file.integer("the number of a node", 1);
      return {number, file.line(), {}};
    }



    /// Numbers first, coordinates after them.
    void
    read_block_of_nodes(MeshFile &file, const int n, std::vector<Node> &nodes)
    {
      const std::size_t begin = nodes.size();
      for (int k = 0; k < n; ++k)
        {
          file.next_entry("number of node", k + 1, n);
          nodes.push_back(read_node_number(file));
          file.end_line("the number of a node");
        }
      for (int k = 0; k < n; ++k)
        {
          file.next_entry("coordinates of node", k + 1, n);
          read_coordinates(file, nodes[begin + k]);
        }
    }



    /// The first line of a section in format 4.1. @return the number of blocks
    /// and the total of their entries.
    std::pair<int, int>
    read_totals(MeshFile &file, const char *what, const std::size_t n_bytes)
    {
      if (file.rest_of_line().find_first_of(white_space) ==
          std::string_view::npos)
        file.fail(
          "the section begins with one number, as in format 2.2, but "
          "the version of the format is 4.1.");
      const int n_blocks = file.count("the number of blocks", 8);
      const int n        = file.count(what, n_bytes);
      file.integer("the smallest number", 0);
      file.integer("the largest number", 0);
      file.end_line("the largest number");
      return {n_blocks, n};
    }



    /// @return how many entries this block has, of @p n_left that no block had.
    int
    read_block_size(MeshFile &file, const char *what, const int n_left)
    {
      const int n = file.integer(what, 0);
      file.end_line(what);
      if (n > n_left)
        file.fail(std::string(what) + " is " + std::to_string(n) +
                  ", but the total of the section leaves only " +
                  std::to_string(n_left) + ".");
      return n;
    }



    void
    check_total(const MeshFile &file, const char *what, const int n_left)
    {
      if (n_left != 0)
        file.fail("the blocks have " + std::to_string(n_left) + " " + what +
                  " fewer than the total of the section says.");
    }



    void
    read_blocks_of_nodes(MeshFile &file, std::vector<Node> &nodes)
    {
      const char *const what = "the number of nodes of a block";
      const auto [n_blocks, n_nodes] =
        read_totals(file, "the number of nodes", 8);
      int n_left = n_nodes;
      for (int block = 0; block < n_blocks; ++block)
        {
          file.next_entry("block of nodes", block + 1, n_blocks);
          file.integer("the dimension of an entity", 0, 3);
          file.integer("the tag of an entity", -largest);
          if (file.integer("the parametric flag", 0) != 0)
            file.fail("nodes with parametric coordinates cannot be read.");
          const int n = read_block_size(file, what, n_left);
          read_block_of_nodes(file, n, nodes);
          n_left -= n;
        }
      check_total(file, "nodes", n_left);
    }



    void
    read_list_of_nodes(MeshFile &file, std::vector<Node> &nodes)
    {
      const int n = file.count("the number of nodes", 8);
      file.end_line("the number of nodes");
      for (int k = 0; k < n; ++k)
        {
          file.next_entry("node", k + 1, n);
          nodes.push_back(read_node_number(file));
          read_coordinates(file, nodes.back());
        }
    }



    void
    sort_nodes(const MeshFile &file, std::vector<Node> &nodes)
    {
      std::sort(nodes.begin(), nodes.end(), [](const Node &a, const Node &b) {
        return std::tie(a.number, a.line) < std::tie(b.number, b.line);
      });
      for (std::size_t k = 1; k < nodes.size(); ++k)
        if (nodes[k].number == nodes[k - 1].number)
          file.fail(nodes[k].line,
                    "the node " + std::to_string(nodes[k].number) +
                      " is repeated; it is in line " +
                      std::to_string(nodes[k - 1].line) + " already.");
    }



    void
    read_nodes(MeshFile &file, const bool has_blocks, std::vector<Node> &nodes)
    {
      file.next_entry("the number of nodes");
      if (has_blocks)
        read_blocks_of_nodes(file, nodes);
      else
        read_list_of_nodes(file, nodes);
      file.end_section("Nodes", std::to_string(nodes.size()) + " nodes");
      sort_nodes(file, nodes);
    }



    const GmshElementType &
    read_type(MeshFile &file, const unsigned int dim)
    {
      const int              number = file.integer("the type of an element", 1);
      const GmshElementType *type   = find_gmsh_element_type(number);
      if (type == nullptr)
        file.fail(
          "the type " + std::to_string(number) +
          " of an element cannot be read; only points (15), lines (1), "
          "triangles (2), quadrilaterals (3), tetrahedra (4), hexahedra (5) and "
          "those of second order (8 to 12) can.");
      if (type->dim > dim)
        file.fail("a " + std::string(type->name) +
                  " cannot be in a mesh of dimension " + std::to_string(dim) +
                  ".");
      return *type;
    }



    /// Numbers are mostly without gaps, so that no search is needed.
    std::optional<unsigned int>
    find_node(const std::vector<Node> &nodes, const int number)
    {
      if (nodes.empty() || number < nodes.front().number)
        return {};
      const std::size_t guess =
        static_cast<std::size_t>(number) - nodes.front().number;
      if (guess < nodes.size() && nodes[guess].number == number)
        return guess;
      const auto place = std::lower_bound(nodes.begin(),
                                          nodes.end(),
                                          number,
                                          [](const Node &node, const int n) {
                                            return node.number < n;
                                          });
      if (place == nodes.end() || place->number != number)
        return {};
      return place - nodes.begin();
    }



    void
    read_nodes_of_element(MeshFile                &file,
                          const std::vector<Node> &nodes,
                          Element                 &element)
    {
      element.nodes.fill(no_node);
      element.more_nodes.fill(no_node);
      const unsigned int n_vertices = element.type->n_vertices;
      const auto         has = [](const auto &list, const unsigned int node) {
        return std::find(list.begin(), list.end(), node) != list.end();
      };
      for (unsigned int v = 0; v < element.type->n_nodes; ++v)
        {
          if (file.rest_of_line().empty())
            file.fail(describe(element) + " has only " + std::to_string(v) +
                      " of " + std::to_string(element.type->n_nodes) +
                      " nodes.");
          const int  number = file.integer("the node of an element", 1);
          const auto node   = find_node(nodes, number);
          if (!node)
            file.fail(describe(element) + " has the node " +
                      std::to_string(number) + ", which does not exist.");
          if (has(element.nodes, *node) || has(element.more_nodes, *node))
            file.fail(describe(element) + " has the node " +
                      std::to_string(number) + " twice.");
          if (v < n_vertices)
            element.nodes[v] = *node;
          else
            element.more_nodes[v - n_vertices] = *node;
        }
      file.end_line("the last node of an element");
    }



    /// Points have no meaning for us, and are dropped.
    void
    add(const Element &element, Mesh &mesh)
    {
      if (element.type->dim == mesh.dim)
        mesh.cells.push_back(element);
      else if (element.type->dim + 1 == mesh.dim)
        mesh.faces.push_back(element);
      else if (element.type->dim == 1)
        mesh.lines.push_back(element);
    }



    /// Tags are the physical group, then others that mean nothing here.
    int
    read_tags(MeshFile &file)
    {
      int       group = 0;
      const int n     = file.integer("the number of tags of an element", 0);
      for (int k = 0; k < n; ++k)
        if (k == 0)
          group = file.integer("the physical group of an element", 0);
        else
          file.integer("a tag of an element", -largest);
      return group;
    }



    void
    read_list_of_elements(MeshFile &file, Mesh &mesh)
    {
      const int n = file.count("the number of elements", 9);
      file.end_line("the number of elements");
      for (int k = 0; k < n; ++k)
        {
          file.next_entry("element", k + 1, n);
          Element element;
          element.line           = file.line();
          element.number         = file.integer("the number of an element", 1);
          element.type           = &read_type(file, mesh.dim);
          element.physical_group = read_tags(file);
          read_nodes_of_element(file, mesh.nodes, element);
          add(element, mesh);
        }
      file.end_section("Elements", std::to_string(n) + " elements");
    }



    /// @return the physical group of the entity that this block belongs to.
    int
    read_entity_of_block(MeshFile                      &file,
                         const std::optional<Entities> &entities,
                         const int                      dim)
    {
      const int tag = file.integer("the tag of an entity", -largest);
      if (!entities)
        return 0;
      const auto &candidates = (*entities)[dim];
      const auto  entity     = std::lower_bound(candidates.begin(),
                                           candidates.end(),
                                           std::pair(tag, 0));
      if (entity == candidates.end() || entity->first != tag)
        file.fail("the entity " + std::to_string(tag) + " of dimension " +
                  std::to_string(dim) + " is not in the section $Entities.");
      return entity->second;
    }



    void
    read_block_of_elements(MeshFile &file,
                           const int n,
                           Element   element,
                           Mesh     &mesh)
    {
      for (int k = 0; k < n; ++k)
        {
          file.next_entry("element of its block", k + 1, n);
          element.line   = file.line();
          element.number = file.integer("the number of an element", 1);
          read_nodes_of_element(file, mesh.nodes, element);
          add(element, mesh);
        }
    }



    void
    read_blocks_of_elements(MeshFile                      &file,
                            const std::optional<Entities> &entities,
                            Mesh                          &mesh)
    {
      const auto [n_blocks, n_elements] =
        read_totals(file, "the number of elements", 4);
      int n_left = n_elements;
      for (int block = 0; block < n_blocks; ++block)
        {
          file.next_entry("block of elements", block + 1, n_blocks);
          Element   element;
          const int dim = file.integer("the dimension of an entity", 0, 3);
          element.physical_group = read_entity_of_block(file, entities, dim);
          element.type           = &read_type(file, mesh.dim);
          if (static_cast<int>(element.type->dim) != dim)
            file.fail("a " + std::string(element.type->name) +
                      " cannot be in an entity of dimension " +
                      std::to_string(dim) + ".");
          const int n =
            read_block_size(file, "the number of elements of a block", n_left);
          read_block_of_elements(file, n, element, mesh);
          n_left -= n;
        }
      check_total(file, "elements", n_left);
      file.end_section("Elements", std::to_string(n_elements) + " elements");
    }



    /// Sections that follow are not read, but must be complete and no second
    /// mesh.
    void
    pass_over_rest(MeshFile &file)
    {
      while (file.next_line())
        {
          const std::string begin(file.rest_of_line());
          const std::size_t line = file.line();
          if (begin.front() != '$')
            file.fail(in_quotes(begin) +
                      " stands after the section $Elements, "
                      "where only sections may follow.");
          for (const char *const name :
               {"MeshFormat", "PhysicalNames", "Entities", "Nodes", "Elements"})
            if (begin.substr(1) == name)
              file.fail("the section " + begin +
                        " must not stand after the section $Elements.");
          const std::string end = "$End" + begin.substr(1);
          do
            if (!file.next_line())
              file.fail(line,
                        "the section " + in_quotes(begin) + " has no end.");
          while (file.rest_of_line() != end);
        }
    }



    Mesh
    read_mesh(MeshFile &file, const unsigned int dim)
    {
      const bool                    has_blocks = read_format(file);
      std::optional<Entities>       entities;
      Mesh                          mesh{dim, {}, {}, {}, {}};
      std::vector<std::string_view> next{"PhysicalNames", "Nodes"};
      if (has_blocks)
        next.insert(next.begin() + 1, "Entities");
      std::string_view section = file.begin_section(next);
      if (section == "PhysicalNames")
        {
          read_physical_names(file);
          next.erase(next.begin());
          section = file.begin_section(next);
        }
      if (section == "Entities")
        {
          entities = read_entities(file);
          file.begin_section({"Nodes"});
        }
      read_nodes(file, has_blocks, mesh.nodes);
      file.begin_section({"Elements"});
      const std::size_t line = file.line();
      file.next_entry("the number of elements");
      if (has_blocks)
        read_blocks_of_elements(file, entities, mesh);
      else
        read_list_of_elements(file, mesh);
      if (mesh.cells.empty())
        file.fail(line,
                  "the section $Elements has no element of dimension " +
                    std::to_string(dim) + ".");
      pass_over_rest(file);
      return mesh;
    }



    // Checking: the mesh of the elements.

    void
    check_shapes(const MeshFile &file, const Mesh &mesh)
    {
      const Element &first = mesh.cells.front();
      for (const Element &cell : mesh.cells)
        if (cell.type != first.type)
          file.fail(cell.line,
                    describe(cell) + " is in one mesh with a " +
                      first.type->name + " (line " +
                      std::to_string(first.line) +
                      "); the cells must all be of one shape.");
    }



    using Vector3 = std::array<double, 3>;



    double
    determinant(const Vector3 &a, const Vector3 &b, const Vector3 &c)
    {
      return a[0] * (b[1] * c[2] - b[2] * c[1]) +
        a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    }



    /// The signed volume by two Gauss points in each direction, which is exact.
    double
    volume_of_hexahedron(const std::array<Vector3, 8> &x)
    {
      constexpr std::array<std::array<int, 3>, 8> corner{{{{-1, -1, -1}},
                                                          {{1, -1, -1}},
                                                          {{1, 1, -1}},
                                                          {{-1, 1, -1}},
                                                          {{-1, -1, 1}},
                                                          {{1, -1, 1}},
                                                          {{1, 1, 1}},
                                                          {{-1, 1, 1}}}};
      const double                                gauss  = 1. / std::sqrt(3.);
      double                                      volume = 0.;
      for (const auto &point : corner)
        {
          std::array<Vector3, 3> jacobian{};
          for (unsigned int v = 0; v < 8; ++v)
            {
              Vector3 factor;
              for (unsigned int d = 0; d < 3; ++d)
                factor[d] = .5 * (1. + corner[v][d] * point[d] * gauss);
              for (unsigned int d = 0; d < 3; ++d)
                {
                  const double gradient = .5 * corner[v][d] *
                    factor[(d + 1) % 3] * factor[(d + 2) % 3];
                  for (unsigned int e = 0; e < 3; ++e)
                    jacobian[d][e] += gradient * x[v][e];
                }
            }
          volume += determinant(jacobian[0], jacobian[1], jacobian[2]);
        }
      return volume;
    }



    /// The signed volume of a cell (in 2D, its area) whose first node is 0.
    double
    volume(const GmshElementType &type, const std::array<Vector3, 8> &x)
    {
      if (type.n_vertices == 8)
        return volume_of_hexahedron(x);
      if (type.dim == 3)
        return determinant(x[1], x[2], x[3]) / 6.;
      double twice_the_area = 0.;
      for (unsigned int v = 2; v < type.n_vertices; ++v)
        twice_the_area += x[v - 1][0] * x[v][1] - x[v - 1][1] * x[v][0];
      return twice_the_area / 2.;
    }



    /// Coordinates are taken relative to the cell's size, as products of very
    /// small or large ones would leave a number's range before the volume does.
    bool
    is_flat(const Mesh &mesh, const Element &cell)
    {
      std::array<Vector3, 8> x{};
      double                 size = 0.;
      for (unsigned int v = 0; v < cell.type->n_vertices; ++v)
        for (unsigned int d = 0; d < mesh.dim; ++d)
          {
            x[v][d] =
              mesh.nodes[cell.nodes[v]].x[d] - mesh.nodes[cell.nodes[0]].x[d];
            size = std::max(size, std::abs(x[v][d]));
          }
      const double scale = std::pow(size, mesh.dim);
      if (!std::isnormal(scale))
        return true;
      for (Vector3 &point : x)
        for (double &coordinate : point)
          coordinate /= size;
      const double relative = std::abs(volume(*cell.type, x));
      return !(relative > smallest_volume && std::isnormal(relative * scale));
    }



    void
    check_volumes(const MeshFile &file, const Mesh &mesh)
    {
      for (const Element &cell : mesh.cells)
        if (is_flat(mesh, cell))
          file.fail(cell.line,
                    describe(cell) +
                      (mesh.dim == 3 ? " has no volume." : " has no area."));
    }



    /// Nodes of an element, sorted, and its place among the others.
    template <std::size_t n>
    struct Key
    {
      std::array<unsigned int, n> nodes;
      unsigned int                element;

      bool
      operator<(const Key &other) const
      {
        return std::tie(nodes, element) < std::tie(other.nodes, other.element);
      }
    };



    template <std::size_t n>
    Key<n>
    make_key(const Element &element, const unsigned int place)
    {
      Key<n> key;
      std::copy_n(element.nodes.begin(), n, key.nodes.begin());
      std::sort(key.nodes.begin(), key.nodes.end());
      key.element = place;
      return key;
    }



    std::string
    in_line(const Element &element)
    {
      return "the element " + std::to_string(element.number) + " (line " +
        std::to_string(element.line) + ")";
    }



    void
    check_repetitions(const MeshFile &file, const Mesh &mesh)
    {
      std::vector<Key<8>> keys;
      keys.reserve(mesh.cells.size());
      for (const Element &cell : mesh.cells)
        keys.push_back(make_key<8>(cell, keys.size()));
      std::sort(keys.begin(), keys.end());
      for (std::size_t k = 1; k < keys.size(); ++k)
        if (keys[k].nodes == keys[k - 1].nodes)
          {
            const Element &cell = mesh.cells[keys[k].element];
            file.fail(cell.line,
                      describe(cell) + " has the same nodes as " +
                        in_line(mesh.cells[keys[k - 1].element]) + ".");
          }
    }



    /// A face of a cell: its nodes, sorted, the cell's place, and which of the
    /// cell's faces it is.
    struct Face : Key<4>
    {
      unsigned int number;
    };



    Face
    make_face(const std::vector<Element> &cells,
              const unsigned int          place,
              const unsigned int          number)
    {
      const auto &vertices = cells[place].type->faces[number];
      Face        face;
      face.element = place;
      face.number  = number;
      face.nodes.fill(no_node);
      for (unsigned int v = 0; v < vertices.size(); ++v)
        face.nodes[v] = cells[place].nodes[vertices[v]];
      std::sort(face.nodes.begin(), face.nodes.end());
      return face;
    }



    /// Whether two faces with the same nodes have them in the same cyclic
    /// order. In a quadrilateral that is so when the same ones are opposite.
    bool
    match(const std::vector<Element> &cells, const Face &a, const Face &b)
    {
      const auto opposite_of_first = [&](const Face &face) {
        const Element &cell     = cells[face.element];
        const auto    &vertices = cell.type->faces[face.number];
        unsigned int   first    = 0;
        while (cell.nodes[vertices[first]] != face.nodes[0])
          ++first;
        return cell.nodes[vertices[(first + 2) % 4]];
      };
      return a.nodes[3] == no_node ||
        opposite_of_first(a) == opposite_of_first(b);
    }



    /// All faces of all cells, sorted.
    std::vector<Face>
    collect_faces(const std::vector<Element> &cells)
    {
      std::vector<Face> faces;
      faces.reserve(cells.size() * cells.front().type->faces.size());
      for (std::size_t k = 0; k < cells.size(); ++k)
        for (std::size_t f = 0; f < cells[k].type->faces.size(); ++f)
          faces.push_back(make_face(cells, k, f));
      std::sort(faces.begin(), faces.end());
      return faces;
    }



    /// Remove interior faces, those of two cells, from @p faces; boundary faces
    /// remain. @return the removed ones, each once.
    std::vector<Face>
    separate_inner_faces(const MeshFile    &file,
                         const Mesh        &mesh,
                         std::vector<Face> &faces)
    {
      std::vector<Face> inner;
      std::size_t       n_boundary = 0;
      for (std::size_t k = 0, end = 0; k < faces.size(); k = end)
        {
          while (end < faces.size() && faces[end].nodes == faces[k].nodes)
            ++end;
          if (end == k + 1)
            {
              faces[n_boundary++] = faces[k];
              continue;
            }
          const Element &last   = mesh.cells[faces[end - 1].element];
          const Element &before = mesh.cells[faces[end - 2].element];
          if (end > k + 2)
            file.fail(last.line,
                      describe(last) + " shares a face with " +
                        in_line(before) + " and " +
                        in_line(mesh.cells[faces[end - 3].element]) +
                        "; a face can be shared by two only.");
          if (!match(mesh.cells, faces[k], faces[k + 1]))
            file.fail(last.line,
                      describe(last) + " shares a face with " +
                        in_line(before) +
                        ", which has its nodes in another order.");
          inner.push_back(faces[k]);
        }
      faces.resize(n_boundary);
      return inner;
    }



    bool
    contains(const std::vector<Face> &faces, const Key<4> &key)
    {
      const auto place = std::lower_bound(faces.begin(),
                                          faces.end(),
                                          key,
                                          [](const Key<4> &a, const Key<4> &b) {
                                            return a.nodes < b.nodes;
                                          });
      return place != faces.end() && place->nodes == key.nodes;
    }



    /// deal.II refuses a boundary number of interior faces, and drops that of
    /// elements which are no face at all.
    void
    check_boundary_elements(const MeshFile          &file,
                            const Mesh              &mesh,
                            const std::vector<Face> &inner,
                            const std::vector<Face> &boundary)
    {
      std::vector<Key<4>> keys;
      keys.reserve(mesh.faces.size());
      for (const Element &element : mesh.faces)
        {
          keys.push_back(make_key<4>(element, keys.size()));
          if (contains(inner, keys.back()))
            file.fail(element.line,
                      describe(element) +
                        " lies between two cells; only those on the boundary "
                        "can be read.");
          if (!contains(boundary, keys.back()))
            file.fail(element.line,
                      describe(element) + " is not a face of any " +
                        mesh.cells.front().type->name + ".");
        }
      std::sort(keys.begin(), keys.end());
      for (std::size_t k = 1; k < keys.size(); ++k)
        {
          const Element &a = mesh.faces[keys[k - 1].element];
          const Element &b = mesh.faces[keys[k].element];
          if (keys[k].nodes == keys[k - 1].nodes &&
              a.physical_group != b.physical_group)
            file.fail(b.line,
                      describe(b) + " is in the physical group " +
                        std::to_string(b.physical_group) + ", but as " +
                        in_line(a) + " in " + std::to_string(a.physical_group) +
                        ".");
        }
    }



    /// The node of an element that is between some of its vertices.
    struct Between : Key<4>
    {
      unsigned int   node;
      const Element *of;
    };



    /// Elements that share an edge or a face share the node on it, which is no
    /// vertex, and on no other.
    void
    check_nodes_between(const MeshFile &file, const Mesh &mesh)
    {
      std::vector<Between> all;
      std::vector<bool>    is_vertex(mesh.nodes.size(), false);
      for (const auto *const list : {&mesh.cells, &mesh.faces, &mesh.lines})
        for (const Element &element : *list)
          {
            const auto &type = *element.type;
            for (unsigned int v = 0; v < type.n_vertices; ++v)
              is_vertex[element.nodes[v]] = true;
            for (std::size_t k = 0; k < type.places.size(); ++k)
              {
                Between between;
                between.nodes.fill(no_node);
                for (std::size_t v = 0; v < type.places[k].size(); ++v)
                  between.nodes[v] = element.nodes[type.places[k][v]];
                std::sort(between.nodes.begin(), between.nodes.end());
                between.element = all.size();
                between.node    = element.more_nodes[k];
                between.of      = &element;
                all.push_back(between);
              }
          }
      const auto fail = [&](const Between &a, const std::string &what) {
        file.fail(a.of->line,
                  describe(*a.of) + " has the node " +
                    std::to_string(mesh.nodes[a.node].number) +
                    " between its vertices, " + what);
      };
      std::sort(all.begin(), all.end());
      for (std::size_t k = 0; k < all.size(); ++k)
        {
          if (is_vertex[all[k].node])
            fail(all[k], "which is the vertex of another.");
          if (k > 0 && all[k].nodes == all[k - 1].nodes &&
              all[k].node != all[k - 1].node)
            fail(all[k],
                 "but " + in_line(*all[k - 1].of) + " has another one there.");
        }
      std::sort(all.begin(), all.end(), [](const Between &a, const Between &b) {
        return std::tie(a.node, a.element) < std::tie(b.node, b.element);
      });
      for (std::size_t k = 1; k < all.size(); ++k)
        if (all[k].node == all[k - 1].node && all[k].nodes != all[k - 1].nodes)
          fail(all[k],
               "which " + in_line(*all[k - 1].of) + " has somewhere else.");
    }



    /// A line in 3D, and where it was met.
    struct Line : Key<2>
    {
      bool is_edge     = false;
      bool at_boundary = false;
    };



    /// Mark those of @p lines that are edges of a face of a cell.
    void
    mark_edges(const Element                   &cell,
               const std::vector<unsigned int> &face,
               bool Line::*const  mark,
               std::vector<Line> &lines)
    {
      for (std::size_t v = 0; v < face.size(); ++v)
        {
          Line edge;
          edge.nodes = {
            {cell.nodes[face[v]], cell.nodes[face[(v + 1) % face.size()]]}};
          std::sort(edge.nodes.begin(), edge.nodes.end());
          edge.element    = 0;
          const auto line = std::lower_bound(lines.begin(), lines.end(), edge);
          if (line != lines.end() && line->nodes == edge.nodes)
            (*line).*mark = true;
        }
    }



    /// deal.II refuses a boundary's number for an edge within the body. Lines
    /// that are no edge are ignored.
    void
    check_lines(const MeshFile          &file,
                const Mesh              &mesh,
                const std::vector<Face> &boundary)
    {
      if (mesh.lines.empty())
        return;
      std::vector<Line> lines;
      for (const Element &element : mesh.lines)
        lines.push_back({make_key<2>(element, lines.size())});
      std::sort(lines.begin(), lines.end());
      // The first of several lines with the same nodes represents all.
      for (const Element &cell : mesh.cells)
        for (const auto &face : cell.type->faces)
          mark_edges(cell, face, &Line::is_edge, lines);
      for (const Face &face : boundary)
        {
          const Element &cell = mesh.cells[face.element];
          mark_edges(cell,
                     cell.type->faces[face.number],
                     &Line::at_boundary,
                     lines);
        }
      for (const Line &line : lines)
        if (line.is_edge && !line.at_boundary)
          file.fail(mesh.lines[line.element].line,
                    describe(mesh.lines[line.element]) +
                      " lies within the body; only those on the boundary can "
                      "be read.");
    }
  } // namespace



  void
  check_mesh_file(const std::string &file_name)
  {
    namespace fs = std::filesystem;
    std::error_code       error;
    const fs::file_status status = fs::status(file_name, error);
    if (fs::is_directory(status))
      throw InputError("The mesh file '" + file_name + "' is a directory.");
    if (!fs::is_regular_file(status))
      throw InputError("The mesh file '" + file_name + "' cannot be read.");
    const double size   = static_cast<double>(fs::file_size(file_name, error));
    const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
      static_cast<double>(sysconf(_SC_PAGE_SIZE));
    constexpr double memory_of_mesh = 16.;
    if (!error && memory_of_mesh * size > memory)
      throw InputError(
        "The mesh file '" + file_name + "' has " + to_text(size / 1e9) +
        " GB; its mesh would take more than the " + to_text(memory / 1e9) +
        " GB of memory of this machine.");
  }



  unsigned int
  check_gmsh_file(const std::string &file_name, const unsigned int dim)
  {
    MeshFile   file(file_name);
    const Mesh mesh = read_mesh(file, dim);
    check_shapes(file, mesh);
    check_volumes(file, mesh);
    check_repetitions(file, mesh);
    std::vector<Face>       boundary = collect_faces(mesh.cells);
    const std::vector<Face> inner = separate_inner_faces(file, mesh, boundary);
    check_boundary_elements(file, mesh, inner, boundary);
    check_lines(file, mesh, boundary);
    check_nodes_between(file, mesh);
    return mesh.cells.front().type->order;
  }
} // namespace Ricochet
