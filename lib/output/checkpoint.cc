// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/vector_operations.h>
#include <output/checkpoint.h>

#include <deal.II/base/utilities.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <functional>
#include <sstream>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    const std::string magic     = "Ricochet checkpoint, format 17\n";
    const std::string file_name = "checkpoint.bin";

    /// The vectors of a checkpoint, in the order in which they are stored.
    template <typename CheckpointType, typename Visitor>
    void
    for_each_vector(CheckpointType &checkpoint, const Visitor &visit)
    {
      visit(checkpoint.state.solution);
      visit(checkpoint.state.velocity);
      visit(checkpoint.state.acceleration);
      visit(checkpoint.state.contact_force);
      visit(checkpoint.state.mean_velocity);
      visit(checkpoint.state.scheme_force);
      for (auto *part : {&checkpoint.state.friction_force,
                         &checkpoint.state.viscous_force,
                         &checkpoint.state.solution_before,
                         &checkpoint.state.velocity_before})
        if (part->size() > 0)
          visit(*part);
      for (auto &share : checkpoint.state.contact_shares)
        visit(share);
      if (checkpoint.tangent.exists())
        visit(checkpoint.tangent.solution);
    }

    /// The beginning of a line that may be anything.
    std::string
    printable(std::string line)
    {
      constexpr std::size_t longest = 120;
      std::replace_if(
        line.begin(),
        line.end(),
        [](const char c) { return c < ' ' || c > '~'; },
        '?');
      return line.size() > longest ? line.substr(0, longest) + "..." : line;
    }

    /// Contents of the file, apart from magic, size and checksum.
    struct Payload
    {
      std::string   parameters;
      std::uint64_t mesh = 0;
      /// CheckpointMesh::multipliers
      std::vector<types::global_dof_index> multipliers;
      /// CheckpointMesh::contact_names
      std::vector<std::string> contact_names;
      /// Number of contact forces, which are the last values except for the tangent's.
      unsigned int          n_shares = 0;
      unsigned int          step     = 0;
      double                time = 0., step_before = 0.;
      std::vector<double>   sums;
      unsigned int          n_rows   = 0;
      std::uint32_t         checksum = 0;
      FrozenTangent::Record tangent;
      /// The vectors, in the canonical order of the unknowns.
      std::vector<std::vector<double>> values;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &parameters &mesh &multipliers &contact_names &n_shares &step
          &time &step_before &sums &n_rows &checksum &tangent &values;
      }
    };

    const std::string strange =
      "is damaged: its content is none of a checkpoint";

    /// All contents of a file. Every rank reads the whole file. @p fail (why) throws.
    Payload
    read_payload(const std::string                              &file,
                 const std::function<void(const std::string &)> &fail)
    {
      std::string bytes;
      try
        {
          bytes = read_file(file);
        }
      catch (const InputError &)
        {
          fail(std::filesystem::exists(file) ? "cannot be read"
                                             : "does not exist");
        }
      std::uint64_t     size = 0;
      std::uint32_t     crc  = 0;
      const std::size_t head = magic.size() + sizeof(size) + sizeof(crc);
      if (bytes.compare(0, magic.size(), magic) != 0 || bytes.size() < head)
        fail("is no checkpoint of this version of Ricochet");
      std::memcpy(&size, bytes.data() + magic.size(), sizeof(size));
      std::memcpy(&crc,
                  bytes.data() + magic.size() + sizeof(size),
                  sizeof(crc));
      bytes.erase(0, head);
      if (bytes.size() != size)
        fail("is truncated: it holds " + std::to_string(bytes.size()) + " of " +
             std::to_string(size) + " bytes");
      if (checksum(bytes) != crc)
        fail("is damaged: its checksum is wrong");

      Payload            payload;
      std::istringstream data(bytes);
      // The checksum would suffice for a file written by a run; this one may come
      // from elsewhere.
      try
        {
          boost::archive::binary_iarchive archive(data);
          archive >> payload;
        }
      catch (const std::exception &)
        {
          fail(strange);
        }
      return payload;
    }
  } // namespace



  CheckpointMesh::CheckpointMesh(const SemiDiscreteSystem::Unknowns &unknowns,
                                 const MPI_Comm communicator)
    : positions(unknowns.canonical_positions())
    , checksum(unknowns.mesh_checksum())
    , contact_names(unknowns.contact_names)
  {
    // The last unknowns of each rank.
    const std::vector<types::global_dof_index> own(
      positions.end() - unknowns.multipliers.n_elements(),
      positions.end());
    for (const auto &list : Utilities::MPI::all_gather(communicator, own))
      multipliers.insert(multipliers.end(), list.begin(), list.end());
    std::sort(multipliers.begin(), multipliers.end());
  }



  CheckpointMotion
  CheckpointMotion::read(const std::string    &folder,
                         const Vector         &layout,
                         const CheckpointMesh &mesh)
  {
    const std::string file =
      (std::filesystem::path(folder) / file_name).string();
    const auto fail = [&](const std::string &why) {
      throw InputError(
        "Start/From: the checkpoint '" + file + "' " + why +
        (std::filesystem::exists(file)
           ? "."
           : "; runs with Output/Checkpoint every = 1 or more have one."));
    };
    const Payload payload = read_payload(file, fail);
    if (mesh.checksum != payload.mesh)
      fail(
        "belongs to other bodies: nodes, materials' numbers or boundaries are not those "
        "of this scene");

    CheckpointMotion motion;
    motion.time          = payload.time;
    motion.contact_names = payload.contact_names;
    // For each own unknown k its number among all multipliers; none for displacements.
    const auto for_each_unknown = [&](const auto &of_displacement,
                                      const auto &of_multiplier) {
      for (std::size_t k = 0; k < mesh.positions.size(); ++k)
        {
          const auto        own    = std::lower_bound(mesh.multipliers.begin(),
                                            mesh.multipliers.end(),
                                            mesh.positions[k]);
          const std::size_t number = own - mesh.multipliers.begin();
          if (own == mesh.multipliers.end() || *own != mesh.positions[k])
            of_displacement(k, mesh.positions[k] - number);
          else
            of_multiplier(k, number);
        }
    };
    // Displacements have one order, whatever multipliers are between them.
    const auto take = [&](const std::vector<double> &stored, Vector &vector) {
      std::vector<double> displacements;
      auto                next = payload.multipliers.begin();
      for (types::global_dof_index k = 0; k < stored.size(); ++k)
        if (next != payload.multipliers.end() && *next == k)
          ++next;
        else
          displacements.push_back(stored[k]);
      vector.reinit(layout);
      if (displacements.size() + mesh.multipliers.size() != vector.size())
        fail("has " + std::to_string(displacements.size()) +
             " displacements, this scene has " +
             std::to_string(vector.size() - mesh.multipliers.size()) +
             ": it has another Mesh/Degree");
      double *values = local_values(vector);
      for_each_unknown(
        [&](const std::size_t k, const std::size_t number) {
          values[k] = displacements[number];
        },
        [](const std::size_t, const std::size_t) {});
    };
    // With and without tangential ones: that along the normal is the first of a node.
    const auto take_multipliers = [&]() {
      if (payload.contact_names != mesh.contact_names)
        return;
      const std::size_t n_there    = payload.multipliers.size(),
                        n_here     = mesh.multipliers.size();
      const std::size_t more_there = n_here == 0 ? 0 : n_there / n_here,
                        more_here  = n_there == 0 ? 0 : n_here / n_there;
      if (n_there != more_there * n_here && n_here != more_here * n_there)
        return;
      const std::vector<double> &stored = payload.values[0];
      double                    *values = local_values(motion.solution);
      for_each_unknown([](const std::size_t, const std::size_t) {},
                       [&](const std::size_t k, const std::size_t number) {
                         if (more_there > 0)
                           values[k] = stored.at(
                             payload.multipliers[number * more_there]);
                         else if (more_here > 0 && number % more_here == 0)
                           values[k] =
                             stored.at(payload.multipliers[number / more_here]);
                       });
    };
    // In the order of for_each_vector().
    const unsigned int of_force   = 3;
    const unsigned int n_tangents = payload.tangent.n_steps > 0 ? 1 : 0;
    if (payload.values.size() < std::size_t(6) + payload.n_shares + n_tangents)
      fail(strange);
    take(payload.values[0], motion.solution);
    take_multipliers();
    take(payload.values[1], motion.velocity);
    motion.contact_forces.resize(std::max(1U, payload.n_shares));
    // The only contact, of a program without names for them, or none.
    motion.contact_names.resize(motion.contact_forces.size());
    if (payload.n_shares == 0)
      take(payload.values[of_force], motion.contact_forces[0]);
    const std::size_t first =
      payload.values.size() - payload.n_shares - n_tangents;
    for (unsigned int k = 0; k < payload.n_shares; ++k)
      take(payload.values[first + k], motion.contact_forces[k]);
    return motion;
  }



  void
  Checkpoint::write(const RunFolder &folder, const CheckpointMesh &mesh) const
  {
    Payload    payload{folder.parameters_that_matter,
                    mesh.checksum,
                    mesh.multipliers,
                    mesh.contact_names,
                    static_cast<unsigned int>(state.contact_shares.size()),
                    step,
                    state.time,
                    state.step_before,
                    sums,
                    ledger.n_rows,
                    ledger.checksum,
                    tangent.record,
                    {}};
    const auto positions_of_rank =
      Utilities::MPI::gather(folder.communicator, mesh.positions);
    for_each_vector(*this, [&](const Vector &vector) {
      const double *mine           = local_values(vector);
      const auto    values_of_rank = Utilities::MPI::gather(
        folder.communicator,
        std::vector<double>(mine, mine + vector.locally_owned_size()));
      std::vector<double> &values =
        payload.values.emplace_back(folder.is_root ? vector.size() : 0);
      for (unsigned int rank = 0; rank < values_of_rank.size(); ++rank)
        for (std::size_t k = 0; k < values_of_rank[rank].size(); ++k)
          values[positions_of_rank[rank][k]] = values_of_rank[rank][k];
    });

    on_first_rank(folder.communicator, [&]() {
      std::ostringstream data;
      {
        boost::archive::binary_oarchive archive(data);
        archive << payload;
      }
      const std::string   bytes = data.str();
      const std::uint64_t size  = bytes.size();
      const std::uint32_t crc   = checksum(bytes);
      std::string         whole = magic;
      whole.append(reinterpret_cast<const char *>(&size), sizeof(size));
      whole.append(reinterpret_cast<const char *>(&crc), sizeof(crc));
      write_atomically(folder.file(file_name), whole + bytes);
    });
  }



  Checkpoint
  Checkpoint::read(const RunFolder      &folder,
                   const State          &first_state,
                   const CheckpointMesh &mesh)
  {
    const auto fail = [file = folder.file(file_name)](const std::string &why) {
      throw InputError("The run cannot be resumed: the checkpoint '" + file +
                       "' " + why + ".");
    };
    const Payload payload = read_payload(folder.file(file_name), fail);
    if (payload.parameters != folder.parameters_that_matter)
      {
        // Name the first line that differs.
        std::istringstream old_lines(payload.parameters);
        std::istringstream new_lines(folder.parameters_that_matter);
        std::string        old_line, new_line;
        while (std::getline(old_lines, old_line) &&
               std::getline(new_lines, new_line) && old_line == new_line)
          ;
        fail("belongs to a run with other parameters: it had '" +
             printable(old_line) + "', this one has '" + new_line + "'");
      }

    Checkpoint checkpoint;
    checkpoint.step       = payload.step;
    checkpoint.sums       = payload.sums;
    checkpoint.ledger     = {payload.n_rows, payload.checksum};
    checkpoint.state      = first_state;
    checkpoint.state.time = payload.time;
    if (payload.step_before > 0.)
      {
        checkpoint.state.step_before     = payload.step_before;
        checkpoint.state.solution_before = first_state.solution;
        checkpoint.state.velocity_before = first_state.velocity;
      }
    checkpoint.tangent.record = payload.tangent;
    if (checkpoint.tangent.exists())
      checkpoint.tangent.solution = first_state.solution;
    unsigned int n_vectors = 0;
    for_each_vector(checkpoint, [&](Vector &) { ++n_vectors; });
    if (payload.values.size() != n_vectors)
      fail(strange);
    if (payload.mesh != mesh.checksum)
      fail(
        "belongs to another mesh: nodes, parts or boundaries are not those that "
        "the run began with");
    auto stored = payload.values.begin();
    for_each_vector(checkpoint, [&](Vector &vector) {
      if (stored->size() != vector.size())
        fail("has " + std::to_string(stored->size()) +
             " unknowns, this run has " + std::to_string(vector.size()) +
             ": it belongs to another mesh");
      double *values = local_values(vector);
      for (std::size_t k = 0; k < mesh.positions.size(); ++k)
        values[k] = (*stored)[mesh.positions[k]];
      ++stored;
    });
    return checkpoint;
  }
} // namespace Ricochet
