// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/surfaces/closest_point.h>
#include <contact/surfaces/facet_search.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace Ricochet
{
  using namespace dealii;

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
    template <int dim>
    double
    dot(const std::array<double, dim> &a, const std::array<double, dim> &b)
    {
      double sum = 0.;
      for (unsigned int c = 0; c < dim; ++c)
        sum += a[c] * b[c];
      return sum;
    }

    /// The smallest box around some vectors.
    template <int dim>
    struct Box
    {
      Box()
      {
        lower.fill(std::numeric_limits<double>::max());
        upper.fill(-std::numeric_limits<double>::max());
      }

      void
      add(const std::array<double, dim> &vector)
      {
        for (unsigned int c = 0; c < dim; ++c)
          {
            lower[c] = std::min(lower[c], vector[c]);
            upper[c] = std::max(upper[c], vector[c]);
          }
      }

      /// Square of the distance of a point from it.
      double
      squared_distance(const std::array<double, dim> &y) const
      {
        double sum = 0.;
        for (unsigned int c = 0; c < dim; ++c)
          {
            const double outside =
              std::max(0., std::max(lower[c] - y[c], y[c] - upper[c]));
            sum += outside * outside;
          }
        return sum;
      }

      double
      square_of_diagonal() const
      {
        double sum = 0.;
        for (unsigned int c = 0; c < dim; ++c)
          sum += (upper[c] - lower[c]) * (upper[c] - lower[c]);
        return sum;
      }

      /// Also if they touch.
      bool
      meets(const Box &other) const
      {
        for (unsigned int c = 0; c < dim; ++c)
          if (!(lower[c] <= other.upper[c] && other.lower[c] <= upper[c]))
            return false;
        return true;
      }

      /// Not more than any product of @p other with a vector in it, round-off included.
      double
      smallest_product(const std::array<double, dim> &other) const
      {
        double sum = 0.;
        for (unsigned int c = 0; c < dim; ++c)
          {
            const double first = lower[c] * other[c],
                         last  = upper[c] * other[c];
            sum += std::min(first, last) -
              1e-14 * std::max(std::abs(first), std::abs(last));
          }
        return sum;
      }

      std::array<double, dim> lower, upper;
    };


    /// Position of a facet.
    template <int dim>
    struct Place
    {
      Place(const ContactSurface<dim>                  &surface,
            const std::vector<std::array<double, dim>> &positions,
            const unsigned int                          f)
        : facet(f)
        , measure(surface.facets[f].measure)
        , normal(facet_normal<dim>(surface, positions, f))
      {
        for (unsigned int v = 0; v < dim; ++v)
          {
            corners[v] = positions[surface.facets[f].nodes[v]];
            box.add(corners[v]);
          }
      }

      double
      squared_distance(const std::array<double, dim> &y) const
      {
        std::array<double, dim> r = y;
        const auto             &a = corners[0];
        for (unsigned int c = 0; c < dim; ++c)
          r[c] -= a[c];
        if constexpr (dim == 2)
          {
            std::array<double, dim> e = corners[1];
            for (unsigned int c = 0; c < dim; ++c)
              e[c] -= a[c];
            const double along =
              std::clamp(dot<dim>(e, r) / dot<dim>(e, e), 0., 1.);
            for (unsigned int c = 0; c < dim; ++c)
              r[c] -= along * e[c];
          }
        if constexpr (dim == 3)
          {
            std::array<Tensor<1, 3>, 3> vertices;
            for (unsigned int v = 0; v < 3; ++v)
              vertices[v] = to_tensor(corners[v]);
            const Tensor<1, 3> point = to_tensor(y);
            const auto         shares =
              closest_in_triangle(point, vertices[0], vertices[1], vertices[2]);
            Tensor<1, 3> distance = point;
            for (unsigned int v = 0; v < 3; ++v)
              distance -= shares[v] * vertices[v];
            return distance.norm_square();
          }
        return dot<dim>(r, r);
      }

      /// Distance from the plane of the facet, on either side.
      double
      distance_from_plane(const std::array<double, dim> &y) const
      {
        return std::abs(dot<dim>(normal, y) - dot<dim>(normal, corners[0])) /
          std::sqrt(dot<dim>(normal, normal));
      }

      /// Whether its outward normal points against @p other.
      bool
      faces(const std::array<double, dim> &other) const
      {
        return dot<dim>(normal, other) < 0.;
      }

      unsigned int                             facet;
      double                                   measure;
      std::array<double, dim>                  normal;
      std::array<std::array<double, dim>, dim> corners;
      Box<dim>                                 box;
    };

    /// The closest one of the facets given to it.
    template <int dim>
    struct Closest
    {
      /// Whether the closest facet can be in @p box. Facets as far as the
      /// closest one to round-off count as well.
      bool
      may_be_in(const Box<dim> &box, const std::array<double, dim> &y) const
      {
        return may_be_at(box.squared_distance(y), box.square_of_diagonal());
      }

      /// The same with the square of the distance of the box, and that of its diagonal.
      bool
      may_be_at(const double distance, const double diagonal) const
      {
        return distance <= smallest * (1. + 1e-6) + 1e-12 * diagonal;
      }

      /// @param accept is only called for a facet that would be the closest.
      template <typename Accept>
      void
      consider(const Place<dim>              &place,
               const std::array<double, dim> &y,
               const Accept                  &accept)
      {
        const double distance = place.squared_distance(y);
        // In 3D the facets around a closest edge or vertex are equally far to
        // round-off, which must not decide. The point faces the one from whose
        // plane it is farthest: it may be behind the planes of others although
        // in front of the body.
        const double equal =
          dim < 3 ? 0. : 1e-9 * smallest + 1e-18 * place.measure;
        if (distance > smallest + equal || !accept(place.facet))
          return;
        const double from_plane = dim < 3 ? 0. : place.distance_from_plane(y);
        const double margin     = 1e-6 * std::sqrt(distance);
        if (!best || distance < smallest - equal ||
            from_plane > farthest + margin ||
            (place.facet < *best && from_plane >= farthest - margin))
          {
            smallest = distance;
            best     = place.facet;
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
  struct FacetSearch<dim>::Groups
  {
    /// So many facets one after the other, which mostly are neighbours, make a group; so
    /// many groups a larger one.
    static constexpr unsigned int size = 8;

    struct Group
    {
      Box<dim>     corners, normals;
      unsigned int begin = 0, end = 0;
      /// Boxes around the corners of its members, all of which are compared at once,
      /// and squares of their diagonals.
      using EachMember = Eigen::Array<double, size, 1>;
      std::array<EachMember, dim> lower, upper;
      EachMember                  diagonals;

      Group()
      {
        diagonals.setZero();
        for (unsigned int c = 0; c < dim; ++c)
          {
            lower[c].setZero();
            upper[c].setZero();
          }
      }

      /// Squares of the distances of the members' boxes from @p y, including
      /// those of absent members.
      EachMember
      squared_distances(const std::array<double, dim> &y) const
      {
        EachMember sum = EachMember::Zero();
        for (unsigned int c = 0; c < dim; ++c)
          {
            const EachMember outside =
              (lower[c] - y[c]).max(y[c] - upper[c]).max(0.);
            sum += outside * outside;
          }
        return sum;
      }
    };

    std::vector<Place<dim>> places;
    /// Groups of facets, groups of these, and so on up to a single one.
    std::vector<std::vector<Group>> levels;

    /// Groups of @p n_members of the level before.
    /// @param corners,normals boxes of each member.
    template <typename Corners, typename Normals>
    void
    add_level(const unsigned int n_members,
              const Corners     &corners,
              const Normals     &normals)
    {
      std::vector<Group> groups((n_members + size - 1) / size);
      for (unsigned int k = 0; k < n_members; ++k)
        {
          Group &group = groups[k / size];
          if (k % size == 0)
            group.begin = k;
          group.end          = k + 1;
          const Box<dim> box = corners(k), directions = normals(k);
          group.corners.add(box.lower);
          group.corners.add(box.upper);
          group.normals.add(directions.lower);
          group.normals.add(directions.upper);
          for (unsigned int c = 0; c < dim; ++c)
            {
              group.lower[c][k % size] = box.lower[c];
              group.upper[c][k % size] = box.upper[c];
            }
          group.diagonals[k % size] = box.square_of_diagonal();
        }
      levels.push_back(std::move(groups));
    }
  };



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
    : all(std::make_unique<Groups>())
  {
    all->places.reserve(facets.size());
    for (const unsigned int f : facets)
      all->places.emplace_back(surface, positions, f);
    all->add_level(
      all->places.size(),
      [&](const unsigned int k) { return all->places[k].box; },
      [&](const unsigned int k) {
        Box<dim> box;
        box.add(all->places[k].normal);
        return box;
      });
    while (all->levels.back().size() > 1)
      {
        const auto &below = all->levels.back();
        all->add_level(
          below.size(),
          [&](const unsigned int k) { return below[k].corners; },
          [&](const unsigned int k) { return below[k].normals; });
      }
  }



  template <int dim>
  FacetSearch<dim>::~FacetSearch() = default;



  template <int dim>
  std::optional<unsigned int>
  FacetSearch<dim>::closest_facing(
    const std::array<double, dim>                   &y,
    const std::array<double, dim>                   &normal,
    const std::function<bool(const unsigned int f)> &accept,
    const double                                     largest_distance,
    const std::optional<unsigned int>                likely) const
  {
    using Group = typename Groups::Group;
    Closest<dim> closest;
    closest.smallest =
      std::min(closest.smallest, largest_distance * largest_distance);
    const auto consider = [&](const Place<dim> &place) {
      if (accept)
        closest.consider(place, y, accept);
      else if (place.faces(normal))
        closest.consider(place, y, [](const unsigned int) { return true; });
    };
    if (likely)
      {
        const auto found =
          std::lower_bound(all->places.begin(),
                           all->places.end(),
                           *likely,
                           [](const Place<dim> &place, const unsigned int f) {
                             return place.facet < f;
                           });
        if (found != all->places.end() && found->facet == *likely)
          consider(*found);
      }
    const auto faces = [&](const Group &group) {
      return accept || group.normals.smallest_product(normal) < 0.;
    };
    const auto look_at = [&](const auto        &self,
                             const unsigned int level,
                             const Group       &group) -> void {
      const auto distances = group.squared_distances(y);
      const auto may_count = [&](const unsigned int k) {
        return closest.may_be_at(distances[k - group.begin],
                                 group.diagonals[k - group.begin]);
      };
      if (level == 0)
        {
          for (unsigned int k = group.begin; k < group.end; ++k)
            if (may_count(k))
              consider(all->places[k]);
          return;
        }
      // The member with the nearest box first: few others are nearer than its
      // facets.
      const std::vector<Group> &members  = all->levels[level - 1];
      unsigned int              first    = group.end;
      double                    smallest = std::numeric_limits<double>::max();
      for (unsigned int k = group.begin; k < group.end; ++k)
        if (distances[k - group.begin] < smallest && may_count(k) &&
            faces(members[k]))
          {
            smallest = distances[k - group.begin];
            first    = k;
          }
      if (first == group.end)
        return;
      self(self, level - 1, members[first]);
      for (unsigned int k = group.begin; k < group.end; ++k)
        if (k != first && may_count(k) && faces(members[k]))
          self(self, level - 1, members[k]);
    };
    if (!all->places.empty())
      {
        const Group &root = all->levels.back().front();
        if (closest.may_be_in(root.corners, y) && faces(root))
          look_at(look_at, all->levels.size() - 1, root);
      }
    return closest.best;
  }



  template <int dim>
  struct FacetsAround<dim>::Known
  {
    const ContactSurface<dim>                  &surface;
    const std::vector<std::array<double, dim>> &positions;
    /// Index of each facet among the positions, plus one; 0: not yet computed.
    /// Empty until the first query: most instants have none.
    std::vector<unsigned int> number;
    std::vector<Place<dim>>   places;

    const Place<dim> &
    place(const unsigned int f)
    {
      if (number.empty())
        number.resize(surface.facets.size(), 0);
      if (number[f] == 0)
        {
          places.emplace_back(surface, positions, f);
          number[f] = places.size();
        }
      return places[number[f] - 1];
    }
  };



  template <int dim>
  FacetsAround<dim>::FacetsAround(
    const ContactSurface<dim>                  &surface,
    const std::vector<std::array<double, dim>> &positions)
    : known(std::make_unique<Known>(Known{surface, positions, {}, {}}))
  {}



  template <int dim>
  FacetsAround<dim>::~FacetsAround() = default;



  template <int dim>
  std::optional<unsigned int>
  FacetsAround<dim>::closest_facing(const std::vector<unsigned int>  &facets,
                                    const std::array<double, dim>    &y,
                                    const std::array<double, dim>    &normal,
                                    const std::optional<unsigned int> likely)
  {
    Closest<dim> closest;
    const auto   consider = [&](const unsigned int f) {
      const Place<dim> &place = known->place(f);
      if (closest.may_be_in(place.box, y) && place.faces(normal))
        closest.consider(place, y, [](const unsigned int) { return true; });
    };
    const bool knows_likely = likely &&
      std::find(facets.begin(), facets.end(), *likely) != facets.end();
    if (knows_likely)
      consider(*likely);
    for (const unsigned int f : facets)
      if (!knows_likely || f != *likely)
        consider(f);
    return closest.best;
  }



  template <int dim>
  std::vector<unsigned int>
  FacetSearch<dim>::near(const std::array<double, dim> &lower,
                         const std::array<double, dim> &upper) const
  {
    using Group = typename Groups::Group;
    Box<dim> box;
    box.add(lower);
    box.add(upper);
    std::vector<unsigned int> found;
    const auto                look_at = [&](const auto        &self,
                             const unsigned int level,
                             const Group       &group) -> void {
      if (!group.corners.meets(box))
        return;
      for (unsigned int k = group.begin; k < group.end; ++k)
        if (level > 0)
          self(self, level - 1, all->levels[level - 1][k]);
        else if (all->places[k].box.meets(box))
          found.push_back(all->places[k].facet);
    };
    if (!all->places.empty())
      look_at(look_at, all->levels.size() - 1, all->levels.back().front());
    std::sort(found.begin(), found.end());
    return found;
  }


  template class FacetSearch<1>;
  template class FacetSearch<2>;
  template class FacetSearch<3>;
  template class FacetsAround<3>;
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
} // namespace Ricochet
