// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <contact/kinematics/mortar_triangles.h>
#include <contact/surfaces/clipped_triangle.h>
#include <contact/surfaces/closest_point.h>
#include <contact/surfaces/facet_search.h>

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Pieces smaller than this part of a triangle are round-off.
    constexpr double smallest_piece = 1e-12;

    /// The farthest distance from the master at which triangles are cut: two of
    /// their lengths.
    double
    reach_of_triangle(const double parallelogram)
    {
      return 2. * std::sqrt(parallelogram);
    }

    /// Triangles with a larger angle between them do not face each other: the
    /// projection of one on the other is unrelated to where they touch.
    constexpr double smallest_cosine = .2;

    constexpr unsigned int no_place = numbers::invalid_unsigned_int;
  } // namespace



  MortarTriangles::MortarTriangles(const Body<3>     &body,
                                   const ContactPair &pair,
                                   const MortarShape  shape)
    : SurfacePair<3>(body, pair)
    , shape(shape)
  {
    // The facets between the nodes of degree 2 have weights for a uniform pressure
    // other than those of the displacements.
    AssertThrow(!is_self && body.dof_handler().get_fe().degree == 1,
                ExcInternalError());
    make_nodal_points(body);
    gaps.resize(own_points.size());
    all_rows.resize(own_points.size());
    up_to_date.resize(own_points.size());
    softnesses.resize(own_points.size());
    supports.resize(own_points.size());
    slave_places.resize(slave.nodes.size(), no_place);
    master_places.resize(master.nodes.size(), no_place);

    std::map<unsigned int, unsigned int> point_of_node;
    for (unsigned int p = 0; p < own_points.size(); ++p)
      point_of_node[own_points[p].nodes[0].first] = p;
    // Triangles around one mean node belong to one face.
    std::map<unsigned int, unsigned int> face_of_mean;
    for (unsigned int f = 0; f < slave.facets.size(); ++f)
      {
        std::vector<unsigned int> nodes;
        const unsigned int       *mean = nullptr;
        for (const unsigned int &n : slave.facets[f].nodes)
          if (!slave.nodes[n].mean_of.empty())
            mean = &n;
        for (const unsigned int n : slave.facets[f].nodes)
          if (!mean)
            nodes.push_back(n);
        if (mean)
          nodes = slave.nodes[*mean].mean_of;
        if (std::none_of(nodes.begin(), nodes.end(), [&](const unsigned int n) {
              return point_of_node.count(n) > 0;
            }))
          continue;
        const auto [known, is_new] = mean
          ? face_of_mean.emplace(*mean, faces.size())
          : std::pair(face_of_mean.end(), true);
        if (!is_new)
          {
            faces[known->second].triangles.push_back(f);
            continue;
          }
        for (unsigned int k = 0; k < nodes.size(); ++k)
          if (const auto p = point_of_node.find(nodes[k]);
              p != point_of_node.end())
            supports[p->second].push_back(
              {static_cast<unsigned int>(faces.size()), k});
        faces.emplace_back();
        faces.back().triangles = {f};
        faces.back().nodes     = nodes;
      }
    if (shape == MortarShape::dual)
      for (Face &face : faces)
        make_dual_coefficients(face);
  }



  double
  MortarTriangles::shape_value(const Face                  &face,
                               const unsigned int           k,
                               const unsigned int           triangle,
                               const std::array<double, 3> &shares) const
  {
    double sum = 0.;
    for (unsigned int v = 0; v < 3; ++v)
      slave.for_each_node_of(slave.facets[triangle].nodes[v],
                             [&](const unsigned int n, const double factor) {
                               if (n == face.nodes[k])
                                 sum += shares[v] * factor;
                             });
    return sum;
  }



  void
  MortarTriangles::make_dual_coefficients(Face &face) const
  {
    // int psi_j N_k = 0 for j != k, int psi_j N_j = int N_j: the integrals of the shape
    // functions times the inverse of those of their products. The quadrature points are
    // the midpoints of the edges.
    const unsigned int  n = face.nodes.size();
    FullMatrix<double>  products(n, n);
    std::vector<double> integrals(n, 0.);
    for (const unsigned int f : face.triangles)
      for (unsigned int v = 0; v < 3; ++v)
        {
          std::array<double, 3> shares = {{.5, .5, .5}};
          shares[v]                    = 0.;
          const double weight          = slave.facets[f].measure / 3.;
          for (unsigned int j = 0; j < n; ++j)
            {
              const double value = shape_value(face, j, f, shares);
              integrals[j] += weight * value;
              for (unsigned int k = 0; k < n; ++k)
                products(j, k) +=
                  weight * value * shape_value(face, k, f, shares);
            }
        }
    products.gauss_jordan();
    face.dual_coefficients.resize(n * n);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int k = 0; k < n; ++k)
        face.dual_coefficients[j * n + k] = integrals[j] * products(j, k);
  }



  double
  MortarTriangles::psi(const Face        &face,
                       const unsigned int j,
                       const PiecePoint  &point) const
  {
    if (shape == MortarShape::standard || !face.is_covered)
      return shape_value(face, j, point.triangle, point.shares);
    double             sum = 0.;
    const unsigned int n   = face.nodes.size();
    for (unsigned int k = 0; k < n; ++k)
      sum += face.dual_coefficients[j * n + k] *
        shape_value(face, k, point.triangle, point.shares);
    return sum;
  }



  void
  MortarTriangles::cut(Face                 &face,
                       const Positions      &positions,
                       const FacetSearch<3> &search) const
  {
    struct Piece
    {
      unsigned int    opposite;
      double          distance;
      ClippedTriangle polygon;
    };
    static thread_local std::vector<Piece> pieces;
    face.n_points   = 0;
    face.is_covered = true;
    for (const unsigned int f : face.triangles)
      {
        pieces.clear();
        const auto                 &own = slave.facets[f];
        std::array<Tensor<1, 3>, 3> x;
        for (unsigned int v = 0; v < 3; ++v)
          x[v] = to_tensor(positions.slave[own.nodes[v]]);
        const Tensor<1, 3> e1 = x[1] - x[0], e2 = x[2] - x[0];
        const Tensor<1, 3> normal_of_own = cross_product_3d(e1, e2);
        const double       square        = normal_of_own.norm_square();
        const double farthest = reach_of_triangle(normal_of_own.norm()) + way;
        Position     lower, upper;
        for (unsigned int c = 0; c < 3; ++c)
          {
            lower[c] = std::min({x[0][c], x[1][c], x[2][c]}) - farthest;
            upper[c] = std::max({x[0][c], x[1][c], x[2][c]}) + farthest;
          }
        double covered = 0.;
        for (const unsigned int opposite : search.near(lower, upper))
          {
            const auto        &other = master.facets[opposite];
            const Tensor<1, 3> normal =
              to_tensor(facet_normal<3>(master, positions.master, opposite));
            const double cosine =
              -(normal * normal_of_own) / (normal.norm() * std::sqrt(square));
            if (!(cosine > smallest_cosine))
              continue;
            // Projection along the normal of the slave on its plane.
            std::array<ClippedTriangle::Point, 3> projected;
            for (unsigned int v = 0; v < 3; ++v)
              {
                const Tensor<1, 3> r =
                  to_tensor(positions.master[other.nodes[v]]) - x[0];
                projected[v] = {
                  {cross_product_3d(r, e2) * normal_of_own / square,
                   cross_product_3d(e1, r) * normal_of_own / square}};
              }
            const ClippedTriangle polygon(projected);
            if (!(polygon.area() > smallest_piece))
              continue;
            const auto        &middle = polygon.middle();
            const Tensor<1, 3> y      = x[0] + middle[0] * e1 + middle[1] * e2;
            const double       gap    = normal *
              (y - to_tensor(positions.master[other.nodes[0]])) / normal.norm();
            // Contact does not reach through a body.
            if (gap / cosine > farthest || gap < -std::sqrt(other.measure))
              continue;
            pieces.push_back({opposite, std::abs(gap), polygon});
            covered += polygon.area();
          }
        // The closest one, where several layers of the master face the slave.
        if (covered > .5 * (1. + 1e-9))
          {
            std::stable_sort(pieces.begin(),
                             pieces.end(),
                             [](const Piece &a, const Piece &b) {
                               return a.distance < b.distance;
                             });
            std::size_t n_kept = 0;
            covered            = 0.;
            for (std::size_t k = 0; k < pieces.size(); ++k)
              if (std::none_of(pieces.begin(),
                               pieces.begin() + n_kept,
                               [&](const Piece &closer) {
                                 return closer.polygon.contains(
                                   pieces[k].polygon.middle());
                               }))
                {
                  covered += pieces[k].polygon.area();
                  pieces[n_kept++] = pieces[k];
                }
            pieces.erase(pieces.begin() + n_kept, pieces.end());
          }
        face.is_covered = face.is_covered && covered > .5 * (1. - 1e-6);

        for (const Piece &piece : pieces)
          for (const auto &place : piece.polygon.quadrature_points())
            {
              if (face.n_points == face.points.size())
                face.points.emplace_back();
              PiecePoint &point = face.points[face.n_points++];
              point.triangle    = f;
              point.opposite    = piece.opposite;
              point.shares = {{1. - place[0] - place[1], place[0], place[1]}};
              point.weight = 2. / 3. * piece.polygon.area() * own.measure;
              point.up_to_date = point.differentiated = false;
            }
      }
  }



  MortarTriangles::Corners
  MortarTriangles::corners(const PiecePoint &point,
                           const Positions  &positions) const
  {
    Corners     x{};
    const auto &own   = slave.facets[point.triangle].nodes;
    const auto &other = master.facets[point.opposite].nodes;
    for (unsigned int v = 0; v < 3; ++v)
      {
        for (unsigned int c = 0; c < 3; ++c)
          x[0][c] += point.shares[v] * positions.slave[own[v]][c];
        x[1 + v] = positions.master[other[v]];
      }
    return x;
  }



  double
  MortarTriangles::mean_gap(const unsigned int p,
                            const Positions   &positions) const
  {
    double sum = 0.;
    for (const Support &support : supports[p])
      {
        const Face &face = faces[support.face];
        for (unsigned int q = 0; q < face.n_points; ++q)
          sum += face.points[q].weight *
            psi(face, support.node, face.points[q]) *
            PointBeforeTriangle<double>::gap(
                   corners(face.points[q], positions));
      }
    return sum / own_points[p].weight;
  }



  double
  MortarTriangles::reach_of_step(const Course &course) const
  {
    double largest = 0.;
    for (const Face &face : faces)
      for (const unsigned int f : face.triangles)
        largest = std::max(
          largest,
          to_tensor(facet_normal<3>(slave, course.middle.slave, f)).norm());
    return reach_of_triangle(Utilities::MPI::max(largest, communicator)) +
      longest_way(course.begin, course.middle);
  }



  void
  MortarTriangles::begin_step(const ContactStart &start)
  {
    Course course;
    begin_course(start, course);
    way                         = longest_way(course.begin, course.middle);
    old_positions               = std::move(course.begin);
    new_positions               = old_positions;
    const Positions     &middle = course.middle;
    const FacetSearch<3> search(master, middle.master, near_facets);
    for (Face &face : faces)
      cut(face, middle, search);

    for (unsigned int p = 0; p < own_points.size(); ++p)
      {
        Gaps &gap     = gaps[p];
        up_to_date[p] = false;
        // The part of the weight that faces the master, and the sum of moduli there.
        double part = 0., size = 0.;
        for (const Support &support : supports[p])
          {
            const Face &face = faces[support.face];
            for (unsigned int q = 0; q < face.n_points; ++q)
              {
                const double share = face.points[q].weight *
                  psi(face, support.node, face.points[q]) /
                  own_points[p].weight;
                part += share;
                size += std::abs(share);
              }
          }
        softnesses[p]       = 1e-11 * size * size * std::abs(1. - part);
        gap.is_before_facet = this->may_touch(own_points[p]) && part > 1e-6;
        if (!gap.is_before_facet)
          continue;
        gap.old_gap = gap.new_gap = mean_gap(p, old_positions);
        gap.predicted_gap         = mean_gap(p, middle);
      }
  }



  void
  MortarTriangles::evaluate(const Vector &solution)
  {
    read(solution, new_positions);
    for (Face &face : faces)
      for (unsigned int q = 0; q < face.n_points; ++q)
        face.points[q].up_to_date = face.points[q].differentiated = false;
    for (unsigned int p = 0; p < own_points.size(); ++p)
      if (gaps[p].is_before_facet)
        {
          up_to_date[p]   = false;
          gaps[p].new_gap = mean_gap(p, new_positions);
        }
  }



  const PointBeforeTriangle<double>::Rows &
  MortarTriangles::rows_of(PiecePoint &point) const
  {
    if (!point.up_to_date)
      {
        point.up_to_date = true;
        PointBeforeTriangle<double>::evaluate(corners(point, old_positions),
                                              corners(point, new_positions),
                                              point.rows);
      }
    return point.rows;
  }



  const std::vector<double> &
  MortarTriangles::derivatives_of(PiecePoint &point) const
  {
    if (point.differentiated)
      return point.derivatives;
    point.differentiated = true;
    const Corners now    = corners(point, new_positions);
    PointBeforeTriangle<double>::Points<Differentiable> x;
    for (unsigned int v = 0; v < 4; ++v)
      for (unsigned int c = 0; c < 3; ++c)
        x[v][c] = Differentiable(n_coordinates, 3 * v + c, now[v][c]);
    PointBeforeTriangle<Differentiable>::Rows all;
    PointBeforeTriangle<Differentiable>::evaluate(corners(point, old_positions),
                                                  x,
                                                  all);
    point.derivatives.clear();
    const auto add = [&](const Differentiable &value) {
      for (unsigned int i = 0; i < n_coordinates; ++i)
        point.derivatives.push_back(value.dx(i));
    };
    add(all.new_gap);
    for (unsigned int d = 0; d < n_tangents; ++d)
      add(all.slip[d]);
    for (const Differentiable &entry : all.normal)
      add(entry);
    for (unsigned int d = 0; d < n_tangents; ++d)
      for (const Differentiable &entry : all.tangential[d])
        add(entry);
    return point.derivatives;
  }



  unsigned int
  MortarTriangles::place_of(const ContactSurface<3>::Node &node,
                            const unsigned int             number,
                            std::vector<unsigned int>     &places,
                            Rows                          &rows)
  {
    unsigned int &place = places[number];
    if (place != no_place)
      return place;
    // A node on the edge of both surfaces enters the rows once.
    place =
      std::find(rows.unknowns.begin(), rows.unknowns.end(), node.unknowns[0]) -
      rows.unknowns.begin();
    if (place == rows.unknowns.size())
      {
        rows.unknowns.insert(rows.unknowns.end(),
                             node.unknowns.begin(),
                             node.unknowns.end());
        rows.normal.resize(rows.unknowns.size(), 0.);
        for (auto &row : rows.tangential)
          row.resize(rows.unknowns.size(), 0.);
      }
    return place;
  }



  template <typename Function>
  void
  MortarTriangles::for_each_unknown(const PiecePoint &point,
                                    Rows             &rows,
                                    const Function   &add) const
  {
    for (unsigned int v = 0; v < 3; ++v)
      {
        slave.for_each_node_of(slave.facets[point.triangle].nodes[v],
                               [&](const unsigned int n, const double factor) {
                                 const unsigned int place =
                                   place_of(slave.nodes[n],
                                            n,
                                            slave_places,
                                            rows);
                                 for (unsigned int c = 0; c < 3; ++c)
                                   add(place + c, c, point.shares[v] * factor);
                               });
        master.for_each_node_of(master.facets[point.opposite].nodes[v],
                                [&](const unsigned int n, const double factor) {
                                  const unsigned int place =
                                    place_of(master.nodes[n],
                                             n,
                                             master_places,
                                             rows);
                                  for (unsigned int c = 0; c < 3; ++c)
                                    add(place + c, 3 * (v + 1) + c, factor);
                                });
      }
  }



  void
  MortarTriangles::forget_places(const unsigned int p) const
  {
    for (const Support &support : supports[p])
      {
        const Face &face = faces[support.face];
        for (const unsigned int n : face.nodes)
          slave_places[n] = no_place;
        for (unsigned int q = 0; q < face.n_points; ++q)
          for (const unsigned int corner :
               master.facets[face.points[q].opposite].nodes)
            master.for_each_node_of(corner,
                                    [&](const unsigned int n, const double) {
                                      master_places[n] = no_place;
                                    });
      }
  }



  const SurfacePair<3>::Rows &
  MortarTriangles::rows(const unsigned int p) const
  {
    Rows &rows = all_rows[p];
    if (up_to_date[p])
      return rows;
    up_to_date[p] = true;
    rows.unknowns.clear();
    rows.normal.clear();
    for (auto &row : rows.tangential)
      row.clear();
    rows.gap_increment        = 0.;
    rows.slip                 = Tangential();
    rows.direction            = {};
    const unsigned int number = own_points[p].nodes[0].first;
    place_of(slave.nodes[number], number, slave_places, rows);
    for (const Support &support : supports[p])
      {
        Face &face = faces[support.face];
        for (unsigned int q = 0; q < face.n_points; ++q)
          {
            PiecePoint  &point  = face.points[q];
            const auto  &own    = rows_of(point);
            const double factor = point.weight / own_points[p].weight *
              psi(face, support.node, point);
            rows.gap_increment += factor * own.gap_increment;
            for (unsigned int d = 0; d < n_tangents; ++d)
              rows.slip[d] += factor * own.slip[d];
            for_each_unknown(point,
                             rows,
                             [&](const unsigned int place,
                                 const unsigned int coordinate,
                                 const double       share) {
                               rows.normal[place] +=
                                 factor * share * own.normal[coordinate];
                               for (unsigned int d = 0; d < n_tangents; ++d)
                                 rows.tangential[d][place] += factor * share *
                                   own.tangential[d][coordinate];
                             });
            const double part = point.weight *
              shape_value(face, support.node, point.triangle, point.shares);
            for (unsigned int c = 0; c < 3; ++c)
              rows.direction[c] += part * own.normal[c];
          }
      }
    forget_places(p);
    const double length = to_tensor(rows.direction).norm();
    for (double &component : rows.direction)
      component /= length;
    return rows;
  }



  const SurfacePair<3>::Derivatives &
  MortarTriangles::derivatives(const unsigned int  p,
                               const Coefficients &coefficients,
                               const Caution /*caution*/) const
  {
    rows(p);
    const double       pressure = coefficients.pressure;
    const Tangential  &traction = coefficients.traction;
    Rows              &own      = all_rows[p];
    const unsigned int m        = own.unknowns.size();
    result.gap.assign(m, 0.);
    for (auto &row : result.slip)
      row.assign(m, 0.);
    result.forces.assign(m * m, 0.);
    std::array<double, n_coordinates * n_coordinates> force;
    const bool is_pushed = pressure != 0. || traction.norm_square() > 0.;
    for (const Support &support : supports[p])
      {
        Face &face = faces[support.face];
        for (unsigned int q = 0; q < face.n_points; ++q)
          {
            PiecePoint                &point       = face.points[q];
            const std::vector<double> &derivatives = derivatives_of(point);
            places.clear();
            coordinates.clear();
            factors.clear();
            for_each_unknown(point,
                             own,
                             [&](const unsigned int place,
                                 const unsigned int coordinate,
                                 const double       share) {
                               places.push_back(place);
                               coordinates.push_back(coordinate);
                               factors.push_back(share);
                             });
            const double factor = point.weight / own_points[p].weight *
              psi(face, support.node, point);
            for (unsigned int a = 0; a < places.size(); ++a)
              {
                const unsigned int i     = coordinates[a];
                const double       share = factor * factors[a];
                result.gap[places[a]] += share * derivatives[i];
                for (unsigned int d = 0; d < n_tangents; ++d)
                  result.slip[d][places[a]] +=
                    share * derivatives[(1 + d) * n_coordinates + i];
              }
            if (!is_pushed)
              continue;
            // The force along the rows, with its derivatives.
            constexpr unsigned int of_normal = (1 + n_tangents) * n_coordinates,
                                   size      = n_coordinates * n_coordinates;
            for (unsigned int k = 0; k < size; ++k)
              {
                force[k] = -factor * pressure * derivatives[of_normal + k];
                for (unsigned int d = 0; d < n_tangents; ++d)
                  force[k] += factor * traction[d] *
                    derivatives[of_normal + (1 + d) * size + k];
              }
            for (unsigned int a = 0; a < places.size(); ++a)
              for (unsigned int b = 0; b < places.size(); ++b)
                result.forces[places[a] * m + places[b]] += factors[a] *
                  factors[b] *
                  force[coordinates[a] * n_coordinates + coordinates[b]];
          }
      }
    forget_places(p);
    return result;
  }



  std::vector<SurfacePair<3>::Index>
  MortarTriangles::unknowns_nearby(const unsigned int p) const
  {
    std::vector<Index> indices = rows(p).unknowns;
    for (const Index index : own_points[p].multipliers)
      if (index != numbers::invalid_dof_index)
        indices.push_back(index);
    std::sort(indices.begin(), indices.end());
    return indices;
  }



  double
  MortarTriangles::round_off(const unsigned int p) const
  {
    double             size = 0.;
    const unsigned int n    = own_points[p].nodes[0].first;
    for (unsigned int c = 0; c < 3; ++c)
      size += 2. * std::abs(new_positions.slave[n][c]) +
        std::abs(slave.nodes[n].reference_position[c]);
    return 2. * std::numeric_limits<double>::epsilon() * size;
  }
} // namespace Ricochet
