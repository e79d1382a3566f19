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
    /// Positions of multipliers on all ranks, in ascending order.
    std::vector<dealii::types::global_dof_index> multipliers;
    /// Body::mesh_checksum()
    std::uint64_t checksum = 0;
    /// SemiDiscreteSystem::Unknowns::contact_names
    std::vector<std::string> contact_names;

    /// Collective.
    CheckpointMesh(const SemiDiscreteSystem::Unknowns &unknowns,
                   const MPI_Comm                      communicator);
  };

  /// The motion at the last checkpoint of a run, in the displacements of another one.
  struct CheckpointMotion
  {
    /// s
    double time = 0.;
    /// Displacements (m) and, where both runs have the same contacts, multipliers (Pa).
    Vector solution;
    /// m/s
    Vector velocity;
    /// The force (N) of each contact, and its name.
    std::vector<Vector>      contact_forces;
    std::vector<std::string> contact_names;

    /**
     * Read it from the output folder @p folder of any run with the same bodies, whatever
     * its treatments, conditions, loads and number of ranks.
     *
     * @param layout a system vector of this run.
     * @throws InputError no checkpoint, truncated or damaged, or another mesh.
     */
    static CheckpointMotion
    read(const std::string    &folder,
         const Vector         &layout,
         const CheckpointMesh &mesh);
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
