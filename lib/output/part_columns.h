// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_part_columns_h
#define ricochet_output_part_columns_h

#include <output/momenta.h>
#include <problems/time_loop.h>

#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * Contributions of each of several bodies, each of one or several parts, to
   * the energies and momenta in the ledger: columns kinetic_energy_NAME,
   * elastic_energy_NAME, contact_work_NAME (what the body has given to others
   * through contact, friction included), momentum_x_NAME, ...,
   * angular_momentum_NAME, and momentum_x, ..., angular_momentum for all
   * together. The sum of the first three changes by the work from outside and
   * by viscosity only. One body has the last ones only.
   */
  template <int dim>
  class PartColumns
  {
  public:
    /// @param system the equation of motion of the bodies.
    /// @param names of the bodies.
    /// @param first_part of each body, and the number of all parts; empty where each body
    /// is one. All must outlive the object.
    PartColumns(const Body<dim>                &body,
                SemiDiscreteSystem             &system,
                const bool                      small_strains,
                const std::vector<std::string> &names,
                std::vector<unsigned int>       first_part = {});

    /// This object must outlive @p loop, and be asked for the works of bodies by the system
    /// from then on.
    void
    add_to(TimeLoop &loop) const;

    /// Columns of body @p p.
    const Momenta<dim> &
    momenta(const unsigned int p) const
    {
      return momenta_of_parts[p];
    }

    /// Columns of all bodies together.
    const Momenta<dim> &
    momenta() const
    {
      return momenta_of_all;
    }

  private:
    /// Unknowns of this rank that follow each other and belong to one body.
    struct Run
    {
      unsigned int body, begin, end;

      unsigned int
      size() const
      {
        return end - begin;
      }
    };

    /// Energies of each body (J).
    struct Energies
    {
      std::vector<double> kinetic, elastic;
    };

    Energies
    energies(const State &state) const;

    /// The work of @p force (N) along the displacement from @p begin to @p end of each
    /// body (J).
    std::vector<double>
    works(const Vector &force, const Vector &begin, const Vector &end) const;

    static std::vector<Run>
    runs_of(const std::vector<unsigned int> &body_of_unknown);

    SemiDiscreteSystem             &system;
    const MPI_Comm                  communicator;
    const std::vector<std::string>  names;
    const std::vector<unsigned int> first_part;
    const std::vector<Run>          runs;
    std::vector<Momenta<dim>>       momenta_of_parts;
    Momenta<dim>                    momenta_of_all;
    // Work space.
    mutable Vector momentum;
  };
} // namespace Ricochet

#endif
