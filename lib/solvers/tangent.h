// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_tangent_h
#define ricochet_solvers_tangent_h

#include <base/types.h>
#include <solvers/functionals.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace Ricochet
{
  /// How contact enters tangents, the same in all of a run.
  struct ContactStructure
  {
    /// All rows that contact may change, the same list on all ranks, in the
    /// order in which contact is expected to spread.
    std::vector<dealii::types::global_dof_index> rows;

    /// The functionals through which contact acts, and the order in which it is
    /// expected to spread; none if only the rows are known. Those of a contact that
    /// takes rows are orthonormal.
    struct ActsThrough
    {
      Functionals         functionals;
      std::vector<double> order;
    };
    std::optional<ActsThrough> functionals;

    /// The part of contact in the tangent is symmetric.
    bool is_symmetric = false;
    /// It brings unknowns of its own.
    bool has_multipliers = false;
    /// It couples unknowns that the body does not couple, and not always the same.
    bool couplings_change = false;
    /// It takes rows of the body out, and puts its own there.
    bool eliminates_rows = false;
  };

  /// What names the body's part of a tangent: the weights of its terms.
  struct BodyKey
  {
    double inertia;
    double bulk;
    double contact;

    bool
    operator==(const BodyKey &other) const
    {
      return inertia == other.inertia && bulk == other.bulk &&
        contact == other.contact;
    }
  };

  /// The matrix of one Newton iteration: how it is made, and the names of what
  /// does not change with every state.
  struct Tangent
  {
    /// None if the body is not linear.
    std::optional<BodyKey> body;
    /// State of contact; none if the tangent changes with every state.
    std::optional<std::uint64_t> contact;

    /// Another number for another sparsity pattern.
    std::uint64_t pattern = 0;
    /// What makes its rows those of forces: 1 for displacements, a stiffness for
    /// multipliers.
    const Vector *row_scaling = nullptr;

    /// Overwrite a matrix with the body's part.
    std::function<void(Matrix &)> assemble_body;
    /// The body's part as a sum, if it is linear, as if no unknown were clamped.
    MatrixSum body_terms;
    /// Add contact.
    std::function<void(Matrix &)> add_contact;
    /// Add the derivatives of open contact alone.
    std::function<void(Matrix &)> add_open_contact;
    /// The difference of that and add_contact: the rows of matrices C and E between
    /// the functionals f_i that this rank knows, for the sum of C_ij f_i f_j^T and of what
    /// other ranks add, and, where contact takes rows, of E_ij f_i f_j^T K with the
    /// body's matrix K.
    std::function<void(std::vector<FunctionalRow> &,
                       std::vector<FunctionalRow> &)>
      differentiate_contact;
  };
} // namespace Ricochet

#endif
