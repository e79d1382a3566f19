// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_contact_schur_complement_h
#define ricochet_solvers_contact_schur_complement_h

#include <base/types.h>
#include <solvers/functional_products.h>
#include <solvers/sparse_cholesky.h>
#include <solvers/tangent_solver.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <vector>

namespace Ricochet
{
  /**
   * The contact Schur complement (Delassus operator) W = H K^{-1} H^T of a body with the
   * matrix K, for the rows h_i of the contact Jacobian H through which contact acts.
   * Solutions x = x_0 - K^{-1} H^T z of
   *
   *     K x - b + H^T z = 0,   z = contact force of H x,
   *
   * are found by their coefficients z alone.
   *
   * With the factors of SparseCholesky, W_ij = y_i^T D^{-1} y_j, where the forward
   * solves y_i = L^{-1} P h_i go through few columns of L. They are computed when first
   * needed, and kept as long as K.
   *
   * Rows have positions (places) in the order in which contact is expected to spread,
   * so that the first ones are those near contact; vectors of all rows are by
   * position. Consecutive rows are solved for together, in groups that depend on the
   * order alone, so that a resumed run repeats its digits. On one rank.
   */
  class ContactSchurComplement
  {
  public:
    /**
     * @param contact rows and their order; has to outlive this. None of the rows has
     * constrained unknowns (prescribed displacements).
     * @param spent gets the costs.
     */
    ContactSchurComplement(const ContactStructure::ActsThrough &contact,
                           const SparseCholesky::Kind           kind,
                           TangentSolver::Costs                &spent);

    /// Set K to the matrix of @p tangent with open contact.
    /// @throws NewtonFailure when it cannot be factored.
    void
    factorise(const Tangent &tangent);

    unsigned int
    n_rows() const
    {
      return jacobian.size();
    }

    /// Position of row @p f.
    unsigned int
    place(const unsigned int f) const
    {
      return places[f];
    }

    /// Begin with x_0 = K^{-1} @p right_hand_side, which is zero where displacements are
    /// prescribed.
    void
    begin(const Vector &right_hand_side);

    /// The values H x_0 in the first positions, as many as @p values has.
    void
    observe(std::vector<double> &values);

    /// @p solution = x_0 - K^{-1} H^T @p coefficients (of each row).
    void
    finish(const std::vector<double> &coefficients, Vector &solution);

    /// Add H^T @p coefficients to @p vector.
    void
    add_rows(const std::vector<double> &coefficients, Vector &vector) const;

    /// l2 norm of H^T @p coefficients, each entry times that of @p scaling (null for 1).
    double
    norm_of_rows(const std::vector<double> &coefficients,
                 const Vector              *scaling);

    /// H @p vector
    std::vector<double>
    along_rows(const Vector &vector) const;

    /// Add @p factor W @p coefficients to @p values, which may be those of the first
    /// positions only.
    void
    add_compliance(const double               factor,
                   const std::vector<double> &coefficients,
                   std::vector<double>       &values);

    /// Set the derivatives C of the coefficients with respect to H x, and E with
    /// respect to the residual along the rows, by row (see
    /// Tangent::differentiate_contact).
    /// @throws NewtonFailure when the matrix of solve_contact() is singular.
    void
    set_contact(const std::vector<FunctionalRow> &change,
                const std::vector<FunctionalRow> &excess_change);

    /// Solve
    ///
    ///     (1 + E H H^T + C W) z = @p coefficients - C @p values
    ///
    /// with the last set_contact(); the coefficients become z.
    void
    solve_contact(std::vector<double>       &coefficients,
                  const std::vector<double> &values);

  private:
    static constexpr unsigned int group_size = TriangularSolves::n_columns;

    /// The forward solves of a group.
    const TriangularSolves::ForwardColumns &
    forward_of(const unsigned int group);

    /// At least the first @p n entries of a column of W.
    const std::vector<double> &
    column(const unsigned int place, const unsigned int n);

    const Functionals      &jacobian;
    FunctionalProducts      products;
    TangentSolver::Costs   &spent;
    SparseCholesky          cholesky;
    const TriangularSolves *solves = nullptr;
    Matrix                  matrix;
    // Position of each row, and row at each position.
    std::vector<unsigned int> places, row_at;
    // Forward solves by group and columns of W by position; empty where not
    // needed yet.
    std::vector<TriangularSolves::ForwardColumns> forwards;
    std::vector<std::vector<double>>              columns;
    // Forward solve L^{-1} P of the right-hand side.
    std::vector<double> forward;
    // The blocks of the factor that observe() needs for that many positions.
    std::vector<int> region;
    unsigned int     region_places = 0;
    // The contact dofs, the index there of each entry of H, and a sum over rows.
    std::vector<unsigned int> contact_dofs, dof_of_entry;
    std::vector<double>       dof_sum;

    // The last set_contact(): positions of the rows with derivatives, C and E H H^T
    // there with columns by position, and the number of positions that C depends on.
    struct ContactRow
    {
      unsigned int  place;
      FunctionalRow on_values, on_coefficients;
    };
    std::vector<ContactRow>          contact_rows;
    unsigned int                     n_seen = 0;
    dealii::LAPACKFullMatrix<double> dense;
    // Work space.
    std::vector<double> products_of_groups, solution_in_region, compliance;
  };
} // namespace Ricochet

#endif
