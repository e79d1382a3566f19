// SPDX-License-Identifier: LGPL-2.1-or-later

// Contact on the cut faces between two linear elastic bodies: on a mesh whose faces match
// Nitsche's method is the interface form of a discontinuous Galerkin method, entry by
// entry; on any mesh forces and their moments add up to zero.

#include <base/exceptions.h>
#include <contact/kinematics/cut_faces.h>
#include <problems/impact.h>
#include <problems/part_meshes.h>
#include <solvers/united_pattern.h>

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_interface_values.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/grid/grid_tools.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <map>
#include <tuple>

using namespace Ricochet;
using dealii::Point;
using dealii::Tensor;

BOOST_AUTO_TEST_SUITE(cut_faces)

namespace
{
  const LinearElastic soft{1., 1.}, stiff{20., 10.};
  constexpr double    gamma_0 = 300.;

  /// Whether it is one of the upper body, and its place, on a grid finer than any
  /// mesh; and the component of the displacement.
  using Place = std::tuple<bool, long, long, unsigned int>;

  Place
  place(const bool is_upper, const Point<2> &x, const unsigned int component)
  {
    return {is_upper,
            std::lround(1e6 * x[0]),
            std::lround(1e6 * x[1]),
            component};
  }

  using Entries = std::map<std::pair<Place, Place>, double>;

  void
  make_blocks(const CellShape                             shape,
              const unsigned int                          n_lower,
              const unsigned int                          n_upper,
              dealii::parallel::shared::Triangulation<2> &mesh)
  {
    make_rectangles(
      {{Point<2>(0., -1.), Point<2>(1., 0.), {{n_lower, 2}}, 0., {}},
       {Point<2>(0., 0.), Point<2>(1., 1.), {{n_upper, 2}}, 0., {}}},
      shape,
      mesh);
  }

  ImpactSetup<2>
  two_blocks()
  {
    ImpactSetup<2> setup{Material<2>(soft)};
    setup.parts.push_back({"lower", Material<2>(soft), 1.});
    setup.parts.push_back({"upper", Material<2>(stiff), 1.});
    setup.pairs = {{"blocks",
                    {rectangle_side(0, Rectangle::upper)},
                    {rectangle_side(1, Rectangle::lower)}}};
    return setup;
  }

  /// The part of the tangent by Nitsche's method for two bodies that are
  /// pressed together everywhere.
  Entries
  tangent_of_contact(const CellShape shape, const double theta)
  {
    dealii::parallel::shared::Triangulation<2> mesh(MPI_COMM_WORLD);
    make_blocks(shape, 3, 3, mesh);
    ImpactParameters parameters;
    parameters.contact.treatment                = "Nitsche";
    parameters.contact.coupling                 = "cut faces";
    parameters.contact.values["Nitsche gamma0"] = gamma_0;
    parameters.contact.values["Nitsche theta"]  = theta;
    parameters.scheme.name                      = "HHT";
    Impact<2>        impact(parameters, mesh, two_blocks(), MPI_COMM_WORLD);
    const Body<2>   &body    = impact.body;
    ContactOperator &contact = *impact.contact;

    std::map<dealii::types::global_dof_index, Point<2>> positions;
    dealii::DoFTools::map_dofs_to_support_points(body.mapping(),
                                                 body.dof_handler(),
                                                 positions);
    const auto parts = body.parts_of_unknowns(2);
    std::map<dealii::types::global_dof_index, Place> places;
    for (unsigned int c = 0; c < 2; ++c)
      {
        const std::vector<bool> mask = {c == 0, c == 1};
        for (const auto i :
             dealii::DoFTools::extract_dofs(body.dof_handler(),
                                            dealii::ComponentMask(mask)))
          places[body.system_index(i)] =
            place(parts[body.system_index(i)] == 1, positions.at(i), c);
      }

    // The upper one is a little lower.
    Vector pressed = body.make_vector();
    for (const auto &[i, where] : places)
      if (std::get<0>(where) && std::get<3>(where) == 1)
        pressed(i) = -.01;
    pressed.compress(dealii::VectorOperation::insert);
    const Vector zero = body.make_vector();
    contact.begin_stage({pressed, zero, zero, 0., 0.}, 1.);
    Vector residual = body.make_vector();
    contact.add_residual(pressed, residual);
    Matrix bodies, matrix;
    bodies.reinit(body.sparsity_pattern());
    UnitedPattern united;
    united.update(body.sparsity_pattern(), *contact.couplings());
    united.embed(bodies, matrix);
    contact.add_tangent(matrix);

    Entries entries;
    for (const auto &entry : matrix)
      if (entry.value() != 0.)
        entries[{places.at(entry.row()), places.at(entry.column())}] =
          entry.value();
    return entries;
  }

  /// The interface form, on one mesh whose cells have unknowns of their own,
  ///
  ///     - (mean p(u), jump g(v)) - theta (mean p(v), jump g(u))
  ///     + gamma (jump g(u), jump g(v)),
  ///
  /// p = -n . sigma n, g = -n . u, jumps from the upper side to the lower one, and n
  /// the normal of the lower one.
  Entries
  interface_form(const CellShape shape, const double theta)
  {
    dealii::parallel::shared::Triangulation<2> apart(MPI_COMM_WORLD);
    make_blocks(shape, 3, 3, apart);
    auto [vertices, cells, subcells] =
      dealii::GridTools::get_coarse_mesh_description(apart);
    std::vector<unsigned int> all;
    dealii::GridTools::delete_duplicated_vertices(vertices,
                                                  cells,
                                                  subcells,
                                                  all,
                                                  1e-9);
    dealii::Triangulation<2> mesh;
    mesh.create_triangulation(vertices, cells, {});

    const bool                 is_simplex = shape == CellShape::triangles;
    const auto                 element    = is_simplex
                         ? std::make_unique<dealii::FESystem<2>>(dealii::FE_SimplexDGP<2>(1), 2)
                         : std::make_unique<dealii::FESystem<2>>(dealii::FE_DGQ<2>(1), 2);
    const dealii::MappingFE<2> simplex_mapping(dealii::FE_SimplexP<2>(1));
    const dealii::MappingQ<2>  tensor_mapping(1);
    const dealii::Mapping<2>  &mapping = is_simplex
       ? static_cast<const dealii::Mapping<2> &>(simplex_mapping)
       : tensor_mapping;
    dealii::DoFHandler<2>      dofs(mesh);
    dofs.distribute_dofs(*element);
    dealii::FEInterfaceValues<2> interface(mapping,
                                           *element,
                                           dealii::QGauss<1>(2),
                                           dealii::update_values |
                                             dealii::update_gradients |
                                             dealii::update_JxW_values |
                                             dealii::update_normal_vectors |
                                             dealii::update_quadrature_points);
    Entries                      entries;
    const double lower_weight = CutFaces<2>::stress_weight(soft, stiff);
    for (const auto &cell : dofs.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        {
          // From below.
          if (cell->face(f)->at_boundary() ||
              std::abs(cell->face(f)->center()[1]) > 1e-9 ||
              cell->center()[1] > 0.)
            continue;
          const auto neighbor = cell->neighbor(f);
          interface.reinit(cell,
                           f,
                           dealii::numbers::invalid_unsigned_int,
                           neighbor,
                           cell->neighbor_of_neighbor(f),
                           dealii::numbers::invalid_unsigned_int);
          const unsigned int n       = interface.n_current_interface_dofs();
          const auto         indices = interface.get_interface_dof_indices();
          std::vector<Place> places;
          for (unsigned int i = 0; i < n; ++i)
            {
              const auto both = interface.interface_dof_to_dof_indices(i);
              const unsigned int side =
                both[0] != dealii::numbers::invalid_unsigned_int ? 0 : 1;
              const auto [component, node] =
                element->system_to_component_index(both[side]);
              const Point<2> unit =
                element->base_element(0).unit_support_point(node);
              places.push_back(place(
                side == 1,
                mapping.transform_unit_to_real_cell(
                  side == 0
                    ? typename dealii::Triangulation<2>::cell_iterator(cell)
                    : typename dealii::Triangulation<2>::cell_iterator(
                        neighbor),
                  unit),
                component));
            }
          const double gamma =
            gamma_0 / std::min(cell->diameter(), neighbor->diameter());
          for (unsigned int q = 0; q < interface.n_quadrature_points; ++q)
            {
              const Tensor<1, 2>  normal = interface.normal(q);
              std::vector<double> gap(n), pressure(n);
              for (unsigned int i = 0; i < n; ++i)
                {
                  const auto both = interface.interface_dof_to_dof_indices(i);
                  const unsigned int side =
                    both[0] != dealii::numbers::invalid_unsigned_int ? 0 : 1;
                  const unsigned int c =
                    element->system_to_component_index(both[side]).first;
                  gap[i] = -normal[c] * interface.jump_in_shape_values(i, q, c);
                  Tensor<2, 2> gradient;
                  gradient[c] = interface.get_fe_face_values(side)
                                  .shape_grad_component(both[side], q, c);
                  const LinearElastic &material = side == 0 ? soft : stiff;
                  pressure[i] =
                    -(side == 0 ? lower_weight : 1. - lower_weight) *
                    (normal *
                     (material.stress(dealii::symmetrize(gradient)) * normal));
                }
              for (unsigned int i = 0; i < n; ++i)
                for (unsigned int j = 0; j < n; ++j)
                  entries[{places[i], places[j]}] += interface.JxW(q) *
                    (-pressure[j] * gap[i] - theta * pressure[i] * gap[j] +
                     gamma * gap[i] * gap[j]);
            }
        }
    return entries;
  }
} // namespace


BOOST_AUTO_TEST_CASE(nitsche_is_an_interface_form)
{
  for (const CellShape shape :
       {CellShape::triangles, CellShape::quadrilaterals})
    for (const double theta : {1., 0., -1.})
      {
        const Entries contact = tangent_of_contact(shape, theta);
        Entries       form    = interface_form(shape, theta);
        double        largest = 0., error = 0.;
        for (const auto &[where, value] : contact)
          {
            largest = std::max(largest, std::abs(value));
            error   = std::max(error, std::abs(value - form[where]));
          }
        for (const auto &[where, value] : form)
          if (contact.count(where) == 0)
            error = std::max(error, std::abs(value));
        BOOST_TEST_MESSAGE("theta " << theta << ": " << contact.size()
                                    << " entries, the largest " << largest
                                    << ", error " << error);
        BOOST_CHECK_GT(largest, 1.);
        BOOST_CHECK_LT(error, 1e-12 * largest);
      }
}



// For each point on its own: a motion of all together, or a small turn, changes no gap.
BOOST_AUTO_TEST_CASE(rigid_motions_change_no_gap)
{
  dealii::parallel::shared::Triangulation<2> mesh(MPI_COMM_WORLD);
  make_ringed_disks({{Point<2>(-1.01, 0.), 1., 6, .1},
                     {Point<2>(1.01, .2), 1., 9, 3.}},
                    mesh);
  const Body<2> body(mesh, 1, {}, {0}, MultiplierSpace::none, MPI_COMM_WORLD);
  const CutFaces<2> faces(body, {soft, stiff}, {{"disks", {0}, {1}, false}});

  std::map<dealii::types::global_dof_index, Point<2>> positions, known;
  dealii::DoFTools::map_dofs_to_support_points(body.mapping(),
                                               body.dof_handler(),
                                               known);
  for (const auto &[i, x] : known)
    positions[body.system_index(i)] = x;
  double error = 0., length = 0.;
  for (const ContactPoint &point : faces.points.points)
    {
      Tensor<1, 2> sum, stress_sum;
      double       moment = 0., stress_moment = 0.;
      bool         all_known = true;
      for (unsigned int k = point.begin; k < point.end; ++k)
        {
          const auto found = positions.find(faces.points.index[k]);
          if (found == positions.end())
            {
              all_known = false;
              break;
            }
          const unsigned int c = faces.points.component[k];
          const double arm     = c == 0 ? -found->second[1] : found->second[0];
          const double gap_coefficient =
            point.obstacle_normal[c] * faces.points.shape_value[k];
          sum[c] += gap_coefficient;
          moment += arm * gap_coefficient;
          stress_sum[c] += faces.points.stress_pressure_coefficient[k];
          stress_moment += arm * faces.points.stress_pressure_coefficient[k];
        }
      length += point.weight;
      if (!all_known)
        continue;
      error = std::max({error,
                        sum.norm(),
                        std::abs(moment),
                        1e-3 * stress_sum.norm(),
                        1e-3 * std::abs(stress_moment)});
    }
  BOOST_CHECK_LT(error, 1e-13);
  // The normals that meet the other disk.
  length = dealii::Utilities::MPI::sum(length, MPI_COMM_WORLD);
  BOOST_CHECK_CLOSE(length, 2. * std::asin(1. / std::hypot(2.02, .2)), 5.);
}



BOOST_AUTO_TEST_CASE(faces_that_do_not_overlap_are_refused)
{
  dealii::parallel::shared::Triangulation<2> mesh(MPI_COMM_WORLD);
  make_rectangles({{Point<2>(0., -1.), Point<2>(1., 0.), {{2, 2}}, 0., {}},
                   {Point<2>(2., 0.), Point<2>(3., 1.), {{2, 2}}, 0., {}}},
                  CellShape::quadrilaterals,
                  mesh);
  ImpactParameters parameters;
  parameters.contact.treatment = "penalty";
  parameters.contact.coupling  = "cut faces";
  parameters.scheme.name       = "HHT";
  BOOST_CHECK_EXCEPTION(
    Impact<2>(parameters, mesh, two_blocks(), MPI_COMM_WORLD),
    InputError,
    [](const InputError &error) {
      return std::string(error.what()).find("nowhere overlap") !=
        std::string::npos;
    });
}

BOOST_AUTO_TEST_SUITE_END()
