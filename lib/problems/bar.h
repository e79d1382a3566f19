// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_bar_h
#define ricochet_problems_bar_h

#include <exact_solutions/bar_characteristics.h>
#include <problems/impact.h>

#include <deal.II/distributed/shared_tria.h>

namespace Ricochet
{
  /**
   * Common parts of the two benchmarks of a unit bar with unit modulus and
   * density: parameters, mesh, columns of the ledger, error norm. Defaults are
   * those of paper C, sections 4.1 and 4.2.
   */
  struct BarParameters
  {
    ImpactParameters impact;
    /// m
    double       mesh_size = .05;
    unsigned int degree    = 1;

    /// lambda + 2 mu of the bar (Pa).
    static constexpr double modulus = 1.;

    void
    add_parameters(dealii::ParameterHandler &parameters);

    /// @throws InputError mesh size that does not divide the bar, combination
    /// without meaning.
    void
    validate() const;

    std::vector<UnusedParameter>
    unused_parameters() const
    {
      return impact.unused_parameters();
    }
  };

  /// Boundary ids of the ends of the bar.
  namespace BarEnds
  {
    constexpr dealii::types::boundary_id left  = 0;
    constexpr dealii::types::boundary_id right = 1;
  } // namespace BarEnds

  /// The bar 0 < x < 1 in elements of length @p mesh_size; every rank stores
  /// the whole mesh and works on its part.
  void
  make_bar_grid(const double                                mesh_size,
                dealii::parallel::shared::Triangulation<1> &triangulation);

  /**
   * Add to the ledger of @p loop, for the end @p end called "left" or "right":
   * displacement and velocity, computed and exact, and the exact pressure.
   * @p body and @p exact must live as long as the loop.
   */
  void
  add_bar_end_columns(const dealii::types::boundary_id end,
                      const Body<1>                   &body,
                      BarCharacteristics              &exact,
                      TimeLoop                        &loop);

  /// Add the column `h1_error`: the H^1 norm of the error at each time.
  void
  add_bar_error_column(const Body<1>      &body,
                       BarCharacteristics &exact,
                       TimeLoop           &loop);

  /// The norm of the error in L^2(0, T; H^1) over the run of @p loop, by the
  /// rectangle rule (paper C, figure 10).
  double
  bar_error_norm(const double time_step, const TimeLoop &loop);
} // namespace Ricochet

#endif
