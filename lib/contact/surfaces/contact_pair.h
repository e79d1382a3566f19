// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_contact_pair_h
#define ricochet_contact_surfaces_contact_pair_h

#include <deal.II/base/types.h>

#include <functional>
#include <set>
#include <string>

namespace Ricochet
{
  /// Two surfaces that may touch, of different bodies or of one.
  struct ContactPair
  {
    /// For the columns of the ledger.
    std::string name;
    /// Boundary ids of the surface in whose points contact is formulated
    /// (slave), and of the one whose facets they are projected on (master). The
    /// slave should be the softer body.
    std::set<dealii::types::boundary_id> slave, master;

    /// One surface, that of one or several bodies, against itself: each of its nodes
    /// is kept from penetrating any of its facets. Slave and master are the
    /// same then.
    bool is_self = false;

    /// One of several pairs of a contact, whose surfaces need not face each other.
    bool is_part = false;

    /// Gaps are counted from this depth on: by so much facets that are chords of arcs overlap
    /// before any displacement where one surface fits into the other (m).
    double overlap = 0.;

    /// Interference (m) at a time (s), by which gaps are smaller: a bore that is too narrow;
    /// empty for none. Treatments that act over a step need one that is constant.
    std::function<double(const double time)> interference = {};

    /// The set of multipliers of the slave's nodes, see Body.
    unsigned int multiplier_set = 0;
  };

  /// The surface of the boundary @p ids that may touch itself.
  inline ContactPair
  touching_itself(const std::set<dealii::types::boundary_id> &ids)
  {
    return {"itself", ids, ids, /* is_self = */ true};
  }
} // namespace Ricochet

#endif
