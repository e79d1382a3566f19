// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/surfaces/closest_point.h>
#include <contact/surfaces/facet_search.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  struct FacetSearch<dim>::Tree
  {
    using Entry = std::pair<BoundingBox<dim>, unsigned int>;
    RTree<Entry> boxes;
    /// Of all facets.
    Point<dim> lower, upper;
  };



  template <int dim>
  std::array<double, dim>
  facet_normal(const ContactSurface<dim>                  &surface,
               const std::vector<std::array<double, dim>> &positions,
               const unsigned int                          f)
  {
    const auto &facet = surface.facets[f];
    if constexpr (dim == 1)
      return {{facet.normal[0]}};
    else if constexpr (dim == 3)
      {
        const auto &a = positions[facet.nodes[0]],
                   &b = positions[facet.nodes[1]],
                   &c = positions[facet.nodes[2]];
        std::array<double, dim> normal;
        for (unsigned int i = 0; i < dim; ++i)
          {
            const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
            normal[i] =
              (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
          }
        return normal;
      }
    else
      {
        const auto &a = positions[facet.nodes[0]];
        const auto &b = positions[facet.nodes[1]];
        return {{a[1] - b[1], b[0] - a[0]}};
      }
  }



  namespace
  {
    std::vector<unsigned int>
    all_up_to(const unsigned int n)
    {
      std::vector<unsigned int> numbers(n);
      std::iota(numbers.begin(), numbers.end(), 0);
      return numbers;
    }
  } // namespace



  template <int dim>
  FacetSearch<dim>::FacetSearch(
    const ContactSurface<dim>                  &surface,
    const std::vector<std::array<double, dim>> &positions)
    : FacetSearch(surface, positions, all_up_to(surface.facets.size()))
  {}



  template <int dim>
  FacetSearch<dim>::FacetSearch(
    const ContactSurface<dim>                  &surface,
    const std::vector<std::array<double, dim>> &positions,
    const std::vector<unsigned int>            &facets)
    : surface(surface)
    , positions(positions)
    , tree(std::make_unique<Tree>())
  {
    if (facets.empty())
      return;
    std::vector<typename Tree::Entry> entries;
    for (const unsigned int f : facets)
      {
        std::vector<Point<dim>> corners;
        for (const unsigned int node : surface.facets[f].nodes)
          {
            Point<dim> corner;
            for (unsigned int c = 0; c < dim; ++c)
              corner[c] = positions[node][c];
            corners.push_back(corner);
          }
        entries.emplace_back(BoundingBox<dim>(corners), f);
      }
    BoundingBox<dim> all = entries.front().first;
    for (const auto &entry : entries)
      all.merge_with(entry.first);
    tree->lower = all.get_boundary_points().first;
    tree->upper = all.get_boundary_points().second;
    tree->boxes = pack_rtree(entries);
  }



  template <int dim>
  FacetSearch<dim>::~FacetSearch() = default;



  namespace
  {
    template <int dim>
    double
    dot(const std::array<double, dim> &a, const std::array<double, dim> &b)
    {
      double sum = 0.;
      for (unsigned int c = 0; c < dim; ++c)
        sum += a[c] * b[c];
      return sum;
    }

    template <int dim>
    double
    squared_distance(const ContactSurface<dim>                  &surface,
                     const std::vector<std::array<double, dim>> &positions,
                     const unsigned int                          f,
                     const std::array<double, dim>              &y)
    {
      std::array<double, dim> r = y;
      const auto             &a = positions[surface.facets[f].nodes[0]];
      for (unsigned int c = 0; c < dim; ++c)
        r[c] -= a[c];
      if constexpr (dim == 2)
        {
          std::array<double, dim> e = positions[surface.facets[f].nodes[1]];
          for (unsigned int c = 0; c < dim; ++c)
            e[c] -= a[c];
          const double along =
            std::clamp(dot<dim>(e, r) / dot<dim>(e, e), 0., 1.);
          for (unsigned int c = 0; c < dim; ++c)
            r[c] -= along * e[c];
        }
      if constexpr (dim == 3)
        {
          std::array<Tensor<1, 3>, 3> corners;
          for (unsigned int v = 0; v < 3; ++v)
            corners[v] = to_tensor(positions[surface.facets[f].nodes[v]]);
          const Tensor<1, 3> point = to_tensor(y);
          const auto         shares =
            closest_in_triangle(point, corners[0], corners[1], corners[2]);
          Tensor<1, 3> distance = point;
          for (unsigned int v = 0; v < 3; ++v)
            distance -= shares[v] * corners[v];
          return distance.norm_square();
        }
      return dot<dim>(r, r);
    }

    /// Of either side.
    template <int dim>
    double
    distance_from_plane(const ContactSurface<dim>                  &surface,
                        const std::vector<std::array<double, dim>> &positions,
                        const unsigned int                          f,
                        const std::array<double, dim>              &y)
    {
      const auto  normal = facet_normal<dim>(surface, positions, f);
      const auto &a      = positions[surface.facets[f].nodes[0]];
      return std::abs(dot<dim>(normal, y) - dot<dim>(normal, a)) /
        std::sqrt(dot<dim>(normal, normal));
    }

    /// Whether its outward normal points against @p normal.
    template <int dim>
    bool
    faces(const ContactSurface<dim>                  &surface,
          const std::vector<std::array<double, dim>> &positions,
          const unsigned int                          f,
          const std::array<double, dim>              &normal)
    {
      return dot<dim>(facet_normal<dim>(surface, positions, f), normal) < 0.;
    }

    /// The closest facet of those that it is told of.
    template <int dim>
    struct Closest
    {
      /// @param accept is only asked of what would be the closest.
      template <typename Accept>
      void
      consider(const ContactSurface<dim>                  &surface,
               const std::vector<std::array<double, dim>> &positions,
               const unsigned int                          f,
               const std::array<double, dim>              &y,
               const Accept                               &accept)
      {
        const double distance = squared_distance<dim>(surface, positions, f, y);
        // In space the facets around an edge or a vertex that is closest are equally
        // far, but for round-off, which must not choose. The point is before the one
        // from whose plane it is farthest: behind the planes of others it may be, in
        // front of the body.
        const double equal =
          dim < 3 ? 0. : 1e-9 * smallest + 1e-18 * surface.facets[f].measure;
        if (distance > smallest + equal || !accept(f))
          return;
        const double from_plane =
          dim < 3 ? 0. : distance_from_plane<dim>(surface, positions, f, y);
        const double margin = 1e-6 * std::sqrt(distance);
        if (!best || distance < smallest - equal ||
            from_plane > farthest + margin ||
            (f < *best && from_plane >= farthest - margin))
          {
            smallest = distance;
            best     = f;
            farthest = from_plane;
          }
      }

      std::optional<unsigned int> best;
      /// Square of the distance (m^2).
      double smallest = std::numeric_limits<double>::max();
      double farthest = 0.;
    };
  } // namespace



  template <int dim>
  std::optional<unsigned int>
  FacetSearch<dim>::closest_facing(
    const std::array<double, dim>                   &y,
    const std::array<double, dim>                   &normal,
    const std::function<bool(const unsigned int f)> &accept,
    const double                                     largest_distance) const
  {
    namespace bgi = boost::geometry::index;
    Point<dim> point;
    for (unsigned int c = 0; c < dim; ++c)
      point[c] = y[c];
    // In boxes around y that grow until the closest facet is in them for sure. The first
    // one reaches beyond the nearest facet, the last one holds them all.
    const auto &boxes = tree->boxes;
    const auto  first = boxes.qbegin(bgi::nearest(point, 1));
    if (first == boxes.qend())
      return {};
    double radius = 0., farthest = 0.;
    for (unsigned int c = 0; c < dim; ++c)
      {
        const double lower = first->first.lower_bound(c),
                     upper = first->first.upper_bound(c);
        radius = std::max({radius, lower - y[c], y[c] - upper, upper - lower});
        farthest =
          std::max({farthest, y[c] - tree->lower[c], tree->upper[c] - y[c]});
      }
    farthest = std::min(farthest, largest_distance);
    radius   = std::max(radius, 1e-3 * farthest);
    Closest<dim> closest;
    for (bool is_last = false; !is_last; radius *= 2.)
      {
        is_last          = radius >= farthest;
        radius           = std::min(radius, farthest);
        Point<dim> lower = point, upper = point;
        for (unsigned int c = 0; c < dim; ++c)
          {
            lower[c] -= radius;
            upper[c] += radius;
          }
        closest = {};
        closest.smallest =
          std::min(closest.smallest, largest_distance * largest_distance);
        for (auto entry = boxes.qbegin(
               bgi::intersects(BoundingBox<dim>(std::pair(lower, upper))));
             entry != boxes.qend();
             ++entry)
          if (accept)
            closest.consider(surface, positions, entry->second, y, accept);
          else if (faces<dim>(surface, positions, entry->second, normal))
            closest.consider(surface,
                             positions,
                             entry->second,
                             y,
                             [](const unsigned int) { return true; });
        // What is as far as this one is in the box as well.
        if (closest.best && closest.smallest * (1. + 1e-6) <= radius * radius)
          break;
      }
    return closest.best;
  }



  template <int dim>
  std::optional<unsigned int>
  closest_facing_of(const std::vector<unsigned int>            &facets,
                    const ContactSurface<dim>                  &surface,
                    const std::vector<std::array<double, dim>> &positions,
                    const std::array<double, dim>              &y,
                    const std::array<double, dim>              &normal)
  {
    Closest<dim> closest;
    for (const unsigned int f : facets)
      closest.consider(surface, positions, f, y, [&](const unsigned int other) {
        return faces<dim>(surface, positions, other, normal);
      });
    return closest.best;
  }



  template <int dim>
  std::vector<unsigned int>
  FacetSearch<dim>::near(const std::array<double, dim> &lower,
                         const std::array<double, dim> &upper) const
  {
    std::pair<Point<dim>, Point<dim>> corners;
    for (unsigned int c = 0; c < dim; ++c)
      {
        corners.first[c]  = lower[c];
        corners.second[c] = upper[c];
      }
    std::vector<unsigned int> found;
    for (const auto &entry :
         tree->boxes |
           boost::geometry::index::adaptors::queried(
             boost::geometry::index::intersects(BoundingBox<dim>(corners))))
      found.push_back(entry.second);
    std::sort(found.begin(), found.end());
    return found;
  }


  template class FacetSearch<1>;
  template class FacetSearch<2>;
  template class FacetSearch<3>;
  template std::array<double, 1>
  facet_normal<1>(const ContactSurface<1> &,
                  const std::vector<std::array<double, 1>> &,
                  const unsigned int);
  template std::array<double, 2>
  facet_normal<2>(const ContactSurface<2> &,
                  const std::vector<std::array<double, 2>> &,
                  const unsigned int);
  template std::array<double, 3>
  facet_normal<3>(const ContactSurface<3> &,
                  const std::vector<std::array<double, 3>> &,
                  const unsigned int);
  template std::optional<unsigned int>
  closest_facing_of<3>(const std::vector<unsigned int> &,
                       const ContactSurface<3> &,
                       const std::vector<std::array<double, 3>> &,
                       const std::array<double, 3> &,
                       const std::array<double, 3> &);
} // namespace Ricochet
