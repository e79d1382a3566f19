// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/laws/regularised_friction.h>
#include <base/exceptions.h>
#include <base/files.h>
#include <base/units.h>
#include <contact/obstacles/obstacle_shape.h>
#include <contact/surfaces/closest_point.h>
#include <problems/impact.h>
#include <discretization/nearest_vertex.h>
#include <output/obstacle_surfaces.h>
#include <scene/scene.h>

#include <deal.II/grid/grid_out.h>
#include <deal.II/grid/grid_tools.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>
#include <set>
#include <sstream>

// Description of a scene before its run.
namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// For output only.
    double
    three_digits(const double number)
    {
      char digits[40];
      std::snprintf(digits, sizeof(digits), "%.3g", number);
      return std::stod(digits);
    }

    /// The pieces of a mesh that have no common vertex.
    template <int dim>
    unsigned int
    number_of_pieces(const Triangulation<dim> &mesh)
    {
      std::vector<unsigned int> next(mesh.n_vertices());
      std::iota(next.begin(), next.end(), 0U);
      const auto root = [&](unsigned int v) {
        while (next[v] != v)
          v = next[v] = next[next[v]];
        return v;
      };
      for (const auto &cell : mesh.active_cell_iterators())
        for (const unsigned int v : cell->vertex_indices())
          next[root(cell->vertex_index(v))] = root(cell->vertex_index(0));
      unsigned int n = 0;
      for (unsigned int v = 0; v < next.size(); ++v)
        n += next[v] == v && mesh.vertex_used(v);
      return n;
    }
  } // namespace



  template <int dim>
  std::string
  Scene<dim>::note_on_units(const PartOfScene   &part,
                            const LinearElastic &elastic) const
  {
    const Units  units(units_text);
    const double density = units.in_si(part.material.density, "kg/m^3");
    // Without inertia it has no meaning, and numbers without dimension are usually given without
    // Units.
    if (!scheme_traits(impact.scheme.name).has_inertia)
      return "";
    if (!units.are_si() && (density < 1. || density > 3e4))
      return "the density of '" + part.name + "' is " + to_text(density) +
        " kg/m^3 in Units = " + units_text + ", in which that of steel is " +
        to_text(7850. / units.in_si(1., "kg/m^3")) + ".";
    const double speed =
      std::sqrt((elastic.lambda + 2. * elastic.mu) / part.material.density);
    const double across = std::pow(part.measure, 1. / dim) / speed;
    if (across > 100. * impact.time.final_time)
      return "a wave takes " + units.text(three_digits(across), "s") +
        " to cross '" + part.name + "', and the run ends after " +
        units.text(impact.time.final_time, "s") +
        ". Are its density and Young's modulus in consistent units?";
    return "";
  }



  template <int dim>
  std::vector<std::string>
  Scene<dim>::notes() const
  {
    std::vector<std::string> lines;
    for (unsigned int i = 0; i < obstacles.size(); ++i)
      if (std::none_of(contacts.begin(),
                       contacts.end(),
                       [&](const ContactSection &contact) {
                         const auto own = find_touching(contact).obstacles;
                         return std::count(own.begin(), own.end(), i) > 0;
                       }))
        lines.push_back("note: " + obstacles[i].first.where +
                        ": nothing can touch the obstacle '" +
                        obstacles[i].first.name + "': no contact names it.");
    std::set<unsigned int> touching_bodies, touching_themselves;
    for (const ContactSection &contact : contacts)
      {
        const Touching touching = find_touching(contact);
        for (const auto &surface : touching.slave)
          {
            touching_bodies.insert(surface.body);
            if (touching.is_self)
              touching_themselves.insert(surface.body);
          }
        if (touching.obstacles.empty() && !touching.is_self)
          for (const auto &surface :
               surfaces.find(contact.against, contact.name_of("Against")))
            touching_bodies.insert(surface.body);
      }
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        const NamedSection &section = bodies[b].section;
        if (!contacts.empty() && touching_bodies.count(b) == 0)
          lines.push_back("note: " + section.where + ": the body '" +
                          section.name +
                          "' touches nothing: no contact names it.");
        const unsigned int n_pieces = number_of_pieces(meshes[b]->cells);
        if (n_pieces > 1 && touching_themselves.count(b) == 0)
          lines.push_back("note: " + section.where +
                          ": the mesh of the body '" + section.name + "' has " +
                          std::to_string(n_pieces) +
                          " pieces without a common vertex, which move by "
                          "themselves and pass through each other. A body for "
                          "each of them" +
                          (bodies[b].file.empty() ? "" : " (Group)") +
                          " may touch the others.");
      }
    for (const auto &material : materials)
      if (std::none_of(parts.begin(), parts.end(), [&](const auto &part) {
            return part.material.section == material.first.full_name();
          }))
        lines.push_back("note: " + material.first.where +
                        ": nothing is made of the material '" +
                        material.first.name + "'.");
    for (const PartOfScene &part : parts)
      {
        const MaterialParameters &material = part.material;
        const BodySection<dim>   &body     = bodies[part.body];
        const LinearElastic       small    = material.at_small_strains();
        const double              poisson_ratio =
          .5 * small.lambda / (small.lambda + small.mu);
        // In plane stress the thickness is free.
        if (degree == 1 && poisson_ratio >= .49 &&
            (dim == 3 || material.plane_state == "plane strain"))
          lines.push_back(
            "note: " + body.section.where + ": the body '" + part.name +
            "' hardly changes its volume (its Poisson's ratio is " +
            to_text(poisson_ratio) +
            "), and cells of degree 1 are much too stiff for that (locking). "
            "Mesh/Degree = 2 helps.");
        const std::string doubt = note_on_units(part, small);
        if (!doubt.empty())
          lines.push_back("note: " + body.section.where + ": " + doubt);
        // The strain of a rotation by 0.1 is 0.5 %.
        const double angle = body.spin.norm() * impact.time.final_time;
        if (material.is_linear() && angle > .1)
          lines.push_back(
            "note: " + body.section.where + ": the body '" + part.name +
            "' turns by " + to_text(angle) +
            " rad if nothing stops it, and a linear elastic body that turns "
            "swells, as its strains are those of small rotations. Other laws "
            "know no such bound.");
      }
    for (const ContactSection &contact : contacts)
      for (const auto &[name, value] : contact.parameters.used_values())
        if (name == RegularisedFriction::compliance_name)
          lines.push_back(
            "note: " + contact.section.where + ": friction of the treatment '" +
            contact.parameters.treatment +
            "' is regularised: points that stick creep, with its tangential "
            "traction over " +
            name + " (" + to_text(value) + " in the units of this file)" +
            (scheme_traits(impact.scheme.name).has_inertia
               ? ". "
               : ", and time has no meaning in a static analysis. ") +
            "With Stick = exact it does not.");
    // Nodes that land are stopped within one step.
    const bool is_stopped_in_a_step =
      std::any_of(contacts.begin(),
                  contacts.end(),
                  [](const ContactSection &contact) {
                    return is_constraint(contact.parameters);
                  });
    const auto may_be_redistributed = [&]() {
      try
        {
          for (const ContactSection &contact : contacts)
            check(contact, find_touching(contact), true);
        }
      catch (const InputError &)
        {
          return false;
        }
      return true;
    };
    if (is_stopped_in_a_step && !impact.redistributed_mass() &&
        scheme_traits(impact.scheme.name).has_inertia)
      lines.push_back(
        std::string(
          "note: conditions of contact stop nodes with inertia within "
          "one step, so that the largest contact force depends on the "
          "step; impulses and energy do not. ") +
        (may_be_redistributed()
           ? "With Time/Mass = redistributed, where the mesh allows that, the "
             "force remains bounded as steps become shorter."
           : "A law (normal compliance) does not stop them so."));
    return lines;
  }



  template <int dim>
  std::vector<std::string>
  Scene<dim>::notes_on_fits(const std::vector<Contact> &assembled) const
  {
    std::vector<std::string> lines;
    for (const Contact &contact : assembled)
      for (const ContactPair &pair : contact.pairs)
        if (pair.overlap > 0.)
          lines.push_back("note: contact " + contact.name +
                          ": at the start the surfaces overlap by up to " +
                          Units(units_text).text(pair.overlap, "m") +
                          ", as facets are chords of arcs. Gaps are counted "
                          "from there, so that the fit begins without force.");
    return lines;
  }



  namespace
  {
    /// Faces of a mesh, and a search for the closest one.
    template <int dim>
    class FacesAtRest
    {
    public:
      /// A quadrilateral is four triangles, which meet in its middle, as in contact.
      template <typename Face>
      void
      add(const Face &face)
      {
        const unsigned int n = face->n_vertices();
        for (unsigned int v = 0; v < (n == 4 ? 4 : 1); ++v)
          {
            constexpr unsigned int  around[4] = {0, 1, 3, 2};
            std::vector<Point<dim>> corners;
            if (n == 4)
              corners = {face->vertex(around[v]),
                         face->vertex(around[(v + 1) % 4]),
                         face->center()};
            else
              for (const unsigned int w : face->vertex_indices())
                corners.push_back(face->vertex(w));
            boxes.emplace_back(BoundingBox<dim>(corners), facets.size());
            // An edge is a triangle without area.
            facets.push_back({{in_space<dim>(corners[0]),
                               in_space<dim>(corners[1]),
                               in_space<dim>(corners.back())}});
          }
      }

      /// Once all have been added.
      void
      sort()
      {
        tree = pack_rtree(boxes);
      }

      /// The distance of @p x from the closest face (m), or @p largest, if that is less.
      double
      distance(const Point<dim> &x, const double largest) const
      {
        namespace index    = boost::geometry::index;
        const auto from    = in_space<dim>(x);
        double     nearest = largest;
        for (auto box = tree.qbegin(
               index::nearest(x, static_cast<unsigned int>(boxes.size())));
             box != tree.qend();
             ++box)
          {
            if (boost::geometry::distance(x, box->first) > nearest)
              break;
            const auto &[a, b, c] = facets[box->second];
            const auto shares     = closest_in_triangle(from, a, b, c);
            nearest               = std::min(
              nearest,
              (shares[0] * a + shares[1] * b + shares[2] * c - from).norm());
          }
        return nearest;
      }

    private:
      using Box = std::pair<BoundingBox<dim>, std::size_t>;
      std::vector<Box>                         boxes;
      std::vector<std::array<Tensor<1, 3>, 3>> facets;
      RTree<Box>                               tree;
    };
  } // namespace



  template <int dim>
  double
  Scene<dim>::initial_gap(const ContactSection &contact) const
  {
    const Touching touching = find_touching(contact);
    double         smallest = std::numeric_limits<double>::infinity();
    if (touching.is_self)
      return smallest;
    const auto for_each_face =
      [&](const std::vector<SurfaceNames::Surface> &list, const auto &action) {
        for (const auto &surface : list)
          for (const auto &cell :
               meshes[surface.body]->cells.active_cell_iterators())
            for (const auto &face : cell->face_iterators())
              if (face->at_boundary() &&
                  surface.ids.count(face->boundary_id()) > 0)
                action(face);
      };
    if (!touching.obstacles.empty())
      {
        for (const unsigned int i : touching.obstacles)
          {
            const auto obstacle =
              obstacles[i].second.make(impact.time.final_time);
            for_each_face(touching.slave, [&](const auto &face) {
              for (const unsigned int v : face->vertex_indices())
                smallest =
                  std::min(smallest,
                           obstacle->gap(in_space<dim>(face->vertex(v)), 0.));
            });
          }
        return smallest;
      }
    // Smallest distance of the vertices of each surface from the facets of the
    // other one; two edges in 3D may be nearer.
    const std::array<std::vector<SurfaceNames::Surface>, 2> sides = {
      {touching.slave,
       surfaces.find(contact.against, contact.name_of("Against"))}};
    for (const unsigned int side : {0, 1})
      {
        FacesAtRest<dim> faces;
        for_each_face(sides[side], [&](const auto &face) { faces.add(face); });
        faces.sort();
        for_each_face(sides[1 - side], [&](const auto &face) {
          for (const unsigned int v : face->vertex_indices())
            smallest = faces.distance(face->vertex(v), smallest);
        });
      }
    return smallest;
  }



  namespace
  {
    // Files of a description in a folder.
    const std::string mesh_picture     = "setup.vtk",
                      obstacle_picture = "setup_obstacles.vtu",
                      description_file = "setup.txt";
    // The line that identifies them.
    const std::string title = "Meshes of a scene, by Ricochet";

    /// Components in brackets; those below @p round_off are 0.
    template <int dim>
    std::string
    in_brackets(const Tensor<1, dim> &vector, const double round_off)
    {
      std::string text;
      for (unsigned int c = 0; c < dim; ++c)
        text += (c > 0 ? ", " : "(") +
          to_text(std::abs(vector[c]) < round_off ? 0. : vector[c]);
      return text + ")";
    }

    /// Area, middle and mean normal of a boundary, by which a user recognises it.
    /// @param extent size of the body (m).
    template <int dim>
    std::string
    where_it_is(const typename BodyMesh<dim>::Boundary &boundary,
                const double                            extent)
    {
      std::string text =
        (dim == 2 ? "length " : "area ") + to_text(boundary.area) + ", middle ";
      Tensor<1, dim> middle, normal;
      for (unsigned int c = 0; c < dim; ++c)
        {
          middle[c] = boundary.moment[c] / boundary.area;
          if (std::abs(middle[c]) > 1e-12 * extent)
            middle[c] = three_digits(middle[c]);
          normal[c] =
            std::round(100. * boundary.normal[c] / boundary.area) / 100.;
        }
      text += in_brackets<dim>(middle, 1e-12 * extent);
      // Surfaces that go around the body have none.
      if (normal.norm() > .5)
        text += ", normal " + in_brackets<dim>(normal, .005);
      return text;
    }

    template <int dim>
    std::string
    picture_of(const Triangulation<dim> &whole)
    {
      std::ostringstream picture;
      GridOut            writer;
      writer.set_flags(GridOutFlags::Vtk(/* cells */ true,
                                         /* faces */ true,
                                         /* edges */ false,
                                         /* only those with numbers */ false));
      writer.write_vtk(whole, picture);
      const std::string text  = picture.str();
      const std::size_t begin = text.find('\n') + 1;
      return text.substr(0, begin) + title +
        text.substr(text.find('\n', begin));
    }

    /// Make the @p folder if need be, and @p lock it. @throws InputError where it is in use,
    /// or files of others are in it that have the names of ours.
    void
    take_description_folder(const std::string &folder, FolderLock &lock)
    {
      namespace fs = std::filesystem;
      std::error_code error;
      fs::create_directories(folder, error);
      lock.take(folder);
      std::string   line;
      std::ifstream earlier(folder + "/" + mesh_picture);
      std::getline(earlier, line);
      std::getline(earlier, line);
      if (line == title)
        return;
      for (const std::string &name :
           {mesh_picture, obstacle_picture, description_file})
        if (fs::exists(folder + "/" + name, error))
          throw InputError(
            "The folder '" + folder + "' has a file '" + name +
            "' that is not of Ricochet. Name another folder with "
            "--output-dir.");
    }
  } // namespace



  template <int dim>
  std::string
  Scene<dim>::description(const std::string &folder) const
  {
    const Units        units(units_text);
    std::ostringstream text;
    const std::string  extents[2] = {"area", "volume"};
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        const BodyMesh<dim> &mesh = *meshes[b];
        double               mass = 0., measure = 0.;
        for (unsigned int p = first_part[b]; p < first_part[b + 1]; ++p)
          {
            measure += parts[p].measure;
            mass += parts[p].measure * parts[p].material.density;
          }
        text << "Body " << bodies[b].section.name << ": "
             << mesh.cells.n_active_cells() << " cells, "
             << mesh.cells.n_used_vertices() << " vertices, "
             << extents[dim - 2] << ' ' << to_text(measure) << ", mass "
             << units.text(mass, "kg") << ", middle ";
        const double extent = std::pow(measure, 1. / dim);
        text << in_brackets<dim>(centres[b], 1e-12 * extent) << '\n';
        // Ratio of time steps to cells.
        double smallest = std::numeric_limits<double>::max(), fastest = 0.;
        for (const auto &cell : mesh.cells.active_cell_iterators())
          smallest = std::min(smallest, cell->minimum_vertex_distance());
        for (unsigned int p = first_part[b]; p < first_part[b + 1]; ++p)
          {
            const LinearElastic elastic = parts[p].material.at_small_strains();
            fastest                     = std::max(fastest,
                               std::sqrt((elastic.lambda + 2. * elastic.mu) /
                                         parts[p].material.density));
          }
        text << "  waves run at " << units.text(three_digits(fastest), "m/s")
             << ": through the body in about "
             << units.text(three_digits(extent / fastest), "s")
             << ", through the smallest cell in "
             << units.text(three_digits(smallest / fastest), "s")
             << "; a step is " << units.text(impact.time.time_step, "s")
             << '\n';
        if (first_part[b + 1] - first_part[b] > 1)
          for (unsigned int p = first_part[b]; p < first_part[b + 1]; ++p)
            text << "  part " << parts[p].name << ": " << extents[dim - 2]
                 << ' ' << to_text(parts[p].measure) << ", "
                 << parts[p].material.law << '\n';
        for (const auto &surface :
             surfaces.find(bodies[b].section.name, "description"))
          for (const auto id : surface.ids)
            text << "  boundary " << surfaces.name_of(id) << ": "
                 << where_it_is<dim>(mesh.boundaries.at(id), extent)
                 << (folder.empty()
                       ? ""
                       : ", number " + std::to_string(id) + " in setup.vtk")
                 << '\n';
      }
    for (const ContactSection &contact : contacts)
      {
        const double gap = initial_gap(contact);
        text << "Contact " << contact.section.name << ": "
             << contact.parameters.treatment;
        if (std::isfinite(gap))
          text << ", gap at the start " << units.text(gap, "m");
        text << '\n';
        for (const auto &[name, value] : contact.parameters.used_values())
          text << "  " << name << " = " << to_text(value) << '\n';
      }
    for (const ProbeSection<dim> &probe : probes)
      if (!probe.point.empty() && probe.quantity != "stress")
        {
          Point<dim> place;
          for (unsigned int c = 0; c < dim; ++c)
            place[c] = probe.point[c];
          const std::vector<Point<dim>> &vertices =
            meshes[probe.find_body(surfaces)]->cells.get_vertices();
          const Point<dim> nearest =
            *std::min_element(vertices.begin(),
                              vertices.end(),
                              [&](const auto &a, const auto &b) {
                                return is_nearer(a, b, place);
                              });
          text << "Probe " << probe.section.name << ": vertex (";
          for (unsigned int c = 0; c < dim; ++c)
            text << (c > 0 ? ", " : "") << to_text(nearest[c]);
          text << "), " << units.text(nearest.distance(place), "m")
               << " from the point\n";
        }
    // Overlaps are refused here as in a run.
    Triangulation<dim> whole;
    join(whole);
    FolderLock lock;
    if (!folder.empty())
      on_first_rank(MPI_COMM_WORLD, [&]() {
        take_description_folder(folder, lock);
        const std::string name = folder + "/" + mesh_picture;
        write_atomically(name, picture_of(whole));
        text << "The meshes, with the numbers of parts and boundaries: " << name
             << '\n';
      });
    ImpactSetup<dim> setup = make_setup();
    const auto       nodes = nodes_of_cells();
    if (!nodes.empty())
      setup.geometry = make_curved_geometry(nodes, whole, MPI_COMM_SELF);
    Impact<dim> assembly(impact, whole, setup, MPI_COMM_SELF);
    if (start_from.empty())
      assembly.state_of_parts();
    else
      text << "starts from the last state in " << start_from
           << "; contacts there are found when it begins\n";
    for (const ProbeSection<dim> &probe : probes)
      probe.check(assembly, surfaces, first_part);
    const ObstacleSurfaces<dim> obstacle_surfaces(assembly.obstacles);
    if (!folder.empty() && !obstacle_surfaces.empty())
      on_first_rank(MPI_COMM_WORLD, [&]() {
        DataOutBase::VtkFlags flags;
        flags.time                = 0.;
        flags.print_date_and_time = false;
        write_atomically(
          folder + "/" + obstacle_picture,
          obstacle_surfaces.vtu(GridTools::compute_bounding_box(whole), flags));
      });
    text << assembly.body.owned_indices().size() << " unknowns\n";
    for (const auto &lines : {notes(), notes_on_fits(assembly.contacts)})
      for (const std::string &line : lines)
        text << line << '\n';
    if (!folder.empty())
      on_first_rank(MPI_COMM_WORLD, [&]() {
        // The same text beside the picture.
        write_atomically(folder + "/" + description_file, text.str());
      });
    return text.str();
  }



  template std::vector<std::string>
  Scene<2>::notes() const;
  template std::vector<std::string>
  Scene<3>::notes() const;
  template std::string
  Scene<2>::description(const std::string &) const;
  template std::string
  Scene<3>::description(const std::string &) const;
} // namespace Ricochet
