// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <problems/torus_mesh.h>

#include <array>
#include <cmath>
#include <string>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    void
    check(const HollowTorus &torus)
    {
      if (!(torus.wall > 0. && torus.tube_radius > torus.wall))
        throw InputError(
          "The wall of a hollow torus is thinner than the radius of "
          "its tube, and has a thickness.");
      if (!(torus.ring_radius > torus.tube_radius))
        throw InputError(
          "The ring of a hollow torus has a hole: its radius, to the "
          "middle of the tube, is larger than that of the tube.");
      if (!(torus.axis.norm() > 0.))
        throw InputError("The axis of a torus needs a length.");
      if (torus.n_around_ring < 4 || torus.n_around_tube < 4 ||
          torus.n_across_wall < 1)
        throw InputError(
          "A hollow torus needs at least 4 cells around its ring and "
          "its tube and 1 across its wall.");
    }

    /// Two directions across @p axis and its own, right-handed.
    std::array<Tensor<1, 3>, 3>
    frame_of(const Tensor<1, 3> &axis)
    {
      std::array<Tensor<1, 3>, 3> frame;
      frame[2] = axis / axis.norm();
      // x where that is possible.
      frame[0][std::abs(frame[2][0]) > .9 ? 1 : 0] = 1.;
      frame[0] -= (frame[0] * frame[2]) * frame[2];
      frame[0] /= frame[0].norm();
      frame[1] = cross_product_3d(frame[2], frame[0]);
      return frame;
    }
  } // namespace



  void
  make_hollow_torus(const HollowTorus &torus, Triangulation<3> &triangulation)
  {
    check(torus);
    const auto         frame  = frame_of(torus.axis);
    const unsigned int n_ring = torus.n_around_ring,
                       n_tube = torus.n_around_tube,
                       n_wall = torus.n_across_wall;

    std::vector<Point<3>> vertices;
    for (unsigned int a = 0; a <= n_wall; ++a)
      for (unsigned int r = 0; r < n_ring; ++r)
        for (unsigned int t = 0; t < n_tube; ++t)
          {
            const double radius =
              torus.tube_radius - torus.wall * (n_wall - a) / n_wall;
            const double around_ring = 2. * numbers::PI * r / n_ring,
                         around_tube = 2. * numbers::PI * t / n_tube;
            const double from_axis =
              torus.ring_radius + radius * std::cos(around_tube);
            vertices.push_back(torus.centre +
                               from_axis * std::cos(around_ring) * frame[0] +
                               from_axis * std::sin(around_ring) * frame[1] +
                               radius * std::sin(around_tube) * frame[2]);
          }
    const auto vertex =
      [&](const unsigned int a, const unsigned int r, const unsigned int t) {
        return (a * n_ring + r % n_ring) * n_tube + t % n_tube;
      };
    std::vector<CellData<3>> cells;
    SubCellData              faces;
    const auto               add_face = [&](const unsigned int       a,
                              const unsigned int       r,
                              const unsigned int       t,
                              const types::boundary_id id) {
      CellData<2> face(4);
      face.vertices    = {vertex(a, r, t),
                          vertex(a, r + 1, t),
                          vertex(a, r, t + 1),
                          vertex(a, r + 1, t + 1)};
      face.boundary_id = id;
      faces.boundary_quads.push_back(face);
    };
    for (unsigned int r = 0; r < n_ring; ++r)
      for (unsigned int t = 0; t < n_tube; ++t)
        {
          for (unsigned int a = 0; a < n_wall; ++a)
            {
              // Outwards, around the ring, around the tube: right-handed.
              CellData<3> cell(8);
              for (unsigned int v = 0; v < 8; ++v)
                cell.vertices[v] = vertex(a + v % 2, r + v / 2 % 2, t + v / 4);
              cells.push_back(cell);
            }
          add_face(0, r, t, TorusBoundary::inside);
          add_face(n_wall, r, t, TorusBoundary::outside);
        }
    triangulation.create_triangulation(vertices, cells, faces);
  }
} // namespace Ricochet
