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
  /// Contact sparsity and properties of contact in tangents, constant in a run.
  struct ContactStructure
  {
    /// All rows that contact may change, the same list on all ranks, in the
    /// order in which contact is expected to spread.
    std::vector<dealii::types::global_dof_index> rows;

    /// The rows of the contact Jacobian H (functionals), and the order in which
    /// contact is expected to spread over them; none if only the changed rows of
    /// the tangent are known. Those of a contact that eliminates rows are
    /// orthonormal.
    struct ActsThrough
    {
      Functionals         functionals;
      std::vector<double> order;
    };
    std::optional<ActsThrough> functionals;

    /// Whether contact's part of the tangent is symmetric.
    bool is_symmetric = false;
    /// Whether contact has unknowns of its own.
    bool has_multipliers = false;
    /// Whether contact couples unknowns that the body does not couple, with a
    /// variable pattern.
    bool couplings_change = false;
    /// Whether contact eliminates rows of the body and replaces them by its
    /// own.
    bool eliminates_rows = false;
  };

  /// Cache key of the body's part of a tangent: the weights of its terms.
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

  /// The matrix of one Newton iteration: its assembly, and the cache keys of
  /// the parts that do not change with every state.
  struct Tangent
  {
    /// Cache key of the body; none if the body is not linear.
    std::optional<BodyKey> body;
    /// Cache key of contact (active-set hash); none if the tangent changes with
    /// every state.
    std::optional<std::uint64_t> contact;

    /// A number that changes with the sparsity pattern.
    std::uint64_t pattern = 0;
    /// Scaling of rows to forces: 1 for displacements, a stiffness for
    /// multipliers.
    const Vector *row_scaling = nullptr;

    /// Overwrite a matrix with the body's part.
    std::function<void(Matrix &)> assemble_body;
    /// The body's part as a sum, if it is linear, without clamping.
    MatrixSum body_terms;
    /// Add contact.
    std::function<void(Matrix &)> add_contact;
    /// Add the derivatives of open contact alone (contact-free tangent).
    std::function<void(Matrix &)> add_open_contact;
    /// The difference of add_contact and add_open_contact: this rank's rows of matrices
    /// C and E between the rows h_i of the contact Jacobian, for the sum over all ranks
    /// of C_ij h_i h_j^T and, where contact eliminates rows, of E_ij h_i h_j^T K with
    /// the body's matrix K.
    std::function<void(std::vector<FunctionalRow> &,
                       std::vector<FunctionalRow> &)>
      differentiate_contact;
  };
} // namespace Ricochet

#endif
