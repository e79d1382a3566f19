// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <contact/kinematics/surface_pair.h>
#include <contact/surfaces/facet_search.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Unknowns of @p surface, to be added to @p indices.
    template <int dim>
    void
    add_unknowns(const ContactSurface<dim> &surface, IndexSet &indices)
    {
      for (const auto &node : surface.nodes)
        {
          indices.add_indices(node.unknowns.begin(), node.unknowns.end());
          for (const auto index : node.multipliers)
            if (index != numbers::invalid_dof_index)
              indices.add_index(index);
        }
    }

    template <int dim>
    std::vector<std::array<int, dim>>
    local_indices(const ContactSurface<dim> &surface, const Vector &ghosted)
    {
      std::vector<std::array<int, dim>> local(surface.nodes.size());
      for (unsigned int n = 0; n < local.size(); ++n)
        for (unsigned int c = 0; c < dim; ++c)
          local[n][c] = ghosted.trilinos_vector().Map().LID(
            static_cast<TrilinosWrappers::types::int_type>(
              surface.nodes[n].unknowns[c]));
      return local;
    }
  } // namespace



  template <int dim>
  SurfacePair<dim>::SurfacePair(const Body<dim>   &body,
                                const ContactPair &pair,
                                const PointsIn     points_in)
    : slave(body, pair.slave)
    , master(body, pair.master)
  {
    IndexSet relevant = body.owned_indices();
    add_unknowns(slave, relevant);
    add_unknowns(master, relevant);
    ghosted.reinit(body.owned_indices(), relevant, body.communicator);
    slave_index  = local_indices(slave, ghosted);
    master_index = local_indices(master, ghosted);
    make_points(body, points_in);
    steps.resize(own_points.size());

    bool some_face = false;
    for (const auto &facet : slave.facets)
      for (const auto &other : master.facets)
        some_face = some_face || facet.normal * other.normal < 0.;
    if (!some_face)
      throw InputError(
        "The surfaces of the contact '" + pair.name +
        "' face each other the wrong way: nowhere is the outside "
        "of one before that of the other. Is a boundary id that "
        "of the far side of a body?");
  }



  template <int dim>
  void
  SurfacePair<dim>::make_points(const Body<dim> &body, const PointsIn points_in)
  {
    const auto is_mine = [&](const unsigned int node) {
      return body.owned_indices().is_element(slave.nodes[node].unknowns[0]);
    };
    if (points_in == PointsIn::nodes)
      {
        std::vector<Point> all(slave.nodes.size());
        for (unsigned int f = 0; f < slave.facets.size(); ++f)
          for (const unsigned int n : slave.facets[f].nodes)
            {
              all[n].facets.push_back(f);
              all[n].weight += slave.facets[f].measure / dim;
              all[n].cell_diameter =
                std::max(all[n].cell_diameter, slave.facets[f].cell_diameter);
              all[n].boundary_id = slave.facets[f].boundary_id;
            }
        for (unsigned int n = 0; n < all.size(); ++n)
          if (is_mine(n))
            {
              all[n].nodes       = {{n, 1.}};
              all[n].multipliers = slave.nodes[n].multipliers;
              all[n].can_touch   = !slave.nodes[n].is_held;
              own_points.push_back(all[n]);
            }
        return;
      }
    const Quadrature<dim - 1> &rule = body.face_quadrature();
    for (unsigned int f = 0; f < slave.facets.size(); ++f)
      if (is_mine(slave.facets[f].nodes[0]))
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            Point point;
            point.facets        = {f};
            point.weight        = rule.weight(q) * slave.facets[f].measure;
            point.cell_diameter = slave.facets[f].cell_diameter;
            point.boundary_id   = slave.facets[f].boundary_id;
            point.multipliers.fill(numbers::invalid_dof_index);
            point.can_touch = false;
            if constexpr (dim == 1)
              point.nodes = {{slave.facets[f].nodes[0], 1.}};
            else
              point.nodes = {{slave.facets[f].nodes[0], 1. - rule.point(q)[0]},
                             {slave.facets[f].nodes[1], rule.point(q)[0]}};
            for (const auto &node : point.nodes)
              point.can_touch =
                point.can_touch || !slave.nodes[node.first].is_held;
            own_points.push_back(point);
          }
  }



  template <int dim>
  void
  SurfacePair<dim>::get_positions(const Vector    &solution,
                                  Positions       &positions,
                                  const Positions *start,
                                  const double     time) const
  {
    ghosted             = solution;
    const double *value = ghosted.trilinos_vector()[0];
    const auto    get   = [&](const ContactSurface<dim>               &surface,
                         const std::vector<std::array<int, dim>> &index,
                         const std::vector<Position>             *start_x,
                         std::vector<Position>                   &x) {
      x.resize(index.size());
      for (unsigned int n = 0; n < x.size(); ++n)
        for (unsigned int c = 0; c < dim; ++c)
          x[n][c] = (start_x ? (*start_x)[n][c]
                                  : surface.nodes[n].reference_position[c]) +
            time * value[index[n][c]];
    };
    get(slave, slave_index, start ? &start->slave : nullptr, positions.slave);
    get(master,
        master_index,
        start ? &start->master : nullptr,
        positions.master);
  }



  template <int dim>
  void
  SurfacePair<dim>::get_multipliers()
  {
    for (unsigned int p = 0; p < own_points.size(); ++p)
      for (unsigned int c = 0; c < dim; ++c)
        if (own_points[p].multipliers[c] != numbers::invalid_dof_index)
          steps[p].multipliers[c] = ghosted(own_points[p].multipliers[c]);
  }



  template <int dim>
  typename SurfacePair<dim>::Position
  SurfacePair<dim>::normal_of(const Point                 &point,
                              const std::vector<Position> &slave_x) const
  {
    Position sum{};
    for (const unsigned int f : point.facets)
      {
        const Position normal = facet_normal<dim>(slave, slave_x, f);
        for (unsigned int c = 0; c < dim; ++c)
          sum[c] += normal[c];
      }
    return sum;
  }



  template <int dim>
  typename SurfacePair<dim>::Position
  SurfacePair<dim>::position_of(const Point                 &point,
                                const std::vector<Position> &slave_x) const
  {
    Position y{};
    for (const auto &[node, weight] : point.nodes)
      for (unsigned int c = 0; c < dim; ++c)
        y[c] += weight * slave_x[node][c];
    return y;
  }



  template <int dim>
  typename SurfacePair<dim>::Chain
  SurfacePair<dim>::chain_around(const unsigned int f,
                                 unsigned int      &place) const
  {
    unsigned int first = f;
    for (unsigned int k = 0; k < 2; ++k)
      if (const auto previous = master.facets[first].previous)
        first = *previous;
    // A closed surface of few facets is gone round more than once.
    Chain chain;
    chain.nodes.push_back(master.facets[first].nodes[0]);
    std::optional<unsigned int> facet         = first;
    unsigned int                n_behind_last = 0;
    bool                        passed        = false;
    while (facet && n_behind_last < 3)
      {
        if (!passed && *facet == f)
          place = chain.facets.size();
        chain.facets.push_back(*facet);
        if constexpr (dim == 2)
          chain.nodes.push_back(master.facets[*facet].nodes[1]);
        passed = passed || *facet == f;
        n_behind_last += passed ? 1 : 0;
        facet = master.facets[*facet].next;
      }
    return chain;
  }



  template <int dim>
  const std::vector<typename SurfacePair<dim>::Position> &
  SurfacePair<dim>::gather(const Point     &point,
                           const Chain     &chain,
                           const Positions &positions) const
  {
    work.clear();
    work.push_back(position_of(point, positions.slave));
    for (const unsigned int node : chain.nodes)
      work.push_back(positions.master[node]);
    return work;
  }



  template <int dim>
  double
  SurfacePair<dim>::gap_before(const std::vector<Position> &x,
                               const Chain                 &chain,
                               const unsigned int           facet) const
  {
    if constexpr (dim == 1)
      return master.facets[chain.facets[facet]].normal[0] * (x[0][0] - x[1][0]);
    else
      return FacetChain<double>::gap(x, facet);
  }



  template <int dim>
  unsigned int
  SurfacePair<dim>::facet_before(const std::vector<Position> &x,
                                 const unsigned int           facet) const
  {
    if constexpr (dim == 1)
      return facet;
    else
      return FacetChain<double>::facet_before(x, facet);
  }



  template <int dim>
  unsigned int
  SurfacePair<dim>::last_facet(const std::vector<Position> &x,
                               const Step                  &step) const
  {
    // Where two facets meet, their gaps differ by so little that the energy does not
    // notice.
    constexpr double margin = 1e-8;
    if constexpr (dim > 1)
      if (step.may_pass)
        return FacetChain<double>::facet_before(x, step.old_facet, margin);
    return step.old_facet;
  }



  template <int dim>
  bool
  SurfacePair<dim>::may_pass(const std::vector<Position> &x,
                             const unsigned int           facet) const
  {
    if constexpr (dim == 1)
      return false;
    else
      return FacetChain<double>::is_between_bisectors(x, facet);
  }



  template <int dim>
  bool
  SurfacePair<dim>::is_off(const std::vector<Position> &x,
                           const Chain                 &chain,
                           const unsigned int           facet) const
  {
    if constexpr (dim == 1)
      return false;
    else
      {
        const auto     &own = master.facets[chain.facets[facet]];
        const Position &a = x[facet + 1], &b = x[facet + 2];
        const double    length = std::hypot(b[0] - a[0], b[1] - a[1]);
        const double    along  = ((b[0] - a[0]) * (x[0][0] - a[0]) +
                              (b[1] - a[1]) * (x[0][1] - a[1])) /
          length;
        // Edges of bodies of the same size may meet.
        const double tolerance = 1e-6 * length;
        if ((!own.previous && along < -tolerance) ||
            (!own.next && along > length + tolerance))
          return true;
        // Past a vertex points may be as far as its bisector leads; what is farther
        // off the ends of the facet than before it is beside it.
        const double beside = std::max(-along, along - length);
        return beside >
          1.5 * std::abs(gap_before(x, chain, facet)) + .5 * length;
      }
  }



  template <int dim>
  void
  SurfacePair<dim>::begin_step(const ContactStart &start)
  {
    get_positions(start.solution, old_positions);
    get_multipliers();
    const bool has_length = start.time_step > 0.;
    Positions  middle, end;
    if (has_length)
      {
        get_positions(start.mean_velocity,
                      middle,
                      &old_positions,
                      .5 * start.time_step);
        get_positions(start.mean_velocity,
                      end,
                      &old_positions,
                      start.time_step);
      }
    const FacetSearch<dim> search(master, old_positions.master);
    const std::unique_ptr<FacetSearch<dim>> later = has_length
      ? std::make_unique<FacetSearch<dim>>(master, end.master)
      : nullptr;

    for (unsigned int p = 0; p < own_points.size(); ++p)
      {
        const Point &point   = own_points[p];
        Step        &step    = steps[p];
        step.is_before_facet = false;
        step.up_to_date      = false;
        if (!point.can_touch)
          continue;
        find_facet_now(point, search, step);
        if (has_length && !(step.is_before_facet && step.old_gap <= 0.))
          find_facet_later(point, *later, end, step);
        if (!step.is_before_facet)
          continue;
        step.new_facet     = step.old_facet;
        step.new_gap       = step.old_gap;
        step.predicted_gap = step.old_gap;
        if (has_length)
          {
            const auto &x      = gather(point, step.chain, middle);
            step.predicted_gap = gap_before(x, step.chain, last_facet(x, step));
          }
      }
    new_positions = old_positions;
  }



  template <int dim>
  void
  SurfacePair<dim>::find_facet_now(const Point            &point,
                                   const FacetSearch<dim> &search,
                                   Step                   &step) const
  {
    const auto found =
      search.closest_facing(position_of(point, old_positions.slave),
                            normal_of(point, old_positions.slave));
    if (!found)
      return;
    unsigned int place = 0;
    step.chain         = chain_around(*found, place);
    const auto &x      = gather(point, step.chain, old_positions);
    step.old_facet     = facet_before(x, place);
    step.may_pass      = may_pass(x, step.old_facet);
    step.old_gap       = gap_before(x, step.chain, step.old_facet);
    // Contact does not reach through a body.
    const double depth =
      master.facets[step.chain.facets[step.old_facet]].measure;
    step.is_before_facet =
      step.old_gap > -depth && !is_off(x, step.chain, step.old_facet);
  }



  template <int dim>
  void
  SurfacePair<dim>::find_facet_later(const Point            &point,
                                     const FacetSearch<dim> &search,
                                     const Positions        &later,
                                     Step                   &step) const
  {
    const auto found = search.closest_facing(position_of(point, later.slave),
                                             normal_of(point, later.slave));
    if (!found)
      return;
    unsigned int       place = 0;
    Chain              chain = chain_around(*found, place);
    const unsigned int facet = facet_before(gather(point, chain, later), place);
    if (is_off(work, chain, facet))
      return;
    // The way there, from where the point is now; should it not be before this part
    // of the surface yet, along this facet.
    const auto        &x     = gather(point, chain, old_positions);
    const unsigned int first = facet_before(x, facet);
    const bool passes = may_pass(x, first) && gap_before(x, chain, first) > 0.;
    const unsigned int old_facet = passes ? first : facet;
    const double       old_gap   = gap_before(x, chain, old_facet);
    if (!(old_gap > 0.))
      return;
    step.is_before_facet = true;
    step.chain           = std::move(chain);
    step.old_facet       = old_facet;
    step.may_pass        = passes;
    step.old_gap         = old_gap;
  }



  template <int dim>
  void
  SurfacePair<dim>::evaluate(const Vector &solution)
  {
    get_positions(solution, new_positions);
    get_multipliers();
    for (unsigned int p = 0; p < own_points.size(); ++p)
      {
        Step &step = steps[p];
        if (!step.is_before_facet)
          continue;
        const auto &x   = gather(own_points[p], step.chain, new_positions);
        step.new_facet  = last_facet(x, step);
        step.new_gap    = gap_before(x, step.chain, step.new_facet);
        step.up_to_date = false;
      }
  }



  template <int dim>
  void
  SurfacePair<dim>::stay_at_vertex(const unsigned int p, const double tolerance)
  {
    if constexpr (dim > 1)
      {
        Step        &step = steps[p];
        const auto  &x    = gather(own_points[p], step.chain, new_positions);
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
  SurfacePair<dim>::compute_rows(const unsigned int p,
                                 Rows<Number>      &rows,
                                 const bool         freeze_convex) const
  {
    const Step        &step  = steps[p];
    const unsigned int first = std::min(step.old_facet, step.new_facet);
    const unsigned int last  = std::max(step.old_facet, step.new_facet);
    const unsigned int n     = last - first + dim + 1;

    gather(own_points[p], step.chain, old_positions);
    old_work.assign(1, work[0]);
    old_work.insert(old_work.end(),
                    work.begin() + 1 + first,
                    work.begin() + first + n);
    gather(own_points[p], step.chain, new_positions);
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
      FacetChain<Number>(old_work, *new_x, freeze_convex)
        .evaluate(step.old_facet - first, step.new_facet - first, rows);
  }



  template <int dim>
  void
  SurfacePair<dim>::update(const unsigned int p) const
  {
    Step &step = steps[p];
    if (step.up_to_date)
      return;
    step.up_to_date = true;
    compute_rows<double>(p, step.rows);

    Unknowns &unknowns = step.unknowns;
    unknowns.index.clear();
    unknowns.coordinate.clear();
    unknowns.factor.clear();
    const auto add =
      [&](const auto &node, const unsigned int i, const double factor) {
        for (unsigned int c = 0; c < dim; ++c)
          {
            unknowns.index.push_back(node.unknowns[c]);
            unknowns.coordinate.push_back(i * dim + c);
            unknowns.factor.push_back(factor);
          }
      };
    for (const auto &[node, weight] : own_points[p].nodes)
      add(slave.nodes[node], 0, weight);
    const unsigned int first = std::min(step.old_facet, step.new_facet);
    for (unsigned int i = 1; i * dim < step.rows.normal.size(); ++i)
      add(master.nodes[step.chain.nodes[first + i - 1]], i, 1.);
  }



  template <int dim>
  const typename SurfacePair<dim>::template Rows<double> &
  SurfacePair<dim>::rows(const unsigned int p) const
  {
    update(p);
    return steps[p].rows;
  }



  template <int dim>
  const typename SurfacePair<dim>::template Rows<
    typename SurfacePair<dim>::Differentiable> &
  SurfacePair<dim>::differentiated_rows(const unsigned int p,
                                        const bool         freeze_convex) const
  {
    compute_rows<Differentiable>(p, differentiable_rows, freeze_convex);
    return differentiable_rows;
  }



  template <int dim>
  const typename SurfacePair<dim>::Unknowns &
  SurfacePair<dim>::unknowns(const unsigned int p) const
  {
    update(p);
    return steps[p].unknowns;
  }



  template <int dim>
  std::vector<types::global_dof_index>
  SurfacePair<dim>::unknowns_nearby(const unsigned int p) const
  {
    const Step                          &step = steps[p];
    std::vector<types::global_dof_index> indices;
    const auto                           add = [&](const auto &node) {
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
  SurfacePair<dim>::round_off(const unsigned int p) const
  {
    // A difference of positions, each of which is that of the reference and a
    // displacement.
    double             size  = 0.;
    const Step        &step  = steps[p];
    const auto        &chain = step.chain;
    const Position     y     = position_of(own_points[p], new_positions.slave);
    const unsigned int n     = own_points[p].nodes[0].first;
    for (unsigned int c = 0; c < dim; ++c)
      size += std::abs(y[c]) + std::abs(slave.nodes[n].reference_position[c]) +
        std::abs(new_positions.master[chain.nodes[step.new_facet]][c]);
    return 2. * std::numeric_limits<double>::epsilon() * size;
  }


  template class SurfacePair<1>;
  template class SurfacePair<2>;
} // namespace Ricochet
