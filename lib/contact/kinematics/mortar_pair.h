// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_mortar_pair_h
#define ricochet_contact_kinematics_mortar_pair_h

#include <contact/kinematics/mortar_shape.h>
#include <contact/kinematics/pair_before_chains.h>
#include <contact/surfaces/facet_chain.h>

#include <Sacado_Fad_SLFad.hpp>

namespace Ricochet
{
  /**
   * Contact of two surfaces in 2D in the weak sense (mortar): a pressure that is a
   * sum of shape functions psi_j of the slave's nodes, and in each node j the mean
   * of the gap with the weight psi_j,
   *
   *     gap_j = 1/m_j int psi_j gap ds,   m_j = int psi_j ds   (undeformed lengths).
   *
   * The facets of the slave are cut where the opposite facet of the master changes,
   * on the bisectors of its vertices. Between the cuts gap and rows are polynomials
   * along the facet, and two Gauss points integrate them exactly: a uniform pressure
   * passes whatever the meshes are.
   *
   * Points of the slave pass vertices during a step as in FacetChain. Facets are cut
   * where that happens at the beginning of the step and at its end. So in each Gauss
   * point D . change is the change of the gap, and, since both integrals are exact,
   * in each node that of gap_j, which depends on the positions of the bodies alone.
   * Only where a part of a facet leaves the end of the master, the gap at the end of
   * a step differs from that at the beginning of the next one.
   *
   * The dependence of the cuts on the displacement is left out of the derivatives:
   * rows are continuous there, so that only the error of the quadrature is missing
   * where a vertex is passed.
   *
   * Literature: A. Popp, M. Gitterle, M. Gee, W. Wall, A dual mortar approach for 3D
   * finite deformation contact with consistent linearization, Int. J. Numer. Meth.
   * Engng 83 (2010); here without condensation of the multipliers.
   */
  class MortarPair : public PairBeforeChains<2>
  {
  public:
    /// @throws InputError see SurfacePair.
    MortarPair(const Body<2>     &body,
               const ContactPair &pair,
               const MortarShape  shape);

    void
    begin_step(const ContactStart &start) override;

    void
    evaluate(const Vector &solution) override;

    const Rows &
    rows(const unsigned int p) const override;

    const Derivatives &
    derivatives(const unsigned int  p,
                const Coefficients &coefficients,
                const Caution       caution) const override;

    std::vector<Index>
    unknowns_nearby(const unsigned int p) const override;

    double
    round_off(const unsigned int p) const override;

  private:
    static constexpr unsigned int max_coordinates = 14;
    using Differentiable = Sacado::Fad::SLFad<double, max_coordinates>;

    /// A part of a facet of the slave that faces one facet of the master at the
    /// beginning of the step. Coordinates along the facet go from 0 to 1.
    struct Interval
    {
      double begin = 0., end = 1.;
      Chain  chain;
      /// Index of the facet of the master in the chain.
      unsigned int old_facet = 0;
      /// The interval may pass vertices.
      bool may_pass = false;
    };

    /// A Gauss point: its rows are on the point and some nodes of a chain.
    struct GaussPoint
    {
      /// Index among the intervals of its facet.
      unsigned int interval = 0;
      double       s        = 0.;
      /// m
      double       weight    = 0.;
      unsigned int new_facet = 0;

      bool                     up_to_date = false;
      FacetChain<double>::Rows rows;
    };

    /// A facet of the slave that has a node of this rank.
    struct SlaveFacet
    {
      unsigned int            number = 0;
      std::vector<Interval>   intervals;
      std::vector<GaussPoint> points;
      /// Number of #points in use.
      unsigned int n_points = 0;
      /// The whole facet faces the master.
      bool is_covered = false;
    };

    /// The facets of a point, and which of their nodes it is.
    struct Support
    {
      unsigned int facet = 0, end = 0;
    };

    Position
    position_on(const SlaveFacet &facet,
                const double      s,
                const Positions  &positions) const;

    /// psi of the node @p end of @p facet.
    double
    psi(const SlaveFacet &facet, const unsigned int end, const double s) const;

    /// The positions of the cuts of @p facet, for the nodes at @p positions: 0,
    /// ..., 1.
    void
    find_cuts(const SlaveFacet     &facet,
              const Positions      &positions,
              const FacetSearch<2> &search,
              std::vector<double>  &cuts) const;

    void
    find_intervals(SlaveFacet           &facet,
                   const FacetSearch<2> &search,
                   const Positions      *later,
                   const FacetSearch<2> *search_later) const;

    /// Gauss points between @p begin and @p end.
    void
    add_points(SlaveFacet        &facet,
               const unsigned int interval,
               const double       begin,
               const double       end,
               const unsigned int new_facet) const;

    /// Gauss points of all intervals, cut where vertices are passed at the end of the
    /// step.
    void
    place_points(SlaveFacet &facet) const;

    /// Mean of the gap of a point, by the present Gauss points.
    double
    mean_gap(const unsigned int p,
             const Positions   &positions,
             const bool         at_end) const;

    /// Positions of @p point and of the nodes between which it passes, in #work. @return
    /// the number of the first of the chain's facets.
    unsigned int
    gather_passage(const SlaveFacet &facet,
                   const GaussPoint &point,
                   const Positions  &positions) const;

    const FacetChain<double>::Rows &
    rows_of(SlaveFacet &facet, GaussPoint &point) const;

    /// Call @p add (unknown, coordinate in the rows of the Gauss point, factor) for
    /// all unknowns of a Gauss point.
    template <typename Function>
    void
    for_each_unknown(const SlaveFacet &facet,
                     const GaussPoint &point,
                     const Function   &add) const;

    /// Index of an unknown in @p rows; an unknown that is missing is appended.
    static unsigned int
    place_of(const Index unknown, Rows &rows);

    const MortarShape                 shape;
    mutable std::vector<SlaveFacet>   facets;
    std::vector<std::vector<Support>> supports;
    Positions                         old_positions, new_positions;
    mutable std::vector<Rows>         all_rows;
    mutable std::vector<bool>         up_to_date;
    mutable std::vector<Position>     old_work;
    mutable std::vector<std::array<Differentiable, 2>> differentiable_work;
    mutable FacetChain<Differentiable>::Rows           differentiable_rows;
    mutable std::vector<unsigned int>                  places, coordinates;
    mutable std::vector<double>                        factors;
    mutable Derivatives                                result;
  };
} // namespace Ricochet

#endif
