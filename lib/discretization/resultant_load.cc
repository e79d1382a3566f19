// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <discretization/boundary_load.h>
#include <discretization/resultant_load.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_values.h>

#include <array>
#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Tensor<1, 3>
    in_three_dimensions(const Tensor<1, dim> &vector)
    {
      Tensor<1, 3> result;
      for (unsigned int c = 0; c < dim; ++c)
        result[c] = vector[c];
      return result;
    }

    /// A surface: its area (m^(dim-1)), its middle (m), and J (m^(dim+1)).
    template <int dim>
    struct Moments
    {
      double         area = 0.;
      Tensor<1, dim> middle;
      Tensor<2, 3>   second;

      /// Integrals with the quadrature of the loads, so that the resultants are exact.
      Moments(const Body<dim> &body, const std::set<types::boundary_id> &ids)
      {
        FEFaceValues<dim> values(body.mapping(),
                                 body.dof_handler().get_fe(),
                                 body.face_quadrature(),
                                 update_JxW_values | update_quadrature_points);
        const auto        integrate =
          [&](const std::function<void(const Tensor<1, dim> &, const double)>
                &add) {
            for (const auto &cell : body.dof_handler().active_cell_iterators())
              if (cell->is_locally_owned())
                for (const unsigned int f : cell->face_indices())
                  if (cell->face(f)->at_boundary() &&
                      ids.count(cell->face(f)->boundary_id()) > 0)
                    {
                      values.reinit(cell, f);
                      for (const unsigned int q :
                           values.quadrature_point_indices())
                        add(values.quadrature_point(q), values.JxW(q));
                    }
          };
        integrate([&](const Tensor<1, dim> &place, const double weight) {
          area += weight;
          middle += weight * place;
        });
        area   = Utilities::MPI::sum(area, body.communicator);
        middle = Utilities::MPI::sum(middle, body.communicator) / area;
        integrate([&](const Tensor<1, dim> &place, const double weight) {
          const Tensor<1, 3> r = in_three_dimensions(place - middle);
          second += weight *
            (r.norm_square() * Tensor<2, 3>(unit_symmetric_tensor<3>()) -
             outer_product(r, r));
        });
        second = Utilities::MPI::sum(second, body.communicator);
      }
    };
  } // namespace



  template <int dim>
  std::function<void(const double, Vector &)>
  resultant_load(const Body<dim> &body, const ResultantLoad<dim> &load)
  {
    if (body.is_vertex(*load.ids.begin()))
      {
        std::array<IndexSet, dim> unknowns;
        for (unsigned int c = 0; c < dim; ++c)
          unknowns[c] = body.boundary_displacements(*load.ids.begin(), c);
        return [unknowns, load](const double time, Vector &forces) {
          const Tensor<1, dim> force = load.force(time);
          for (unsigned int c = 0; c < dim; ++c)
            for (const auto i : unknowns[c])
              forces(i) += force[c];
          forces.compress(VectorOperation::add);
        };
      }
    const Moments<dim> surface(body, load.ids);
    // In 2D the axis is the third one, about which each surface has an extent.
    Tensor<2, 3> inverse;
    if (load.moment && dim == 2)
      inverse[2][2] = 1. / surface.second[2][2];
    else if (load.moment)
      {
        if (determinant(surface.second) <=
            1e-10 * std::pow(trace(surface.second), 3))
          throw InputError(
            "A moment needs a surface that has an extent across each axis.");
        inverse = invert(surface.second);
      }
    std::vector<std::function<void(const double, Vector &)>> terms;
    for (const auto id : load.ids)
      terms.push_back(boundary_load<dim>(
        body,
        id,
        [load, surface, inverse](const double time, const Point<dim> &place) {
          Tensor<1, dim> traction;
          if (load.force)
            traction += load.force(time) / surface.area;
          if (load.moment)
            {
              const Tensor<1, 3> turning =
                cross_product_3d(inverse * load.moment(time),
                                 in_three_dimensions(place - surface.middle));
              for (unsigned int c = 0; c < dim; ++c)
                traction[c] += turning[c];
            }
          return traction;
        }));
    return [terms](const double time, Vector &forces) {
      for (const auto &term : terms)
        term(time, forces);
    };
  }


  template std::function<void(const double, Vector &)>
  resultant_load(const Body<1> &, const ResultantLoad<1> &);
  template std::function<void(const double, Vector &)>
  resultant_load(const Body<2> &, const ResultantLoad<2> &);
  template std::function<void(const double, Vector &)>
  resultant_load(const Body<3> &, const ResultantLoad<3> &);
} // namespace Ricochet
