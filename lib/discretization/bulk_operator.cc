// SPDX-License-Identifier: LGPL-2.1-or-later
#include <discretization/bulk_operator.h>
#include <solvers/body_matrix.h>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// @p tangent += the @p terms of a linear body.
    void
    add_terms(const MatrixSum &terms, Matrix &tangent)
    {
      AssertThrow(!terms.empty(), ExcMessage("This body has no such tangent."));
      for (const MatrixTerm &term : terms)
        term.matrix->add_to(term.weight, tangent);
    }
  } // namespace



  void
  BulkOperator::add_tangent(const double factor,
                            const Vector & /*solution*/,
                            Matrix &tangent) const
  {
    add_terms(tangent_terms(factor), tangent);
  }



  void
  BulkOperator::add_step_tangent(const Vector & /*old_solution*/,
                                 const Vector & /*new_solution*/,
                                 const double time_step,
                                 Matrix      &tangent) const
  {
    add_terms(step_tangent_terms(time_step), tangent);
  }



  void
  BulkOperator::add_viscous_tangent(const double factor,
                                    const Vector & /*rate_origin*/,
                                    const Vector & /*solution*/,
                                    const double rate_time,
                                    Matrix      &tangent) const
  {
    add_terms(viscous_tangent_terms(factor, rate_time), tangent);
  }
} // namespace Ricochet
