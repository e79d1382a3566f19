// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <contact/surfaces/contact_surface.h>
#include <problems/clearance.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// The same on all ranks: the first text that is not empty.
    std::string
    first_text(const std::string &text, const MPI_Comm communicator)
    {
      for (const std::string &one :
           Utilities::MPI::all_gather(communicator, text))
        if (!one.empty())
          return one;
      return "";
    }

    template <int dim>
    bool
    is_inside(const Body<dim>                                      &body,
              const typename DoFHandler<dim>::active_cell_iterator &cell,
              const Tensor<1, 3>                                   &x)
    {
      Point<dim> point;
      for (unsigned int c = 0; c < dim; ++c)
        point[c] = x[c];
      if (!cell->bounding_box().point_inside(point))
        return false;
      try
        {
          return cell->reference_cell().contains_point(
            body.mapping().transform_real_to_unit_cell(cell, point));
        }
      catch (const typename Mapping<dim>::ExcTransformationFailed &)
        {
          return false;
        }
    }
  } // namespace



  void
  check_motions(const SchemeTraits &scheme, const Obstacles &obstacles)
  {
    if (!scheme.needs_potential)
      return;
    std::string allowed;
    for (const SchemeTraits &other : all_scheme_traits())
      if (!other.needs_potential)
        allowed += (allowed.empty() ? "" : ", ") + other.name;
    for (const auto &entry : obstacles)
      if (!entry.second->motion().is_at_rest())
        throw InputError(
          "The time scheme " + scheme.name +
          " cannot be combined with an obstacle that moves: it "
          "reads the work of contact off a potential.\nAllowed: " +
          allowed + ".");
  }



  template <int dim>
  void
  check_clearance(const Body<dim> &body, const Obstacles &obstacles)
  {
    for (const auto &entry : obstacles)
      {
        const RigidObstacle &obstacle  = *entry.second;
        const Placement      placement = obstacle.motion().placement(0.);
        double               overlap   = 0.;
        std::string          problem;
        const Tensor<1, 3>   centre =
          placement.push_forward(obstacle.shape().centre());
        const bool has_inside = obstacle.gap(centre, 0.) < 0.;
        for (const auto &cell : body.dof_handler().active_cell_iterators())
          {
            if (!cell->is_locally_owned())
              continue;
            for (const unsigned int v : cell->vertex_indices())
              {
                const Tensor<1, 3> x   = in_space<dim>(cell->vertex(v));
                const double       gap = obstacle.gap(x, 0.);
                if (problem.empty())
                  problem = obstacle.shape().problem_at(placement.pull_back(x));
                // A little is that of a mesh, whose vertices lie where they lie.
                if (-gap > 1e-3 * cell->diameter())
                  overlap = std::max(overlap, -gap);
              }
            if (has_inside && overlap == 0. && is_inside(body, cell, centre))
              overlap = -obstacle.gap(centre, 0.);
          }
        problem = first_text(problem, body.communicator);
        if (!problem.empty())
          throw InputError(problem);
        overlap = Utilities::MPI::max(overlap, body.communicator);
        if (overlap > 0.)
          throw InputError(
            "At the start the body overlaps with the obstacle "
            "of boundary " +
            std::to_string(entry.first) + " by " + to_text(overlap) +
            " m. Move one of them away.");
      }
  }


  namespace
  {
    /// How far @p x is within @p cell, whose faces are straight (m): negative
    /// outside.
    template <int dim>
    double
    depth_inside(const typename DoFHandler<dim>::active_cell_iterator &cell,
                 const Point<dim>                                     &x)
    {
      double depth = std::numeric_limits<double>::max();
      for (const auto &face : cell->face_iterators())
        {
          Tensor<1, dim> outward;
          if constexpr (dim == 1)
            outward[0] = 1.;
          else
            outward = cross_product_2d(face->vertex(1) - face->vertex(0));
          if (outward * (face->center() - cell->center()) < 0.)
            outward *= -1.;
          depth =
            std::min(depth, outward * (face->vertex(0) - x) / outward.norm());
        }
      return depth;
    }
  } // namespace



  template <int dim>
  void
  check_clearance(const Body<dim> &body, const std::vector<ContactPair> &pairs)
  {
    for (const ContactPair &pair : pairs)
      {
        std::set<types::boundary_id> boundaries = pair.slave;
        boundaries.insert(pair.master.begin(), pair.master.end());
        const ContactSurface<dim> surface(body, boundaries);
        std::string               problem;
        for (const auto &cell : body.dof_handler().active_cell_iterators())
          if (cell->is_locally_owned())
            for (const auto &node : surface.nodes)
              {
                const Point<dim> &x = node.reference_position;
                if (!cell->bounding_box().point_inside(x))
                  continue;
                // Nodes on faces touch; a little is that of a mesh.
                const double depth = depth_inside<dim>(cell, x);
                if (depth > 1e-6 * cell->diameter())
                  {
                    std::string text;
                    for (unsigned int c = 0; c < dim; ++c)
                      text += (c == 0 ? "" : ", ") + to_text(x[c]);
                    problem = "At the start bodies overlap: the node at (" +
                      text + ") m of the contact '" + pair.name + "' is " +
                      to_text(depth) +
                      " m or more inside another one. Move one of them away.";
                  }
              }
        problem = first_text(problem, body.communicator);
        if (!problem.empty())
          throw InputError(problem);
      }
  }


  template void
  check_clearance(const Body<1> &, const std::vector<ContactPair> &);
  template void
  check_clearance(const Body<2> &, const std::vector<ContactPair> &);
  template void
  check_clearance(const Body<1> &, const Obstacles &);
  template void
  check_clearance(const Body<2> &, const Obstacles &);
  template void
  check_clearance(const Body<3> &, const Obstacles &);
} // namespace Ricochet
