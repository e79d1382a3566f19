// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/kinematics/points_before_facets.h>
#include <contact/surfaces/facet_patches.h>
#include <contact/surfaces/facet_search.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  PointsBeforeFacets<dim>::PointsBeforeFacets(const Body<dim>   &body,
                                              const ContactPair &pair,
                                              const PointsIn     points_in,
                                              const bool         is_smooth)
    : PairBeforeChains<dim>(body, pair)
    , is_smooth(is_smooth)
  {
    if (points_in == PointsIn::quadrature_points)
      make_quadrature_points(body);
    else if (points_in == PointsIn::corners)
      this->make_corner_points(body);
    else
      this->make_nodal_points(body, is_smooth);
    n_first_sides = own_points.size();
    if (points_in == PointsIn::nodes_and_valleys && dim > 1)
      make_other_sides();
    gaps.resize(own_points.size());
    steps.resize(own_points.size());
  }



  template <int dim>
  void
  PointsBeforeFacets<dim>::make_quadrature_points(const Body<dim> &body)
  {
    const Quadrature<dim - 1> &rule = body.face_quadrature();
    for (unsigned int f = 0; f < slave.facets.size(); ++f)
      if (this->is_mine(body, slave.facets[f].nodes[0]))
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            Point point;
            point.facets           = {f};
            point.weight           = rule.weight(q) * slave.facets[f].measure;
            point.cell_diameter    = slave.facets[f].cell_diameter;
            point.boundary_id      = slave.facets[f].boundary_id;
            point.largest_overhang = this->half_length(f);
            point.multipliers.fill(numbers::invalid_dof_index);
            if constexpr (dim == 1)
              point.nodes = {{slave.facets[f].nodes[0], 1.}};
            else
              point.nodes = {{slave.facets[f].nodes[0], 1. - rule.point(q)[0]},
                             {slave.facets[f].nodes[1], rule.point(q)[0]}};
            own_points.push_back(point);
          }
  }



  template <int dim>
  void
  PointsBeforeFacets<dim>::make_other_sides()
  {
    const std::vector<Point> first_sides = own_points;
    own_points.insert(own_points.end(), first_sides.begin(), first_sides.end());
    for (unsigned int p = 0; p < own_points.size(); ++p)
      {
        auto &multipliers = own_points[p].multipliers;
        if (is_other_side(p))
          std::swap(multipliers[0], multipliers[1]);
        multipliers[1] = numbers::invalid_dof_index;
      }
  }



  template <int dim>
  const std::vector<typename PointsBeforeFacets<dim>::Position> &
  PointsBeforeFacets<dim>::gather_all(const unsigned int p,
                                      const Chain       &chain,
                                      const Positions   &positions) const
  {
    return this->gather(this->position_of(own_points[p], positions.slave),
                        chain,
                        positions.master);
  }



  template <int dim>
  void
  PointsBeforeFacets<dim>::begin_step(const ContactStart &start)
  {
    typename SurfacePair<dim>::Course course;
    this->begin_course(start, course);
    old_positions           = std::move(course.begin);
    const bool   has_length = start.time_step > 0.;
    const double way =
      has_length ? this->longest_way(old_positions, course.end) : 0.;
    if (is_self)
      {
        // Size of a facet, and the largest approach of two points in the step.
        self_distance = 0.;
        for (const auto &facet : master.facets)
          self_distance = std::max(self_distance, facet.measure);
        self_distance += way;
      }
    find_places_now();
    // Points outside of it cannot reach the other surface in this step.
    BoundingBox<dim> within_reach;
    if (has_length)
      {
        within_reach = box_of_facets<dim>(master,
                                          this->near_facets,
                                          old_positions.master,
                                          course.end.master);
        within_reach.extend(2. * way);
      }
    const auto is_within_reach = [&](const Point &point) {
      dealii::Point<dim> y;
      const Position     x = this->position_of(point, old_positions.slave);
      std::copy(x.begin(), x.end(), y.begin_raw());
      return within_reach.point_inside(y);
    };
    const std::unique_ptr<FacetSearch<dim>> later = has_length
      ? std::make_unique<FacetSearch<dim>>(master, course.end.master)
      : nullptr;

    for (unsigned int p = 0; p < own_points.size(); ++p)
      {
        Step &step            = steps[p];
        Gaps &gap             = gaps[p];
        gap.is_before_facet   = false;
        step.up_to_date       = false;
        step.first_allowed    = 0;
        step.is_beyond_valley = false;
        step.last_allowed     = std::numeric_limits<unsigned int>::max();
        if (!this->may_touch(own_points[p]) || is_other_side(p))
          continue;
        if (places_now[p])
          begin_before(p, *places_now[p]);
        if (has_length &&
            (gap.is_before_facet ? this->may_change_facet(gap.old_gap, way)
                                 : is_within_reach(own_points[p])))
          find_facet_later(p, *later, course.end);
        step.is_double = gap.is_before_facet && is_self && meets_node(p);
        if (step.is_double && !has_other_sides())
          gap.is_before_facet = false;
        if (!gap.is_before_facet)
          continue;
        step.new_facet = step.first = step.last = step.old_facet;
        if (is_rounded(step))
          find_nodes_of_rows(gather_all(p, step.chain, old_positions), step);
        gap.new_gap       = gap.old_gap;
        gap.predicted_gap = gap.old_gap;
        if (has_length)
          {
            const auto &x = gather_all(p, step.chain, course.middle);
            gap.predicted_gap =
              gap_at(x, step.chain, last_facet(x, step), step.may_pass);
          }
      }
    // Nodes that were pressed from both sides are likely to be so again.
    for (unsigned int p = 0; p < n_first_sides; ++p)
      if (gaps[p].is_before_facet && has_other_sides() &&
          gaps[*other_side(p)].multipliers[0] > 0.)
        find_valley(p, old_positions);
    new_positions = old_positions;
  }



  template <int dim>
  void
  PointsBeforeFacets<dim>::find_valley(const unsigned int p,
                                       const Positions   &now)
  {
    if constexpr (dim > 1)
      {
        const unsigned int other = p + n_first_sides;
        Step              &step  = steps[p];
        if (!step.may_pass || gaps[other].is_before_facet)
          return;
        // Smallest angle of a concave corner: with less, two constraints would be the
        // same. The corner has to be concave from the beginning of the step: otherwise
        // the force of its other side would act before that side was reached, and do
        // work.
        constexpr double flat = 1e-6;
        // The concave corner is between this facet of the chain and the next
        // one.
        std::optional<unsigned int> valley;
        double nearest = std::numeric_limits<double>::infinity();
        for (const int side : {-1, 0})
          {
            const int facet = static_cast<int>(step.old_facet) + side;
            if (facet < 0 ||
                facet + 1 >= static_cast<int>(step.chain.facets.size()) ||
                FacetChain<double>::turn(
                  gather_all(p, step.chain, old_positions),
                  facet) <= flat)
              continue;
            const auto  &x = gather_all(p, step.chain, now);
            const double distance =
              std::abs(FacetChain<double>::past_vertex(x, facet));
            if (FacetChain<double>::turn(x, facet) > flat && distance < nearest)
              {
                nearest = distance;
                valley  = facet;
              }
          }
        if (!valley)
          return;
        const bool goes_forward = *valley == step.old_facet;
        Step      &beyond       = steps[other];
        beyond.chain            = step.chain;
        beyond.may_pass         = false;
        beyond.is_beyond_valley = true;
        beyond.old_facet        = goes_forward ? *valley + 1 : *valley;
        beyond.new_facet = beyond.first = beyond.last = beyond.old_facet;
        (goes_forward ? step.last_allowed : beyond.last_allowed) = *valley;
        (goes_forward ? beyond.first_allowed : step.first_allowed) =
          *valley + 1;
        Gaps &gap           = gaps[other];
        gap.is_before_facet = true;
        gap.old_gap = this->gap_before(gather_all(p, step.chain, old_positions),
                                       step.chain,
                                       beyond.old_facet);
        gap.new_gap = gap.predicted_gap = gap.old_gap;
      }
    else
      (void)p;
  }



  template <int dim>
  double
  PointsBeforeFacets<dim>::turn_at(const unsigned int node) const
  {
    std::optional<unsigned int> before, after;
    for (unsigned int f = 0; f < master.facets.size(); ++f)
      {
        if (master.facets[f].nodes.back() == node)
          before = f;
        if (master.facets[f].nodes.front() == node)
          after = f;
      }
    if (!before || !after)
      return 0.;
    const std::vector<Position> chain = {
      old_positions.master[node],
      old_positions.master[master.facets[*before].nodes.front()],
      old_positions.master[node],
      old_positions.master[master.facets[*after].nodes.back()]};
    if constexpr (dim == 2)
      return FacetChain<double>::turn(chain, 0);
    else
      return 0.;
  }



  template <int dim>
  bool
  PointsBeforeFacets<dim>::meets_node(const unsigned int p) const
  {
    if constexpr (dim == 1)
      return false;
    else
      {
        if (own_points[p].multipliers[0] == numbers::invalid_dof_index)
          return false;
        const unsigned int node = own_points[p].nodes[0].first;
        const Step        &step = steps[p];
        const auto        &x    = gather_all(p, step.chain, old_positions);
        for (const unsigned int n : {step.old_facet, step.old_facet + 1})
          {
            const double length =
              master.facets[step.chain.facets[step.old_facet]].measure;
            const auto &a = x[step.old_facet + 1], &b = x[step.old_facet + 2],
                       &vertex = x[n + 1];
            const double along = ((b[0] - a[0]) * (x[0][0] - vertex[0]) +
                                  (b[1] - a[1]) * (x[0][1] - vertex[1])) /
              std::hypot(b[0] - a[0], b[1] - a[1]);
            if (std::abs(along) > 1e-8 * length)
              continue;
            const unsigned int other = step.chain.nodes[n];
            if (master.nodes[other].is_held)
              continue;
            const double own_turn = turn_at(node), other_turn = turn_at(other);
            if (std::abs(own_turn - other_turn) < 1e-8 ? other < node
                                                       : other_turn < own_turn)
              return true;
          }
        return false;
      }
  }



  template <int dim>
  void
  PointsBeforeFacets<dim>::find_places_now()
  {
    if (this->keeps_facets)
      {
        for (unsigned int p = 0; p < own_points.size(); ++p)
          if (places_now[p])
            places_now[p]->gap =
              gap_at(gather_all(p, places_now[p]->chain, old_positions),
                     places_now[p]->chain,
                     places_now[p]->facet,
                     places_now[p]->may_pass);
        found_at = {};
        return;
      }
    // The search distance of self-contact depends on the step.
    const bool are_known = !is_self && found_at.is_same(old_positions);
    if (are_known)
      return;
    const FacetSearch<dim> search(master, old_positions.master);
    places_now.resize(own_points.size());
    for (unsigned int p = 0; p < own_points.size(); ++p)
      if (this->may_touch(own_points[p]) && !is_other_side(p))
        places_now[p] = place_now(p, search);
    found_at = old_positions;
  }



  template <int dim>
  std::optional<typename PointsBeforeFacets<dim>::Place>
  PointsBeforeFacets<dim>::place_now(const unsigned int      p,
                                     const FacetSearch<dim> &search) const
  {
    const Point &point = own_points[p];
    auto         facing =
      this->find_facet(this->position_of(point, old_positions.slave),
                       this->normal_of(point, old_positions.slave),
                       search,
                       old_positions.master,
                       this->found_overhang(point, is_smooth),
                       is_self ? &point : nullptr,
                       self_distance);
    if (!facing)
      return {};
    Place place;
    place.may_pass = may_pass(work, facing->facet);
    place.gap      = gap_at(work, facing->chain, facing->facet, place.may_pass);
    if (!(place.gap > -this->largest_depth(*facing)))
      return {};
    place.facet = facing->facet;
    place.chain = std::move(facing->chain);
    return place;
  }



  template <int dim>
  double
  PointsBeforeFacets<dim>::overhang(const unsigned int p) const
  {
    const Step &step = steps[p];
    const auto [along, length] =
      this->place_along(gather_all(p, step.chain, old_positions),
                        step.old_facet);
    return std::max({0., -along, along - length});
  }



  template <int dim>
  void
  PointsBeforeFacets<dim>::find_facet_later(const unsigned int      p,
                                            const FacetSearch<dim> &search,
                                            const Positions        &later)
  {
    const Point &point = own_points[p];
    auto facing        = this->find_facet(this->position_of(point, later.slave),
                                   this->normal_of(point, later.slave),
                                   search,
                                   later.master,
                                   this->found_overhang(point, is_smooth),
                                   is_self ? &point : nullptr,
                                   self_distance);
    if (!facing)
      return;
    // The path to this facet, from where the point is now; if the point does not
    // face this part of the surface yet, along this facet.
    const auto        &x      = gather_all(p, facing->chain, old_positions);
    const unsigned int first  = this->facet_before(x, facing->facet);
    const bool         passes = may_pass(x, first) &&
      (is_smooth || this->gap_before(x, facing->chain, first) > 0.);
    const unsigned int old_facet = passes ? first : facing->facet;
    const double       old_gap   = gap_at(x, facing->chain, old_facet, passes);
    // A point that is behind the facet can only come to face it from the side.
    if (!(old_gap > 0.) &&
        !(coverage_at(old_positions, p, facing->chain, old_facet, old_facet) ==
          0.))
      return;
    begin_before(p, {std::move(facing->chain), old_facet, passes, old_gap});
  }



  template <int dim>
  void
  PointsBeforeFacets<dim>::begin_before(const unsigned int p, Place place)
  {
    gaps[p].is_before_facet = true;
    gaps[p].old_gap         = place.gap;
    steps[p].may_pass       = place.may_pass;
    steps[p].old_facet      = place.facet;
    steps[p].chain          = std::move(place.chain);
    gaps[p].old_coverage    = gaps[p].new_coverage =
      coverage_at(old_positions, p, steps[p].chain, place.facet, place.facet);
  }



  template <int dim>
  unsigned int
  PointsBeforeFacets<dim>::last_facet(const std::vector<Position> &x,
                                      const Step                  &step) const
  {
    // Margin where two facets meet, whose gaps differ by so little that the energy
    // is unaffected.
    constexpr double margin = 1e-8;
    if constexpr (dim > 1)
      if (step.may_pass || step.is_beyond_valley)
        return std::clamp(FacetChain<double>::facet_before(x,
                                                           step.old_facet,
                                                           margin),
                          step.first_allowed,
                          step.last_allowed);
    return step.old_facet;
  }



  template <int dim>
  bool
  PointsBeforeFacets<dim>::may_pass(const std::vector<Position> &x,
                                    const unsigned int           facet) const
  {
    if constexpr (dim == 1)
      return false;
    else
      return FacetChain<double>::is_between_bisectors(x, facet);
  }



  template <int dim>
  void
  PointsBeforeFacets<dim>::evaluate(const Vector &solution)
  {
    this->read(solution, new_positions);
    for (unsigned int p = 0; p < own_points.size(); ++p)
      {
        if (!gaps[p].is_before_facet)
          continue;
        Step       &step = steps[p];
        const auto &x    = gather_all(p, step.chain, new_positions);
        step.new_facet   = last_facet(x, step);
        if (is_other_side(p))
          step.old_facet = step.new_facet;
        gaps[p].new_gap = gap_at(x, step.chain, step.new_facet, step.may_pass);
        step.first      = std::min(step.old_facet, step.new_facet);
        step.last       = std::max(step.old_facet, step.new_facet);
        step.up_to_date = false;
        if (is_rounded(step))
          {
            find_nodes_of_rows(x, step);
            find_nodes_of_rows(gather_all(p, step.chain, old_positions), step);
          }
        if (is_smooth)
          {
            gaps[p].old_coverage =
              coverage_at(old_positions, p, step.chain, step.first, step.last);
            gaps[p].new_coverage =
              coverage_at(new_positions, p, step.chain, step.first, step.last);
          }
      }
  }



  template <int dim>
  OpenEnds
  PointsBeforeFacets<dim>::open_ends(const unsigned int p,
                                     const Chain       &chain,
                                     const unsigned int first,
                                     const unsigned int last) const
  {
    if (!is_smooth || dim == 1)
      return {};
    return {first == 0 && !master.facets[chain.facets.front()].previous,
            last + 1 == chain.facets.size() &&
              !master.facets[chain.facets.back()].next,
            own_points[p].largest_overhang};
  }



  template <int dim>
  double
  PointsBeforeFacets<dim>::coverage_at(const Positions   &positions,
                                       const unsigned int p,
                                       const Chain       &chain,
                                       const unsigned int first,
                                       const unsigned int last) const
  {
    if constexpr (dim > 1)
      if (const auto ends = open_ends(p, chain, first, last);
          ends.first || ends.last)
        return FacetChain<double>::coverage(gather_all(p, chain, positions),
                                            ends);
    return 1.;
  }



  template <int dim>
  void
  PointsBeforeFacets<dim>::find_roundings(const Chain &chain) const
  {
    roundings.clear();
    // Wide enough for the slope of a pressure between two facets to be
    // moderate against the stiffness of a body, and so narrow that the two roundings of
    // a facet are apart.
    constexpr double part_of_facet = .1;
    for (unsigned int f = 0; f + 1 < chain.facets.size(); ++f)
      roundings.push_back(part_of_facet *
                          std::min(master.facets[chain.facets[f]].measure,
                                   master.facets[chain.facets[f + 1]].measure));
  }



  template <int dim>
  double
  PointsBeforeFacets<dim>::gap_at(const std::vector<Position> &x,
                                  const Chain                 &chain,
                                  const unsigned int           facet,
                                  const bool                   may_pass) const
  {
    if constexpr (dim > 1)
      if (is_smooth && may_pass)
        {
          find_roundings(chain);
          return FacetChain<double>::gap(x, facet, roundings);
        }
    return this->gap_before(x, chain, facet);
  }



  template <int dim>
  void
  PointsBeforeFacets<dim>::find_nodes_of_rows(const std::vector<Position> &x,
                                              Step &step) const
  {
    if constexpr (dim > 1)
      {
        find_roundings(step.chain);
        const unsigned int low  = std::min(step.old_facet, step.new_facet);
        const unsigned int high = std::max(step.old_facet, step.new_facet);
        if (low > 0 &&
            FacetChain<double>::past_vertex(x, low - 1) < roundings[low - 1])
          step.first = low - 1;
        if (high + 1 < step.chain.facets.size() &&
            FacetChain<double>::past_vertex(x, high) > -roundings[high])
          step.last = high + 1;
      }
    else
      {
        (void)x;
        (void)step;
      }
  }



  template <int dim>
  void
  PointsBeforeFacets<dim>::stay_at_vertex(const unsigned int p,
                                          const double       tolerance)
  {
    if constexpr (dim > 1)
      {
        if (is_other_side(p) || is_smooth)
          return;
        if (has_other_sides())
          {
            find_valley(p, new_positions);
            if (gaps[*other_side(p)].is_before_facet)
              return;
          }
        Step        &step = steps[p];
        const auto  &x    = gather_all(p, step.chain, new_positions);
        const double small =
          tolerance * master.facets[step.chain.facets[step.old_facet]].measure;
        const auto is_at = [&](const unsigned int facet) {
          return std::abs(FacetChain<double>::gap(x, facet) -
                          FacetChain<double>::gap(x, facet + 1)) < small;
        };
        if ((step.old_facet > 0 && is_at(step.old_facet - 1)) ||
            (step.old_facet + 1 < step.chain.facets.size() &&
             is_at(step.old_facet)))
          step.may_pass = false;
      }
    else
      {
        (void)p;
        (void)tolerance;
      }
  }



  template <int dim>
  template <typename Number>
  void
  PointsBeforeFacets<dim>::compute_rows(const unsigned int p,
                                        ChainRows<Number> &rows,
                                        const Caution      caution) const
  {
    const Step        &step  = steps[p];
    const unsigned int first = step.first;
    const unsigned int n     = step.last - first + dim + 1;

    gather_all(p, step.chain, old_positions);
    old_work.assign(1, work[0]);
    old_work.insert(old_work.end(),
                    work.begin() + 1 + first,
                    work.begin() + first + n);
    gather_all(p, step.chain, new_positions);
    std::vector<std::array<Number, dim>> *new_x = nullptr;
    if constexpr (std::is_same<Number, double>::value)
      {
        work.erase(work.begin() + 1, work.begin() + 1 + first);
        work.resize(n);
        new_x = &work;
      }
    else
      {
        differentiable_work.resize(n);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int c = 0; c < dim; ++c)
            differentiable_work[i][c] = Number(static_cast<int>(n * dim),
                                               static_cast<int>(i * dim + c),
                                               work[i == 0 ? 0 : first + i][c]);
        new_x = &differentiable_work;
      }

    if constexpr (dim == 1)
      {
        const double normal =
          master.facets[step.chain.facets[step.old_facet]].normal[0];
        rows.normal        = {Number(normal), Number(-normal)};
        rows.tangential    = {Number(0.), Number(0.)};
        rows.new_gap       = normal * ((*new_x)[0][0] - (*new_x)[1][0]);
        rows.gap_increment = normal *
          (((*new_x)[0][0] - old_work[0][0]) -
           ((*new_x)[1][0] - old_work[1][0]));
        rows.slip = Number(0.);
      }
    else
      {
        if (is_rounded(step))
          {
            find_roundings(step.chain);
            roundings.erase(roundings.begin(), roundings.begin() + first);
          }
        FacetChain<Number>(old_work,
                           *new_x,
                           caution,
                           is_rounded(step) ? &roundings : nullptr,
                           open_ends(p, step.chain, first, step.last))
          .evaluate(step.old_facet - first, step.new_facet - first, rows);
      }
  }



  template <int dim>
  void
  PointsBeforeFacets<dim>::update(const unsigned int p) const
  {
    Step &step = steps[p];
    if (step.up_to_date)
      return;
    step.up_to_date = true;
    compute_rows<double>(p, chain_rows);

    Rows &rows = step.rows;
    rows.unknowns.clear();
    rows.normal.clear();
    rows.tangential[0].clear();
    rows.coverage.clear();
    step.coordinate.clear();
    step.factor.clear();
    rows.gap_increment = chain_rows.gap_increment;
    rows.slip[0]       = chain_rows.slip;
    const auto add     = [&](const auto        &node,
                         const unsigned int i,
                         const double       factor) {
      for (unsigned int c = 0; c < dim; ++c)
        {
          rows.unknowns.push_back(node.unknowns[c]);
          rows.normal.push_back(factor * chain_rows.normal[i * dim + c]);
          rows.tangential[0].push_back(factor *
                                       chain_rows.tangential[i * dim + c]);
          if (!chain_rows.coverage.empty())
            rows.coverage.push_back(factor * chain_rows.coverage[i * dim + c]);
          step.coordinate.push_back(i * dim + c);
          step.factor.push_back(factor);
        }
    };
    for (const auto &[node, weight] : own_points[p].nodes)
      add(slave.nodes[node], 0, weight);
    const unsigned int first = step.first;
    for (unsigned int i = 1; i * dim < chain_rows.normal.size(); ++i)
      add(master.nodes[step.chain.nodes[first + i - 1]], i, 1.);
    double square = 0.;
    for (unsigned int c = 0; c < dim; ++c)
      square += chain_rows.normal[c] * chain_rows.normal[c];
    for (unsigned int c = 0; c < dim; ++c)
      rows.direction[c] = chain_rows.normal[c] / std::sqrt(square);
  }



  template <int dim>
  const typename PointsBeforeFacets<dim>::Rows &
  PointsBeforeFacets<dim>::rows(const unsigned int p) const
  {
    update(p);
    return steps[p].rows;
  }



  template <int dim>
  const typename PointsBeforeFacets<dim>::Derivatives &
  PointsBeforeFacets<dim>::derivatives(const unsigned int  p,
                                       const Coefficients &coefficients,
                                       const Caution       caution) const
  {
    update(p);
    compute_rows<Differentiable>(p, differentiable_rows, caution);
    const auto        &all       = differentiable_rows;
    const Step        &step      = steps[p];
    const unsigned int m         = step.coordinate.size();
    const bool         is_at_end = !all.coverage.empty();
    result.coverage.resize(is_at_end ? m : 0);
    result.gap.resize(m);
    result.slip[0].resize(m);
    result.forces.resize(m * m);
    for (unsigned int a = 0; a < m; ++a)
      {
        const unsigned int i = step.coordinate[a];
        result.gap[a]        = step.factor[a] * all.new_gap.dx(i);
        result.slip[0][a]    = step.factor[a] * all.slip.dx(i);
        if (is_at_end)
          result.coverage[a] = step.factor[a] * all.new_coverage.dx(i);
        for (unsigned int b = 0; b < m; ++b)
          {
            const unsigned int j = step.coordinate[b];
            double             derivative =
              coefficients.traction[0] * all.tangential[i].dx(j) -
              coefficients.pressure * all.normal[i].dx(j);
            if (is_at_end)
              derivative += coefficients.energy * all.coverage[i].dx(j);
            result.forces[a * m + b] =
              step.factor[a] * step.factor[b] * derivative;
          }
      }
    return result;
  }



  template <int dim>
  int
  PointsBeforeFacets<dim>::passage(const unsigned int p) const
  {
    const Step &step = steps[p];
    if (is_rounded(step))
      return 1 + step.chain.facets[step.old_facet];
    return step.new_facet == step.old_facet
      ? 0
      : 1 + step.chain.facets[step.new_facet];
  }



  template <int dim>
  std::vector<typename PointsBeforeFacets<dim>::Index>
  PointsBeforeFacets<dim>::unknowns_nearby(const unsigned int p) const
  {
    const Step        &step = steps[p];
    std::vector<Index> indices;
    const auto         add = [&](const auto &node) {
      indices.insert(indices.end(), node.unknowns.begin(), node.unknowns.end());
    };
    for (const auto &node : own_points[p].nodes)
      add(slave.nodes[node.first]);
    for (const auto index : own_points[p].multipliers)
      if (index != numbers::invalid_dof_index)
        indices.push_back(index);
    const unsigned int first = std::min(step.old_facet, step.new_facet);
    const unsigned int last  = std::max(step.old_facet, step.new_facet);
    for (unsigned int n = first > 0 ? first - 1 : 0;
         n < std::min<std::size_t>(last + dim + 1, step.chain.nodes.size());
         ++n)
      add(master.nodes[step.chain.nodes[n]]);
    std::sort(indices.begin(), indices.end());
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    return indices;
  }



  template <int dim>
  double
  PointsBeforeFacets<dim>::round_off(const unsigned int p) const
  {
    // Round-off of a difference of positions, each of which is a reference
    // position plus a displacement.
    double         size  = 0.;
    const Step    &step  = steps[p];
    const auto    &chain = step.chain;
    const Position y = this->position_of(own_points[p], new_positions.slave);
    const unsigned int n = own_points[p].nodes[0].first;
    for (unsigned int c = 0; c < dim; ++c)
      size += std::abs(y[c]) + std::abs(slave.nodes[n].reference_position[c]) +
        std::abs(new_positions.master[chain.nodes[step.new_facet]][c]);
    return 2. * std::numeric_limits<double>::epsilon() * size;
  }


  template class PointsBeforeFacets<1>;
  template class PointsBeforeFacets<2>;
} // namespace Ricochet
