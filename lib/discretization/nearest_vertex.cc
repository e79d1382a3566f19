// SPDX-License-Identifier: LGPL-2.1-or-later
#include <discretization/nearest_vertex.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  bool
  is_nearer(const Point<dim> &a, const Point<dim> &b, const Point<dim> &point)
  {
    constexpr double as_near = 1e-9;
    const double     of_a = a.distance(point), of_b = b.distance(point);
    const double     size =
      std::max({of_a, of_b, a.norm(), b.norm(), point.norm()});
    if (std::abs(of_a - of_b) > as_near * size)
      return of_a < of_b;
    for (unsigned int c = 0; c < dim; ++c)
      if (std::abs(a[c] - b[c]) > as_near * size)
        return a[c] < b[c];
    return false;
  }



  template <int dim>
  std::vector<types::global_dof_index>
  unknowns_of_nearest_vertex(const Body<dim>   &body,
                             const Point<dim>  &point,
                             const unsigned int n_parts,
                             const unsigned int begin,
                             const unsigned int end)
  {
    std::optional<Point<dim>>            nearest;
    std::vector<types::global_dof_index> candidate(dim);
    for (const auto &cell : body.dof_handler().active_cell_iterators())
      {
        if (cell->is_artificial() || body.part(cell, n_parts) < begin ||
            body.part(cell, n_parts) >= end)
          continue;
        for (const unsigned int v : cell->vertex_indices())
          {
            if (nearest && !is_nearer(cell->vertex(v), *nearest, point))
              continue;
            nearest = cell->vertex(v);
            for (unsigned int c = 0; c < dim; ++c)
              candidate[c] = body.system_index(
                cell->vertex_dof_index(v, c, cell->active_fe_index()));
          }
      }
    // The node belongs to the lowest rank that sees the nearest vertex and owns
    // its unknowns.
    std::optional<Point<dim>> of_all;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(body.communicator,
                                    nearest ? std::vector<Point<dim>>{*nearest}
                                            : std::vector<Point<dim>>()))
      for (const Point<dim> &vertex : of_rank)
        if (!of_all || is_nearer(vertex, *of_all, point))
          of_all = vertex;
    const bool mine = nearest && *nearest == *of_all &&
      body.owned_indices().is_element(candidate[0]);
    const unsigned int rank =
      Utilities::MPI::this_mpi_process(body.communicator);
    const unsigned int owner =
      Utilities::MPI::min(mine ? rank
                               : std::numeric_limits<unsigned int>::max(),
                          body.communicator);
    AssertThrow(owner != std::numeric_limits<unsigned int>::max(),
                ExcMessage("No rank owns the nearest vertex."));
    return owner == rank ? candidate : std::vector<types::global_dof_index>();
  }


  template bool
  is_nearer(const Point<1> &, const Point<1> &, const Point<1> &);
  template std::vector<types::global_dof_index>
  unknowns_of_nearest_vertex(const Body<1> &,
                             const Point<1> &,
                             const unsigned int,
                             const unsigned int,
                             const unsigned int);
  template bool
  is_nearer(const Point<2> &, const Point<2> &, const Point<2> &);
  template std::vector<types::global_dof_index>
  unknowns_of_nearest_vertex(const Body<2> &,
                             const Point<2> &,
                             const unsigned int,
                             const unsigned int,
                             const unsigned int);
  template bool
  is_nearer(const Point<3> &, const Point<3> &, const Point<3> &);
  template std::vector<types::global_dof_index>
  unknowns_of_nearest_vertex(const Body<3> &,
                             const Point<3> &,
                             const unsigned int,
                             const unsigned int,
                             const unsigned int);
} // namespace Ricochet
