// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <contact/kinematics/mortar_pair.h>
#include <contact/surfaces/facet_search.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Cuts at a smaller distance than this part of a facet are one.
    constexpr double smallest_part = 1e-9;

    /// Largest distance from the master at which facets are cut, in their
    /// lengths; beyond half of it they pass no vertices.
    constexpr double reach = 2.;
  } // namespace



  MortarPair::MortarPair(const Body<2>     &body,
                         const ContactPair &pair,
                         const MortarShape  shape)
    : PairBeforeChains<2>(body, pair)
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
    supports.resize(own_points.size());
    std::map<unsigned int, unsigned int> place;
    for (unsigned int p = 0; p < own_points.size(); ++p)
      for (const unsigned int f : own_points[p].facets)
        {
          if (place.emplace(f, facets.size()).second)
            {
              facets.emplace_back();
              facets.back().number = f;
            }
          supports[p].push_back(
            {place.at(f),
             slave.facets[f].nodes[0] == own_points[p].nodes[0].first ? 0U
                                                                      : 1U});
        }
  }



  SurfacePair<2>::Position
  MortarPair::position_on(const SlaveFacet &facet,
                          const double      s,
                          const Positions  &positions) const
  {
    const auto     &nodes = slave.facets[facet.number].nodes;
    const Position &a     = positions.slave[nodes[0]],
                   &b     = positions.slave[nodes[1]];
    return {{(1. - s) * a[0] + s * b[0], (1. - s) * a[1] + s * b[1]}};
  }



  double
  MortarPair::psi(const SlaveFacet  &facet,
                  const unsigned int end,
                  const double       s) const
  {
    if (shape == MortarShape::dual && facet.is_covered)
      return end == 0 ? 2. - 3. * s : 3. * s - 1.;
    return end == 0 ? 1. - s : s;
  }



  void
  MortarPair::find_cuts(const SlaveFacet     &facet,
                        const Positions      &positions,
                        const FacetSearch<2> &search,
                        std::vector<double>  &cuts) const
  {
    const Position a      = position_on(facet, 0., positions);
    const Position b      = position_on(facet, 1., positions);
    const double   length = std::hypot(b[0] - a[0], b[1] - a[1]);
    Position       lower, upper;
    for (unsigned int c = 0; c < 2; ++c)
      {
        lower[c] = std::min(a[c], b[c]) - reach * length;
        upper[c] = std::max(a[c], b[c]) + reach * length;
      }
    // The zero of a function that is linear along the facet.
    const auto add_zero = [&](const double at_a, const double at_b) {
      if ((at_a < 0.) != (at_b < 0.))
        cuts.push_back(at_a / (at_a - at_b));
    };
    const auto &x = positions.master;
    for (const unsigned int f : search.near(lower, upper))
      {
        const auto     &own   = master.facets[f];
        const Position &begin = x[own.nodes[0]], &end = x[own.nodes[1]];
        if (own.next)
          {
            const Position &behind = x[master.facets[*own.next].nodes[1]];
            add_zero(
              FacetChain<double>::past_vertex<double>({a, begin, end, behind},
                                                      0),
              FacetChain<double>::past_vertex<double>({b, begin, end, behind},
                                                      0));
          }
        // The end of the surface is that of its last facet.
        const auto along = [&](const Position &y, const Position &from) {
          return (end[0] - begin[0]) * (y[0] - from[0]) +
            (end[1] - begin[1]) * (y[1] - from[1]);
        };
        if (!own.next)
          add_zero(along(a, end), along(b, end));
        if (!own.previous)
          add_zero(along(a, begin), along(b, begin));
      }
  }



  void
  MortarPair::find_intervals(SlaveFacet           &facet,
                             const FacetSearch<2> &search,
                             const Positions      *later,
                             const FacetSearch<2> *search_later) const
  {
    facet.intervals.clear();
    facet.is_covered         = true;
    std::vector<double> cuts = {0., 1.};
    find_cuts(facet, old_positions, search, cuts);
    if (later)
      find_cuts(facet, *later, *search_later, cuts);
    std::sort(cuts.begin(), cuts.end());
    const Position normal =
      facet_normal<2>(slave, old_positions.slave, facet.number);
    const double length = std::hypot(normal[0], normal[1]);
    for (unsigned int k = 1; k < cuts.size(); ++k)
      {
        Interval interval;
        interval.begin = cuts[k - 1];
        interval.end   = cuts[k];
        if (interval.end - interval.begin < smallest_part)
          continue;
        const double   middle = .5 * (interval.begin + interval.end);
        const Position y      = position_on(facet, middle, old_positions);
        auto           facing = find_facet(y,
                                 normal,
                                 search,
                                 old_positions.master,
                                 this->half_length(facet.number));
        if (facing &&
            !(gap_before(work, facing->chain, facing->facet) >
              -largest_depth(*facing)))
          facing.reset();
        interval.may_pass = facing &&
          gap_before(work, facing->chain, facing->facet) < .5 * reach * length;
        // The whole interval is between the bisectors, unless a cut was missed.
        for (const double s : {.999 * interval.begin + .001 * interval.end,
                               .001 * interval.begin + .999 * interval.end})
          if (interval.may_pass)
            interval.may_pass = FacetChain<double>::is_between_bisectors(
              gather(position_on(facet, s, old_positions),
                     facing->chain,
                     old_positions.master),
              facing->facet);
        // A part that is in front of the master now and will face it soon.
        if (!facing && later)
          {
            facing =
              find_facet(position_on(facet, middle, *later),
                         facet_normal<2>(slave, later->slave, facet.number),
                         *search_later,
                         later->master,
                         this->half_length(facet.number));
            if (facing)
              {
                gather(y, facing->chain, old_positions.master);
                if (!(gap_before(work, facing->chain, facing->facet) > 0.))
                  facing.reset();
              }
          }
        if (!facing)
          {
            facet.is_covered = false;
            continue;
          }
        interval.chain     = std::move(facing->chain);
        interval.old_facet = facing->facet;
        facet.intervals.push_back(std::move(interval));
      }
  }



  void
  MortarPair::add_points(SlaveFacet        &facet,
                         const unsigned int interval,
                         const double       begin,
                         const double       end,
                         const unsigned int new_facet) const
  {
    // Gauss' rule of order 3.
    for (const double place :
         {.5 - .5 / std::sqrt(3.), .5 + .5 / std::sqrt(3.)})
      {
        if (facet.n_points == facet.points.size())
          facet.points.emplace_back();
        GaussPoint &point = facet.points[facet.n_points++];
        point.interval    = interval;
        point.s           = begin + place * (end - begin);
        point.weight = .5 * (end - begin) * slave.facets[facet.number].measure;
        point.new_facet  = new_facet;
        point.up_to_date = false;
      }
  }



  void
  MortarPair::place_points(SlaveFacet &facet) const
  {
    facet.n_points = 0;
    for (unsigned int i = 0; i < facet.intervals.size(); ++i)
      {
        const Interval    &interval  = facet.intervals[i];
        const unsigned int old_facet = interval.old_facet;
        if (!interval.may_pass)
          {
            add_points(facet, i, interval.begin, interval.end, old_facet);
            continue;
          }
        const auto facet_at = [&](const double s) {
          return FacetChain<double>::facet_before(
            gather(position_on(facet, s, new_positions),
                   interval.chain,
                   new_positions.master),
            old_facet);
        };
        // Pieces from one end to the other, over the bisectors between them. Pieces
        // of round-off size, where a cut of the beginning is one of the end, are
        // merged with their neighbour.
        const unsigned int first = facet_at(interval.begin);
        const unsigned int last  = facet_at(interval.end);
        const int          way   = last > first ? 1 : -1;
        double             begin = interval.begin;
        unsigned int       on    = first;
        for (unsigned int f = first; f != last; f += way)
          {
            const unsigned int vertex = way > 0 ? f : f - 1;
            const auto         past   = [&](const double s) {
              return FacetChain<double>::past_vertex(
                gather(position_on(facet, s, new_positions),
                       interval.chain,
                       new_positions.master),
                vertex);
            };
            const double at_begin = past(interval.begin);
            const double at_end   = past(interval.end);
            if ((at_begin < 0.) == (at_end < 0.))
              {
                on = f + way;
                continue;
              }
            const double cut = interval.begin +
              (interval.end - interval.begin) * at_begin / (at_begin - at_end);
            if (interval.end - cut < smallest_part)
              break;
            if (cut - begin >= smallest_part)
              {
                add_points(facet, i, begin, cut, on);
                begin = cut;
              }
            on = f + way;
          }
        add_points(facet, i, begin, interval.end, on);
      }
  }



  double
  MortarPair::mean_gap(const unsigned int p,
                       const Positions   &positions,
                       const bool         at_end) const
  {
    double sum = 0.;
    for (const Support &support : supports[p])
      {
        const SlaveFacet &facet = facets[support.facet];
        for (unsigned int q = 0; q < facet.n_points; ++q)
          {
            const GaussPoint &point    = facet.points[q];
            const Interval   &interval = facet.intervals[point.interval];
            const auto       &x = gather(position_on(facet, point.s, positions),
                                   interval.chain,
                                   positions.master);
            sum += point.weight * psi(facet, support.end, point.s) *
              gap_before(x,
                         interval.chain,
                         at_end ? point.new_facet : interval.old_facet);
          }
      }
    return sum / own_points[p].weight;
  }



  void
  MortarPair::begin_step(const ContactStart &start)
  {
    Course course;
    begin_course(start, course);
    old_positions                                    = std::move(course.begin);
    new_positions                                    = old_positions;
    const bool                            has_length = start.time_step > 0.;
    const FacetSearch<2>                  search(master, old_positions.master);
    const std::unique_ptr<FacetSearch<2>> later = has_length
      ? std::make_unique<FacetSearch<2>>(master, course.end.master)
      : nullptr;
    for (SlaveFacet &facet : facets)
      {
        find_intervals(facet,
                       search,
                       has_length ? &course.end : nullptr,
                       later.get());
        place_points(facet);
      }

    for (unsigned int p = 0; p < own_points.size(); ++p)
      {
        Gaps &gap     = gaps[p];
        up_to_date[p] = false;
        double part   = 0.;
        for (const Support &support : supports[p])
          {
            const SlaveFacet &facet = facets[support.facet];
            for (unsigned int q = 0; q < facet.n_points; ++q)
              part += facet.points[q].weight *
                psi(facet, support.end, facet.points[q].s);
          }
        gap.is_before_facet =
          this->may_touch(own_points[p]) && part > 1e-6 * own_points[p].weight;
        if (!gap.is_before_facet)
          continue;
        gap.old_gap = gap.new_gap = gap.predicted_gap =
          mean_gap(p, old_positions, true);
        if (has_length)
          gap.predicted_gap = mean_gap(p, course.middle, true);
      }
  }



  void
  MortarPair::evaluate(const Vector &solution)
  {
    read(solution, new_positions);
    for (SlaveFacet &facet : facets)
      place_points(facet);
    for (unsigned int p = 0; p < own_points.size(); ++p)
      if (gaps[p].is_before_facet)
        {
          up_to_date[p]   = false;
          gaps[p].new_gap = mean_gap(p, new_positions, true);
        }
  }



  unsigned int
  MortarPair::gather_passage(const SlaveFacet &facet,
                             const GaussPoint &point,
                             const Positions  &positions) const
  {
    const Interval    &interval = facet.intervals[point.interval];
    const unsigned int first    = std::min(interval.old_facet, point.new_facet);
    const unsigned int last     = std::max(interval.old_facet, point.new_facet);
    work.assign(1, position_on(facet, point.s, positions));
    for (unsigned int n = first; n < last + 2; ++n)
      work.push_back(positions.master[interval.chain.nodes[n]]);
    return first;
  }



  const FacetChain<double>::Rows &
  MortarPair::rows_of(SlaveFacet &facet, GaussPoint &point) const
  {
    if (!point.up_to_date)
      {
        point.up_to_date         = true;
        const unsigned int first = gather_passage(facet, point, old_positions);
        old_work                 = work;
        gather_passage(facet, point, new_positions);
        FacetChain<double>(old_work, work)
          .evaluate(facet.intervals[point.interval].old_facet - first,
                    point.new_facet - first,
                    point.rows);
      }
    return point.rows;
  }



  template <typename Function>
  void
  MortarPair::for_each_unknown(const SlaveFacet &facet,
                               const GaussPoint &point,
                               const Function   &add) const
  {
    const auto &nodes = slave.facets[facet.number].nodes;
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int c = 0; c < 2; ++c)
        add(slave.nodes[nodes[k]].unknowns[c],
            c,
            k == 0 ? 1. - point.s : point.s);
    const Interval    &interval = facet.intervals[point.interval];
    const unsigned int first    = std::min(interval.old_facet, point.new_facet);
    const unsigned int last     = std::max(interval.old_facet, point.new_facet);
    for (unsigned int n = first; n < last + 2; ++n)
      for (unsigned int c = 0; c < 2; ++c)
        add(master.nodes[interval.chain.nodes[n]].unknowns[c],
            2 * (n - first + 1) + c,
            1.);
  }



  unsigned int
  MortarPair::place_of(const Index unknown, Rows &rows)
  {
    const auto found =
      std::find(rows.unknowns.begin(), rows.unknowns.end(), unknown);
    const unsigned int place = found - rows.unknowns.begin();
    if (found == rows.unknowns.end())
      {
        rows.unknowns.push_back(unknown);
        rows.normal.push_back(0.);
        rows.tangential[0].push_back(0.);
      }
    return place;
  }



  const SurfacePair<2>::Rows &
  MortarPair::rows(const unsigned int p) const
  {
    Rows &rows = all_rows[p];
    if (up_to_date[p])
      return rows;
    up_to_date[p] = true;
    rows.unknowns.clear();
    rows.normal.clear();
    rows.tangential[0].clear();
    rows.gap_increment = rows.slip[0] = 0.;
    rows.direction                    = {};
    for (const Index unknown :
         slave.nodes[own_points[p].nodes[0].first].unknowns)
      place_of(unknown, rows);
    for (const Support &support : supports[p])
      {
        SlaveFacet &facet = facets[support.facet];
        for (unsigned int q = 0; q < facet.n_points; ++q)
          {
            GaussPoint  &point  = facet.points[q];
            const auto  &own    = rows_of(facet, point);
            const double factor = point.weight / own_points[p].weight *
              psi(facet, support.end, point.s);
            rows.gap_increment += factor * own.gap_increment;
            rows.slip[0] += factor * own.slip;
            for_each_unknown(facet,
                             point,
                             [&](const Index        unknown,
                                 const unsigned int coordinate,
                                 const double       share) {
                               const unsigned int place =
                                 place_of(unknown, rows);
                               rows.normal[place] +=
                                 factor * share * own.normal[coordinate];
                               rows.tangential[0][place] +=
                                 factor * share * own.tangential[coordinate];
                             });
            const double part =
              point.weight * (support.end == 0 ? 1. - point.s : point.s);
            for (unsigned int c = 0; c < 2; ++c)
              rows.direction[c] += part * own.normal[c];
          }
      }
    const double length = std::hypot(rows.direction[0], rows.direction[1]);
    for (double &component : rows.direction)
      component /= length;
    return rows;
  }



  const SurfacePair<2>::Derivatives &
  MortarPair::derivatives(const unsigned int  p,
                          const Coefficients &coefficients,
                          const Caution       caution) const
  {
    rows(p);
    const double       pressure = coefficients.pressure;
    const Tangential  &traction = coefficients.traction;
    Rows              &own      = all_rows[p];
    const unsigned int m        = own.unknowns.size();
    result.gap.assign(m, 0.);
    result.slip[0].assign(m, 0.);
    result.forces.assign(m * m, 0.);
    for (const Support &support : supports[p])
      {
        SlaveFacet &facet = facets[support.facet];
        for (unsigned int q = 0; q < facet.n_points; ++q)
          {
            const GaussPoint  &point = facet.points[q];
            const unsigned int first =
              gather_passage(facet, point, old_positions);
            old_work = work;
            gather_passage(facet, point, new_positions);
            const unsigned int n = work.size();
            differentiable_work.resize(n);
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int c = 0; c < 2; ++c)
                differentiable_work[i][c] =
                  Differentiable(static_cast<int>(2 * n),
                                 static_cast<int>(2 * i + c),
                                 work[i][c]);
            FacetChain<Differentiable>(old_work, differentiable_work, caution)
              .evaluate(facet.intervals[point.interval].old_facet - first,
                        point.new_facet - first,
                        differentiable_rows);

            places.clear();
            coordinates.clear();
            factors.clear();
            for_each_unknown(facet,
                             point,
                             [&](const Index        unknown,
                                 const unsigned int coordinate,
                                 const double       share) {
                               places.push_back(place_of(unknown, own));
                               coordinates.push_back(coordinate);
                               factors.push_back(share);
                             });
            const double factor = point.weight / own_points[p].weight *
              psi(facet, support.end, point.s);
            const auto &all = differentiable_rows;
            for (unsigned int a = 0; a < places.size(); ++a)
              {
                const unsigned int i = coordinates[a];
                result.gap[places[a]] +=
                  factor * factors[a] * all.new_gap.dx(i);
                result.slip[0][places[a]] +=
                  factor * factors[a] * all.slip.dx(i);
                for (unsigned int b = 0; b < places.size(); ++b)
                  result.forces[places[a] * m + places[b]] += factor *
                    factors[a] * factors[b] *
                    (traction[0] * all.tangential[i].dx(coordinates[b]) -
                     pressure * all.normal[i].dx(coordinates[b]));
              }
          }
      }
    return result;
  }



  std::vector<SurfacePair<2>::Index>
  MortarPair::unknowns_nearby(const unsigned int p) const
  {
    // A step over several facets leads beyond the neighbours of the old facet.
    std::vector<Index> indices = rows(p).unknowns;
    const auto         add     = [&](const auto &node) {
      indices.insert(indices.end(), node.unknowns.begin(), node.unknowns.end());
    };
    for (const Index index : own_points[p].multipliers)
      if (index != numbers::invalid_dof_index)
        indices.push_back(index);
    for (const Support &support : supports[p])
      {
        const SlaveFacet &facet = facets[support.facet];
        for (const unsigned int n : slave.facets[facet.number].nodes)
          add(slave.nodes[n]);
        for (const Interval &interval : facet.intervals)
          for (unsigned int n = interval.old_facet > 0 ? interval.old_facet - 1
                                                       : 0;
               n < std::min<std::size_t>(interval.old_facet + 4,
                                         interval.chain.nodes.size());
               ++n)
            add(master.nodes[interval.chain.nodes[n]]);
      }
    std::sort(indices.begin(), indices.end());
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    return indices;
  }



  double
  MortarPair::round_off(const unsigned int p) const
  {
    double             size = 0.;
    const unsigned int n    = own_points[p].nodes[0].first;
    for (unsigned int c = 0; c < 2; ++c)
      size += 2. * std::abs(new_positions.slave[n][c]) +
        std::abs(slave.nodes[n].reference_position[c]);
    return 2. * std::numeric_limits<double>::epsilon() * size;
  }
} // namespace Ricochet
