// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_checkpoint_h
#define ricochet_output_checkpoint_h

#include <output/energy_ledger.h>
#include <time_integration/semi_discrete_system.h>

namespace Ricochet
{
  /// The mesh and the unknowns as stored in checkpoints, for any number of
  /// ranks.
  struct CheckpointMesh
  {
    /// Body::canonical_positions()
    std::vector<dealii::types::global_dof_index> positions;
    /// Body::mesh_checksum()
    std::uint64_t checksum = 0;

    /// Collective.
    explicit CheckpointMesh(const SemiDiscreteSystem::Unknowns &unknowns)
      : positions(unknowns.canonical_positions())
      , checksum(unknowns.mesh_checksum())
    {}
  };

  /// All data that a run needs to continue as if it had not been stopped.
  struct Checkpoint
  {
    /// Number of the last step that is complete.
    unsigned int step = 0;
    /// Sums that the time loop carries.
    std::vector<double> sums;
    /// Identification of the energy table.
    EnergyLedger::Seal ledger;
    State              state;
    /// SemiDiscreteSystem::frozen_tangent
    FrozenTangent tangent;

    /**
     * Write to @p folder / checkpoint.bin, so that there is a complete
     * checkpoint at any time.
     *
     * @throws ComputationError on all ranks, when the disk is full.
     */
    void
    write(const RunFolder &folder, const CheckpointMesh &mesh) const;

    /**
     * Read what write() has written, on any number of ranks and with the same
     * parameters (except for final time, output and solvers).
     *
     * @param first_state that of this run at its beginning, for the layout.
     * @throws InputError no checkpoint, truncated or damaged, other parameters, another
     * mesh.
     */
    static Checkpoint
    read(const RunFolder      &folder,
         const State          &first_state,
         const CheckpointMesh &mesh);
  };
} // namespace Ricochet

#endif
