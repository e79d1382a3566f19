// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_facet_patches_h
#define ricochet_contact_surfaces_facet_patches_h

#include <contact/surfaces/contact_surface.h>

#include <deal.II/base/bounding_box.h>

namespace Ricochet
{
  /**
   * The facets of a surface in patches of neighbours, each of which is on one
   * rank: so ranks find the facets near their own part of the other surface,
   * although each rank has the positions of its own patches only. Only boxes
   * are sent, and only those of patches that come near.
   */
  template <int dim>
  class FacetPatches
  {
  public:
    using Positions = std::vector<std::array<double, dim>>;
    using Box       = dealii::BoundingBox<dim>;

    /// Every rank makes the same patches. @p surface is held by reference.
    FacetPatches(const ContactSurface<dim> &surface,
                 const MPI_Comm             communicator);

    unsigned int
    size() const
    {
      return facets.size();
    }

    const std::vector<unsigned int> &
    facets_of(const unsigned int patch) const
    {
      return facets[patch];
    }

    unsigned int
    patch_of(const unsigned int facet) const
    {
      return patch_of_facet[facet];
    }

    /// Whether the cells behind it are this rank's.
    bool
    is_own(const unsigned int patch) const
    {
      return owner[patch] == this_rank;
    }

    /// The patches with facets that are reached from the facets of @p patch in @p n_steps
    /// steps to one with a common node; itself included.
    std::vector<unsigned int>
    around(const unsigned int patch, const unsigned int n_steps) const;

    /// The patches of any rank that may come within @p distance (m) of one of @p places,
    /// of this rank, while nodes go from positions @p from straight to @p to, of which
    /// those of own patches are read. In ascending order. Collective.
    std::vector<unsigned int>
    near(const std::vector<Box> &places,
         const double            distance,
         const Positions        &from,
         const Positions        &to) const;

  private:
    const ContactSurface<dim>             &surface;
    const MPI_Comm                         communicator;
    const unsigned int                     this_rank;
    std::vector<std::vector<unsigned int>> facets;
    std::vector<unsigned int>              owner;
    std::vector<unsigned int>              patch_of_facet;
    std::vector<std::vector<unsigned int>> facets_at_node;
  };

  /// @p facets of @p surface in groups of neighbours, none of which is large.
  template <int dim>
  std::vector<std::vector<unsigned int>>
  groups_of_neighbours(const ContactSurface<dim> &surface,
                       std::vector<unsigned int>  facets);

  /// Box swept by @p facets of @p surface while nodes move from positions @p
  /// from straight to @p to.
  template <int dim>
  dealii::BoundingBox<dim>
  box_of_facets(const ContactSurface<dim>                  &surface,
                const std::vector<unsigned int>            &facets,
                const std::vector<std::array<double, dim>> &from,
                const std::vector<std::array<double, dim>> &to);
} // namespace Ricochet

#endif
