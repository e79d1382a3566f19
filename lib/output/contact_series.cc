// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/treatments/contact_sum.h>
#include <output/contact_series.h>
#include <output/hdf5_image.h>
#include <output/make_folder.h>

#include <deal.II/base/mpi.h>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Lists of all ranks one after the other, on the first one.
    std::vector<double>
    gathered(const std::vector<double> &mine, const MPI_Comm communicator)
    {
      std::vector<double> all;
      for (const auto &list : Utilities::MPI::gather(communicator, mine))
        all.insert(all.end(), list.begin(), list.end());
      return all;
    }

    /// Contact points of this rank as lists.
    struct Points
    {
      std::vector<double> position, gap, normal_force, area, active;
    };
  } // namespace



  template <int dim>
  ContactSeries<dim>::ContactSeries(
    const Body<dim>                                 &body,
    ContactOperator                                 &contact,
    const std::map<types::boundary_id, std::string> &names,
    RunFolder                                       &folder,
    const Units                                     &units)
    : body(body)
    , contact(contact)
    , names(names)
    , folder(folder)
    , units(units)
  {}



  template <int dim>
  void
  ContactSeries<dim>::write(const State &state, const unsigned int step)
  {
    std::map<std::string, Points> points;
    for (const auto &entry : names)
      points[entry.second];
    contact.summary({state.solution,
                     state.contact_force,
                     state.time,
                     &state.contact_shares,
                     [&](const ContactPointValues &values) {
                       Points &own = points.at(names.at(values.boundary_id));
                       for (unsigned int c = 0; c < dim; ++c)
                         own.position.push_back(values.position[c]);
                       own.gap.push_back(values.gap);
                       own.normal_force.push_back(values.force);
                       own.area.push_back(values.area);
                       own.active.push_back(values.is_active);
                     }});

    const MPI_Comm communicator = folder.communicator;
    const bool     is_root      = folder.is_root;
    Hdf5Image      image;
    const auto     add = [&](const std::string         &path,
                         const std::vector<double> &mine,
                         const unsigned int         n_columns,
                         const std::string         &unit) {
      const std::vector<double> all = gathered(mine, communicator);
      if (is_root)
        image.add(path, all, n_columns, units.name(unit));
    };
    const std::string area_unit = dim == 3 ? "m^2" : dim == 2 ? "m" : "1";
    for (const auto &[name, own] : points)
      {
        add(name + "/position", own.position, dim, "m");
        add(name + "/gap", own.gap, 1, "m");
        add(name + "/normal_force", own.normal_force, 1, "N");
        add(name + "/area", own.area, 1, area_unit);
        add(name + "/active", own.active, 1, "1");
      }
    if (nodes.empty())
      nodes = nodes_of_parts(body, 1, 0, 1);
    const auto add_nodal_data = [&](const std::string &group,
                                    const Vector      &force) {
      std::vector<double> position, own_force, displacement;
      for (const PartNode<dim> &node : nodes)
        {
          Tensor<1, dim> own;
          for (unsigned int c = 0; c < dim; ++c)
            own[c] = -force(node.indices[c]);
          if (own.norm_square() == 0.)
            continue;
          for (unsigned int c = 0; c < dim; ++c)
            {
              position.push_back(node.position[c]);
              own_force.push_back(own[c]);
              displacement.push_back(state.solution(node.indices[c]));
            }
        }
      add(group + "nodes", position, dim, "m");
      add(group + "nodal_force", own_force, dim, "N");
      add(group + "nodal_displacement", displacement, dim, "m");
    };
    if (state.contact_shares.empty())
      add_nodal_data(points.size() == 1 ? points.begin()->first + "/" : "",
                     state.contact_force);
    else
      {
        // The same name may belong to several of them.
        std::map<unsigned int, std::string> name_of_share;
        std::map<std::string, Vector>       forces;
        for (const auto &[id, name] : names)
          name_of_share[id >> ContactSum::boundary_bits] = name;
        for (const auto &[k, name] : name_of_share)
          if (const auto entry = forces.emplace(name, state.contact_shares[k]);
              !entry.second)
            entry.first->second += state.contact_shares[k];
        for (const auto &[name, force] : forces)
          add_nodal_data(name + "/", force);
      }
    make_folder(folder, "contact");
    on_first_rank(communicator, [&]() {
      image.add_attribute("time", state.time);
      image.add_attribute("step", step);
      write_atomically(folder.file("contact/step-" +
                                   Utilities::int_to_string(step, 6) + ".h5"),
                       image.bytes());
    });
  }



  template class ContactSeries<1>;
  template class ContactSeries<2>;
  template class ContactSeries<3>;
} // namespace Ricochet
