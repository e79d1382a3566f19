// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_tests_unit_meshes_h
#define ricochet_tests_unit_meshes_h

#include <contact/obstacles/half_space.h>
#include <contact/kinematics/contact_points.h>

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/grid/grid_generator.h>

#include <random>
#include <vector>

/// A unit cube above the plane x_dim = -gap, with the boundary id 1 on the face
/// towards the plane and 2 on the opposite one. In parallel every rank owns a
/// part.
template <int dim>
struct CubeAbovePlane
{
  explicit CubeAbovePlane(const bool         simplices,
                          const unsigned int n_cells_per_edge = 2)
    : triangulation(MPI_COMM_WORLD)
  {
    if (simplices)
      dealii::GridGenerator::subdivided_hyper_cube_with_simplices(
        triangulation,
        n_cells_per_edge);
    else
      dealii::GridGenerator::subdivided_hyper_cube(triangulation,
                                                   n_cells_per_edge);
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          {
            const double height = face->center()[dim - 1];
            face->set_boundary_id(height < 1e-9          ? 1
                                    : height > 1. - 1e-9 ? 2
                                                         : 0);
          }
  }

  Ricochet::Obstacles
  plane(const double gap) const
  {
    dealii::Point<dim> point;
    point[dim - 1] = -gap;
    dealii::Tensor<1, dim> normal;
    normal[dim - 1] = 1.;
    return {{1, Ricochet::half_space_at_rest<dim>(point, normal)}};
  }

  dealii::parallel::shared::Triangulation<dim> triangulation;
};

/// With assertions every third of @p all, which take several times as long
/// then: each kind is covered by any of them. Without, all of them.
template <typename T>
std::vector<T>
fewer_in_debug(const std::vector<T> &all)
{
#ifdef DEBUG
  std::vector<T> some;
  for (std::size_t k = 0; k < all.size(); k += 3)
    some.push_back(all[k]);
  return some;
#else
  return all;
#endif
}

/// Fill the owned entries with numbers that depend on the index only, so that
/// they are the same on any number of ranks.
inline void
randomise(Ricochet::Vector &vector, const double size, const unsigned int seed)
{
  for (const auto i : vector.locally_owned_elements())
    {
      std::mt19937 generator(7919 * seed + static_cast<unsigned int>(i));
      vector(i) =
        size * std::uniform_real_distribution<double>(-1., 1.)(generator);
    }
  vector.compress(dealii::VectorOperation::insert);
}

#endif
