// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/surfaces/facet_patches.h>

#include <deal.II/base/mpi.h>
#include <deal.II/numerics/rtree.h>

#include <boost/serialization/utility.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Facets of a patch: few enough that it is about as near as its box, and so many
    /// that there are few boxes beside facets.
    constexpr std::size_t largest_patch = 32;

    template <int dim>
    BoundingBox<dim>
    extended(const BoundingBox<dim> &box, const double distance)
    {
      BoundingBox<dim> result = box;
      result.extend(distance);
      return result;
    }
  } // namespace



  template <int dim>
  std::vector<std::vector<unsigned int>>
  groups_of_neighbours(const ContactSurface<dim> &surface,
                       std::vector<unsigned int>  facets)
  {
    if (facets.empty())
      return {};
    if (facets.size() <= largest_patch)
      return {facets};
    const auto middle_of = [&](const unsigned int f) {
      Tensor<1, dim> middle;
      for (const unsigned int n : surface.facets[f].nodes)
        middle +=
          surface.nodes[n].reference_position / static_cast<double>(dim);
      return middle;
    };
    // In halves across the longest side.
    std::vector<Point<dim>> middles;
    for (const unsigned int f : facets)
      middles.emplace_back(middle_of(f));
    const BoundingBox<dim> box(middles);
    unsigned int           longest = 0;
    for (unsigned int c = 1; c < dim; ++c)
      if (box.side_length(c) > box.side_length(longest))
        longest = c;
    std::sort(facets.begin(),
              facets.end(),
              [&](const unsigned int a, const unsigned int b) {
                return std::pair(middle_of(a)[longest], a) <
                  std::pair(middle_of(b)[longest], b);
              });
    const auto half = facets.begin() + facets.size() / 2;
    auto groups = groups_of_neighbours<dim>(surface, {facets.begin(), half});
    const auto others =
      groups_of_neighbours<dim>(surface, {half, facets.end()});
    groups.insert(groups.end(), others.begin(), others.end());
    return groups;
  }



  template <int dim>
  BoundingBox<dim>
  box_of_facets(const ContactSurface<dim>                  &surface,
                const std::vector<unsigned int>            &facets,
                const std::vector<std::array<double, dim>> &from,
                const std::vector<std::array<double, dim>> &to)
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::pair<Point<dim>, Point<dim>> ends;
    for (unsigned int c = 0; c < dim; ++c)
      {
        ends.first[c]  = infinity;
        ends.second[c] = -infinity;
      }
    for (const unsigned int f : facets)
      for (const unsigned int n : surface.facets[f].nodes)
        for (const auto *x : {&from[n], &to[n]})
          for (unsigned int c = 0; c < dim; ++c)
            {
              ends.first[c]  = std::min(ends.first[c], (*x)[c]);
              ends.second[c] = std::max(ends.second[c], (*x)[c]);
            }
    return BoundingBox<dim>(ends);
  }



  template <int dim>
  FacetPatches<dim>::FacetPatches(const ContactSurface<dim> &surface,
                                  const MPI_Comm             communicator)
    : surface(surface)
    , communicator(communicator)
    , this_rank(Utilities::MPI::this_mpi_process(communicator))
    , patch_of_facet(surface.facets.size())
    , facets_at_node(surface.nodes.size())
  {
    std::map<unsigned int, std::vector<unsigned int>> facets_of_rank;
    for (unsigned int f = 0; f < surface.facets.size(); ++f)
      {
        facets_of_rank[surface.facets[f].owner].push_back(f);
        for (const unsigned int n : surface.facets[f].nodes)
          facets_at_node[n].push_back(f);
      }
    for (const auto &[rank, own] : facets_of_rank)
      for (auto &group : groups_of_neighbours(surface, own))
        {
          for (const unsigned int f : group)
            patch_of_facet[f] = facets.size();
          owner.push_back(rank);
          facets.push_back(std::move(group));
        }
  }



  template <int dim>
  std::vector<unsigned int>
  FacetPatches<dim>::around(const unsigned int patch,
                            const unsigned int n_steps) const
  {
    std::vector<unsigned int> reached = facets[patch];
    std::vector<unsigned int> last    = reached;
    std::sort(reached.begin(), reached.end());
    for (unsigned int step = 0; step < n_steps; ++step)
      {
        std::vector<unsigned int> next;
        for (const unsigned int f : last)
          for (const unsigned int n : surface.facets[f].nodes)
            next.insert(next.end(),
                        facets_at_node[n].begin(),
                        facets_at_node[n].end());
        std::sort(next.begin(), next.end());
        next.erase(std::unique(next.begin(), next.end()), next.end());
        last.clear();
        std::set_difference(next.begin(),
                            next.end(),
                            reached.begin(),
                            reached.end(),
                            std::back_inserter(last));
        reached.insert(reached.end(), last.begin(), last.end());
        std::sort(reached.begin(), reached.end());
      }
    std::vector<unsigned int> result;
    for (const unsigned int f : reached)
      result.push_back(patch_of_facet[f]);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }



  template <int dim>
  std::vector<unsigned int>
  FacetPatches<dim>::near(const std::vector<Box> &places,
                          const double            distance,
                          const Positions        &from,
                          const Positions        &to) const
  {
    using Entry = std::pair<Box, unsigned int>;
    std::vector<Entry> entries;
    for (unsigned int patch = 0; patch < size(); ++patch)
      if (is_own(patch))
        entries.emplace_back(
          box_of_facets<dim>(surface, facets[patch], from, to),
          patch);
    namespace bgi = boost::geometry::index;
    if (Utilities::MPI::n_mpi_processes(communicator) > 1)
      {
        // One box of each rank with points, from which others see what to send
        // to it.
        std::vector<Box> region;
        if (!places.empty())
          {
            region = {places.front()};
            for (const Box &place : places)
              region.front().merge_with(place);
            region.front().extend(distance);
          }
        const auto regions = Utilities::MPI::all_gather(communicator, region);
        const RTree<Entry>                         own = pack_rtree(entries);
        std::map<unsigned int, std::vector<Entry>> to_send;
        for (unsigned int rank = 0; rank < regions.size(); ++rank)
          if (rank != this_rank && !regions[rank].empty())
            for (const auto &entry : own |
                   bgi::adaptors::queried(
                                       bgi::intersects(regions[rank].front())))
              to_send[rank].push_back(entry);
        for (const auto &[rank, received] :
             Utilities::MPI::some_to_some(communicator, to_send))
          entries.insert(entries.end(), received.begin(), received.end());
      }
    const RTree<Entry>        boxes = pack_rtree(entries);
    std::vector<unsigned int> result;
    for (const Box &place : places)
      for (const auto &entry : boxes |
             bgi::adaptors::queried(bgi::intersects(extended(place, distance))))
        result.push_back(entry.second);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }


#define RICOCHET_INSTANTIATE(dim)                                            \
  template class FacetPatches<dim>;                                          \
  template std::vector<std::vector<unsigned int>> groups_of_neighbours<dim>( \
    const ContactSurface<dim> &,                                             \
    std::vector<unsigned int>);                                              \
  template dealii::BoundingBox<dim> box_of_facets<dim>(                      \
    const ContactSurface<dim> &,                                             \
    const std::vector<unsigned int> &,                                       \
    const std::vector<std::array<double, dim>> &,                            \
    const std::vector<std::array<double, dim>> &);

  RICOCHET_INSTANTIATE(1)
  RICOCHET_INSTANTIATE(2)
  RICOCHET_INSTANTIATE(3)
#undef RICOCHET_INSTANTIATE
} // namespace Ricochet
