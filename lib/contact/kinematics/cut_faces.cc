// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <contact/kinematics/cut_faces.h>
#include <contact/obstacles/half_space.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/cell_id.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    using CellIterator = typename Triangulation<dim>::active_cell_iterator;

    /// A straight face, with the unknowns of its cell: on all ranks.
    template <int dim>
    struct Face
    {
      CellIterator<dim>                    cell;
      std::array<Point<dim>, 2>            ends;
      std::array<Point<dim>, 2>            ends_of_unit_cell;
      Tensor<1, dim>                       outward;
      std::vector<types::global_dof_index> unknowns;

      Point<dim>
      unit_point(const double along) const
      {
        return Point<dim>((1. - along) * ends_of_unit_cell[0] +
                          along * ends_of_unit_cell[1]);
      }

      double
      length() const
      {
        return ends[0].distance(ends[1]);
      }
    };

    template <int dim>
    Face<dim>
    make_face(const CellIterator<dim> &cell, const unsigned int f)
    {
      Face<dim>          face;
      const auto         shape = cell->reference_cell();
      const unsigned int a =
        shape.face_to_cell_vertices(f, 0, /* face_orientation = */ 1);
      const unsigned int b   = shape.face_to_cell_vertices(f, 1, 1);
      face.cell              = cell;
      face.ends              = {{cell->vertex(a), cell->vertex(b)}};
      face.ends_of_unit_cell = {
        {shape.template vertex<dim>(a), shape.template vertex<dim>(b)}};
      const Tensor<1, dim> along = face.ends[1] - face.ends[0];
      face.outward               = Tensor<1, dim>({along[1], -along[0]});
      face.outward /= face.outward.norm();
      if ((cell->center() - face.ends[0]) * face.outward > 0.)
        face.outward *= -1.;
      return face;
    }

    /// Action on each owned boundary face with one of the @p ids.
    template <int dim, typename Action>
    void
    for_each_own_face(const Body<dim>                    &body,
                      const std::set<types::boundary_id> &ids,
                      const Action                       &action)
    {
      for (const auto &cell : body.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary() &&
                ids.count(cell->face(f)->boundary_id()) > 0)
              action(cell, f);
    }

    template <int dim>
    std::vector<types::global_dof_index>
    unknowns_of(const Body<dim>                                      &body,
                const typename DoFHandler<dim>::active_cell_iterator &cell)
    {
      std::vector<types::global_dof_index> indices(
        body.dof_handler().get_fe().n_dofs_per_cell());
      cell->get_dof_indices(indices);
      for (auto &index : indices)
        index = body.system_index(index);
      return indices;
    }

    /// The faces with one of the @p ids on all ranks. Cells are known
    /// everywhere, but their unknowns are not.
    template <int dim>
    std::vector<Face<dim>>
    faces_of_all_ranks(const Body<dim>                    &body,
                       const std::set<types::boundary_id> &ids)
    {
      struct Message
      {
        CellId::binary_type                  cell;
        unsigned int                         face_number;
        std::vector<types::global_dof_index> unknowns;

        void
        serialize(boost::archive::binary_oarchive &archive, const unsigned int)
        {
          archive &cell &face_number &unknowns;
        }

        void
        serialize(boost::archive::binary_iarchive &archive, const unsigned int)
        {
          archive &cell &face_number &unknowns;
        }
      };
      std::vector<Message> mine;
      for_each_own_face(body, ids, [&](const auto &cell, const unsigned int f) {
        mine.push_back(
          {cell->id().template to_binary<dim>(), f, unknowns_of(body, cell)});
      });
      std::vector<Face<dim>> faces;
      const auto &triangulation = body.dof_handler().get_triangulation();
      for (const auto &list :
           Utilities::MPI::all_gather(body.communicator, mine))
        for (const Message &message : list)
          {
            const auto cell =
              triangulation.create_cell_iterator(CellId(message.cell));
            faces.push_back(
              make_face<dim>(CellIterator<dim>(cell), message.face_number));
            faces.back().unknowns = message.unknowns;
          }
      return faces;
    }

    /// A part of a face of the slave and the face of the master opposite to it,
    /// in coordinates along the faces from 0 to 1.
    template <int dim>
    struct Cut
    {
      double           begin, end;
      const Face<dim> *master;
    };

    /// The intersection of the line of @p face with the normal in the point @p x:
    /// its distance and its coordinate along the face.
    template <int dim>
    std::pair<double, double>
    before(const Point<dim>     &x,
           const Tensor<1, dim> &normal,
           const Face<dim>      &face)
    {
      const Tensor<1, dim> e = face.ends[1] - face.ends[0];
      const Tensor<1, dim> r = face.ends[0] - x;
      // x + distance normal = end + along e
      const double determinant = normal[1] * e[0] - normal[0] * e[1];
      return {(r[1] * e[0] - r[0] * e[1]) / determinant,
              (normal[0] * r[1] - normal[1] * r[0]) / determinant};
    }

    template <int dim>
    std::vector<Cut<dim>>
    cut(const Face<dim> &slave, const std::vector<Face<dim>> &master)
    {
      const Tensor<1, dim>           e = slave.ends[1] - slave.ends[0];
      std::vector<const Face<dim> *> candidates;
      std::vector<double>            places = {0., 1.};
      for (const Face<dim> &face : master)
        {
          // A face that is nearly at right angles does not face the slave.
          if (!(face.outward * slave.outward < -.1))
            continue;
          double begin = (face.ends[0] - slave.ends[0]) * e / e.norm_square();
          double end   = (face.ends[1] - slave.ends[0]) * e / e.norm_square();
          if (begin > end)
            std::swap(begin, end);
          if (!(begin < 1. && end > 0.))
            continue;
          candidates.push_back(&face);
          places.push_back(std::clamp(begin, 0., 1.));
          places.push_back(std::clamp(end, 0., 1.));
        }
      std::sort(places.begin(), places.end());
      std::vector<Cut<dim>> cuts;
      for (unsigned int k = 0; k + 1 < places.size(); ++k)
        {
          if (places[k + 1] - places[k] < 1e-10)
            continue;
          const double middle  = .5 * (places[k] + places[k + 1]);
          double       nearest = std::numeric_limits<double>::infinity();
          Cut<dim>     part{places[k], places[k + 1], nullptr};
          for (const Face<dim> *face : candidates)
            {
              const auto [distance, along] =
                before(slave.ends[0] + middle * e, slave.outward, *face);
              // A face deep inside is the far side of a body.
              if (along < 0. || along > 1. || distance < -slave.length() ||
                  distance >= nearest)
                continue;
              nearest     = distance;
              part.master = face;
            }
          if (part.master)
            cuts.push_back(part);
        }
      return cuts;
    }

    /// Values and gradients of the shape functions in one point of a cell.
    template <int dim>
    class ShapeValues
    {
    public:
      ShapeValues(const Mapping<dim>       &mapping,
                  const FiniteElement<dim> &element,
                  const Point<dim>         &unit_point,
                  const UpdateFlags         flags,
                  const CellIterator<dim>  &cell)
        : values(mapping,
                 element,
                 Quadrature<dim>(std::vector<Point<dim>>{unit_point},
                                 std::vector<double>{1.}),
                 flags)
      {
        values.reinit(cell);
      }

      FEValues<dim> values;
    };
  } // namespace



  template <int dim>
  CutFaces<dim>::CutFaces(const Body<dim>                  &body,
                          const std::vector<LinearElastic> &materials,
                          const std::vector<ContactPair>   &pairs)
  {
    static_assert(dim == 2, "Faces are cut in 2D only.");
    const FEValuesExtractors::Vector displacement(0);
    const FiniteElement<dim>        &element = body.dof_handler().get_fe();
    const Quadrature<dim - 1>       &rule    = body.face_quadrature();
    const auto material_of = [&](const CellIterator<dim> &cell) {
      return materials[materials.size() == 1 ? 0 : cell->material_id()];
    };
    std::vector<types::global_dof_index> multiplier_indices;
    if (body.has_multipliers())
      multiplier_indices.resize(
        body.multiplier_dof_handler().get_fe().n_dofs_per_cell());

    for (const ContactPair &pair : pairs)
      {
        const std::vector<Face<dim>> master =
          faces_of_all_ranks(body, pair.master);
        const unsigned int n_points_before = points.points.size();
        for_each_own_face(
          body,
          pair.slave,
          [&](const auto &cell, const unsigned int f) {
            Face<dim> slave = make_face<dim>(CellIterator<dim>(cell), f);
            slave.unknowns  = unknowns_of(body, cell);
            slave_area[cell->face(f)->boundary_id()] += slave.length();
            for (const Cut<dim> &part : cut(slave, master))
              for (unsigned int q = 0; q < rule.size(); ++q)
                {
                  const double along =
                    part.begin + (part.end - part.begin) * rule.point(q)[0];
                  const Point<dim> x =
                    slave.ends[0] + along * (slave.ends[1] - slave.ends[0]);
                  // The distance to the line of the master is linear in the
                  // displacement; that along the normal of a curved slave is not.
                  const Tensor<1, dim> normal = part.master->outward;
                  const Tensor<1, dim> to_x   = x - part.master->ends[0];
                  const Tensor<1, dim> of_master =
                    part.master->ends[1] - part.master->ends[0];
                  const double gap = to_x * normal;
                  const double along_master =
                    to_x * of_master / of_master.norm_square();
                  ContactPoint point;
                  point.weight =
                    rule.weight(q) * (part.end - part.begin) * slave.length();
                  point.initial_gap = gap;
                  point.cell_diameter =
                    std::min(cell->diameter(), part.master->cell->diameter());
                  point.boundary_id        = cell->face(f)->boundary_id();
                  point.obstacle_normal    = in_space(normal);
                  point.reference_position = in_space<dim>(x);
                  point.obstacle =
                    half_space_at_rest<dim>(x - gap * normal, normal);
                  point.begin = points.index.size();
                  // The displacement of the slave less that of the master.
                  const auto add = [&](const Face<dim> &face,
                                       const Face<dim> &other,
                                       const double     place,
                                       const double     sign) {
                    const ShapeValues<dim> shape(body.mapping(),
                                                 element,
                                                 face.unit_point(place),
                                                 update_values |
                                                   update_gradients,
                                                 face.cell);
                    const LinearElastic    material = material_of(face.cell);
                    const double           factor =
                      stress_weight(material, material_of(other.cell));
                    for (unsigned int i = 0; i < element.n_dofs_per_cell(); ++i)
                      {
                        const double stress_pressure = -factor *
                          (slave.outward *
                           (material.stress(shape.values[displacement]
                                              .symmetric_gradient(i, 0)) *
                            slave.outward));
                        // Values off the face are zero, except for round-off.
                        double value = sign * shape.values.shape_value(i, 0);
                        if (std::abs(value) < 1e-12)
                          value = 0.;
                        if (value != 0. || stress_pressure != 0.)
                          points.add_displacement(
                            face.unknowns[i],
                            element.system_to_component_index(i).first,
                            value,
                            stress_pressure);
                      }
                  };
                  add(slave, *part.master, along, 1.);
                  add(*part.master, slave, along_master, -1.);
                  if (body.has_multipliers())
                    {
                      const auto &space =
                        body.multiplier_dof_handler().get_fe();
                      const ShapeValues<dim> shape(body.mapping(),
                                                   space,
                                                   slave.unit_point(along),
                                                   update_values,
                                                   slave.cell);
                      body.multiplier_cell(cell)->get_dof_indices(
                        multiplier_indices);
                      for (unsigned int i = 0; i < multiplier_indices.size();
                           ++i)
                        {
                          const auto index =
                            body.multiplier_system_index(multiplier_indices[i]);
                          const double value = shape.values.shape_value(i, 0);
                          if (index != numbers::invalid_dof_index &&
                              std::abs(value) > 1e-12)
                            points.add_multiplier(index, value);
                        }
                    }
                  point.end = points.index.size();
                  points.points.push_back(point);
                  parts.insert({slave.cell->material_id(),
                                part.master->cell->material_id()});
                }
          });
        if (Utilities::MPI::sum(points.points.size() - n_points_before,
                                body.communicator) == 0)
          throw InputError(
            "The faces of the contact '" + pair.name +
            "' nowhere overlap: along its normals no face of the slave has one "
            "of the master before it. Contact/Coupling = cut faces needs the "
            "bodies where they will touch, at small displacements.");
      }
    for (const ContactPair &pair : pairs)
      for (const auto id : pair.slave)
        slave_area[id] = Utilities::MPI::sum(slave_area[id], body.communicator);
    // The same result on all ranks.
    using Parts = std::vector<std::pair<unsigned int, unsigned int>>;
    for (const Parts &list :
         Utilities::MPI::all_gather(body.communicator,
                                    Parts(parts.begin(), parts.end())))
      parts.insert(list.begin(), list.end());
  }


  template struct CutFaces<2>;
} // namespace Ricochet
