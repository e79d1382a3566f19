// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/obstacles/half_space.h>
#include <base/exceptions.h>
#include <contact/treatments/contact_sum.h>
#include <discretization/boundary_load.h>
#include <discretization/hyperelastic_bulk.h>
#include <discretization/linear_bulk.h>
#include <problems/clearance.h>
#include <problems/impact.h>
#include <time_integration/mass_redistribution.h>

#include <algorithm>


namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// The boundaries on which contact is formulated.
    template <int dim>
    typename Body<dim>::BoundaryIds
    contact_ids(const ImpactSetup<dim> &setup)
    {
      typename Body<dim>::BoundaryIds ids;
      for (const auto &obstacle : setup.obstacles)
        ids.insert(obstacle.first);
      for (const ContactPair &pair : setup.pairs)
        ids.insert(pair.slave.begin(), pair.slave.end());
      return ids;
    }

    /// All boundaries that something is said about.
    template <int dim>
    typename Body<dim>::BoundaryIds
    named_ids(const ImpactSetup<dim> &setup)
    {
      typename Body<dim>::BoundaryIds ids = contact_ids(setup);
      ids.insert(setup.clamped.begin(), setup.clamped.end());
      for (const ContactPair &pair : setup.pairs)
        ids.insert(pair.master.begin(), pair.master.end());
      for (const auto &entry : setup.imposed)
        ids.insert(entry.first);
      for (const auto &entry : setup.tractions)
        ids.insert(entry.first);
      return ids;
    }

    template <int dim>
    typename Body<dim>::HeldComponents
    held_components(const ImpactSetup<dim> &setup)
    {
      typename Body<dim>::HeldComponents held;
      for (const auto &[id, imposed] : setup.imposed)
        held[id] = imposed.components;
      return held;
    }

    /// Where conditions meet, zero comes first, then the smaller boundary id.
    template <int dim>
    std::vector<typename Impact<dim>::Prescription>
    make_prescriptions(const Body<dim> &body, const ImpactSetup<dim> &setup)
    {
      std::map<types::global_dof_index, typename Impact<dim>::Prescription> all;
      for (const auto &[id, imposed] : setup.imposed)
        for (unsigned int c = 0; c < dim; ++c)
          if (imposed.components[c])
            for (const auto unknown : body.boundary_displacements(id, c))
              all.insert({unknown, {unknown, c, imposed.value}});
      for (const auto id : setup.clamped)
        for (unsigned int c = 0; c < dim; ++c)
          for (const auto unknown : body.boundary_displacements(id, c))
            all.erase(unknown);
      std::vector<typename Impact<dim>::Prescription> list;
      for (const auto &entry : all)
        list.push_back(entry.second);
      return list;
    }

    template <int dim>
    bool
    is_moved(const ImpactSetup<dim> &setup)
    {
      for (const auto &entry : setup.imposed)
        if (entry.second.value)
          return true;
      return false;
    }

    template <int dim>
    std::vector<Material<dim>>
    materials_of(const ImpactSetup<dim> &setup)
    {
      std::vector<Material<dim>> materials;
      for (const Part<dim> &part : setup.parts)
        {
          materials.push_back(part.material);
          if (part.material.linear.has_value() !=
              materials[0].linear.has_value())
            throw InputError(
              "The parts '" + setup.parts[0].name + "' and '" + part.name +
              "' cannot be combined: one is linear elastic, the other is not. "
              "Take Saint Venant-Kirchhoff instead of linear elastic.");
        }
      if (materials.empty())
        materials.push_back(setup.material);
      return materials;
    }

    template <int dim>
    std::vector<double>
    densities_of(const ImpactSetup<dim> &setup)
    {
      std::vector<double> densities;
      for (const Part<dim> &part : setup.parts)
        densities.push_back(part.density);
      if (densities.empty())
        densities.push_back(setup.density);
      return densities;
    }

    /// The mesh has each of the @p boundaries. @return the mesh.
    template <int dim>
    const Triangulation<dim> &
    with_boundaries(const Triangulation<dim>              &triangulation,
                    const typename Body<dim>::BoundaryIds &boundaries,
                    const MPI_Comm                         communicator)
    {
      for (const auto id : boundaries)
        {
          bool found = false;
          for (const auto &cell : triangulation.active_cell_iterators())
            if (cell->is_locally_owned())
              for (const auto &face : cell->face_iterators())
                found =
                  found || (face->at_boundary() && face->boundary_id() == id);
          if (Utilities::MPI::max(found ? 1 : 0, communicator) == 0)
            throw InputError("The mesh has no boundary with the id " +
                             std::to_string(id) +
                             ", which should touch an obstacle or be held.");
        }
      return triangulation;
    }

    /// A field that is @p value everywhere, zero in multipliers.
    template <int dim>
    Vector
    uniform_field(const Body<dim> &body, const Tensor<1, dim> &value)
    {
      Vector vector;
      body.interpolate(Functions::ConstantFunction<dim>(
                         std::vector<double>(value.begin_raw(),
                                             value.end_raw())),
                       vector);
      return vector;
    }

    template <int dim>
    Vector
    weight_of(const Body<dim>      &body,
              const Matrix         &mass,
              const Tensor<1, dim> &gravity)
    {
      Vector weight = body.make_vector();
      if (gravity != Tensor<1, dim>())
        mass.vmult(weight, uniform_field(body, gravity));
      return weight;
    }

    template <int dim>
    std::unique_ptr<BulkOperator>
    make_bulk(const Body<dim>                  &body,
              const std::vector<Material<dim>> &materials)
    {
      // Each cell has a material.
      body.parts_of_unknowns(materials.size());
      if constexpr (dim > 1)
        if (!materials[0].linear)
          return std::make_unique<HyperelasticBulk<dim>>(body, materials);
      return std::make_unique<LinearBulk<dim>>(body, materials);
    }

    template <int dim>
    std::unique_ptr<ContactOperator>
    make_contact_on_cut_faces(const ImpactParameters &parameters,
                              const Body<dim>        &body,
                              const ImpactSetup<dim> &setup)
    {
      std::vector<LinearElastic> materials;
      for (const Material<dim> &material : materials_of(setup))
        {
          if (!material.linear)
            throw InputError(
              "Contact/Coupling = cut faces is for linear elastic bodies, whose "
              "displacements are small. For others take points or mortar.");
          materials.push_back(*material.linear);
        }
      if (!setup.obstacles.empty())
        throw InputError(
          "Contact/Coupling = cut faces cannot be combined with "
          "rigid obstacles.");
      if (setup.degree > 1)
        throw InputError(
          "Contact/Coupling = cut faces needs displacements of degree 1.");
      for (const ContactPair &pair : setup.pairs)
        if (pair.is_self)
          throw InputError(
            "A surface that may touch itself goes with Contact/Coupling = points "
            "only.");
      if constexpr (dim == 2)
        return make_cut_face_contact(parameters.contact,
                                     scheme_traits(parameters.scheme.name),
                                     body,
                                     materials,
                                     setup.pairs);
      else
        throw InputError("Contact/Coupling = cut faces is there in 2D only.");
    }

    template <int dim>
    std::unique_ptr<ContactOperator>
    make_any_contact(const ImpactParameters &parameters,
                     const Body<dim>        &body,
                     const ImpactSetup<dim> &setup)
    {
      const SchemeTraits &scheme = scheme_traits(parameters.scheme.name);
      const auto          with_obstacles = [&]() {
        return make_contact(parameters.contact,
                            scheme,
                            body,
                            setup.material.linear
                                       ? LinearStress<dim>(*setup.material.linear)
                                       : LinearStress<dim>(),
                            setup.obstacles);
      };
      if (setup.pairs.empty())
        return with_obstacles();
      check_pair_combination(parameters.contact,
                             scheme,
                             setup.pairs.front().is_self);
      if (parameters.contact.coupling == "cut faces")
        return make_contact_on_cut_faces(parameters, body, setup);
      auto between = make_pair_contact(parameters.contact, body, setup.pairs);
      if (setup.obstacles.empty())
        return between;
      // Multipliers are where surfaces touch each other.
      if (body.has_multipliers())
        for (const auto &obstacle : setup.obstacles)
          if (std::none_of(setup.pairs.begin(),
                           setup.pairs.end(),
                           [&](const ContactPair &pair) {
                             return pair.slave.count(obstacle.first) > 0;
                           }))
            throw InputError(
              "With constraints between surfaces a boundary that can touch a "
              "rigid obstacle has to be a slave, too; the boundary " +
              std::to_string(obstacle.first) + " is not.");
      return std::make_unique<ContactSum<dim>>(with_obstacles(),
                                               std::move(between),
                                               body.communicator);
    }

    /// What @p setup adds to the external loads, but for the weight.
    template <int dim>
    SemiDiscreteSystem::Load
    make_load(const Body<dim> &body, const ImpactSetup<dim> &setup)
    {
      if (setup.tractions.empty())
        return setup.load;
      struct Term
      {
        Vector                                              shape;
        unsigned int                                        component;
        std::function<dealii::Tensor<1, dim>(const double)> traction;
      };
      std::vector<Term> terms;
      for (const auto &[id, traction] : setup.tractions)
        for (unsigned int c = 0; c < dim; ++c)
          terms.push_back({boundary_load(body, id, c), c, traction});
      return [terms, load = setup.load](const double time, Vector &result) {
        if (load)
          load(time, result);
        for (const Term &term : terms)
          result.add(term.traction(time)[term.component], term.shape);
      };
    }
  } // namespace



  template <int dim>
  Impact<dim>::Impact(const ImpactParameters   &parameters,
                      const Triangulation<dim> &triangulation,
                      const ImpactSetup<dim>   &setup,
                      const MPI_Comm            communicator)
    : body(with_boundaries(triangulation, named_ids(setup), communicator),
           setup.degree,
           setup.clamped,
           contact_ids(setup),
           setup.pairs.empty() ? multiplier_space(parameters.contact)
                               : pair_multiplier_space(parameters.contact),
           communicator,
           held_components(setup),
           setup.geometry.get())
    , bulk(make_bulk(body, materials_of(setup)))
    , consistent_mass(assemble_mass_matrix(body, densities_of(setup)))
    , redistributed_mass(
        parameters.redistributed_mass()
          ? std::make_unique<Matrix>(redistribute_mass(body, consistent_mass))
          : nullptr)
    , obstacles(setup.obstacles)
    , pairs(setup.pairs)
    , parts(setup.parts)
    , contact(make_any_contact(parameters, body, setup))
    , weight(weight_of(body, consistent_mass, setup.gravity))
    , prescriptions(make_prescriptions(body, setup))
    , system(redistributed_mass ? *redistributed_mass : consistent_mass,
             consistent_mass,
             *bulk,
             *contact,
             {parameters.redistributed_mass()
                ? body.contact_indices()
                : IndexSet(body.contact_indices().size()),
              body.clamped_indices(),
              body.multiplier_indices(),
              dim,
              &body.sparsity_pattern(),
              [this]() { return body.canonical_positions(); },
              [this]() { return body.coarse_space(); },
              is_moved(setup) ? [this](const double time,
                                       Vector &vector) { impose(time, vector); }
                              : std::function<void(const double, Vector &)>(),
              [this, step = 1e-3 * parameters.time.time_step](
                const double time, Vector &vector) {
                impose_rate(time, step, vector);
              }},
             setup.gravity == Tensor<1, dim>()
               ? make_load(body, setup)
               : [this, load = make_load(body, setup)](const double time,
                                                       Vector &result) {
                   if (load)
                     load(time, result);
                   result += weight;
                 },
             parameters.newton,
             parameters.linear_solver)
    , scheme(make_time_scheme(parameters.scheme))
  {
    check_motions(scheme_traits(parameters.scheme.name), obstacles);
    if (is_moved(setup) &&
        !scheme_traits(parameters.scheme.name).contact_over_step)
      throw InputError(
        "An imposed displacement cannot be combined with the time "
        "scheme '" +
        parameters.scheme.name +
        "'.\nAllowed with it: midpoint, which knows the work of "
        "its reaction.");
  }



  template <int dim>
  void
  Impact<dim>::impose(const double time, Vector &vector) const
  {
    for (const Prescription &prescription : prescriptions)
      vector(prescription.unknown) = prescription.value
        ? prescription.value(time)[prescription.component]
        : 0.;
    vector.compress(VectorOperation::insert);
  }



  template <int dim>
  void
  Impact<dim>::impose_rate(const double time,
                           const double step,
                           Vector      &vector) const
  {
    // A motion need not be known before it begins.
    for (const Prescription &prescription : prescriptions)
      vector(prescription.unknown) = prescription.value
        ? ((-1.5 * prescription.value(time) +
            2. * prescription.value(time + step) -
            .5 * prescription.value(time + 2. * step)) /
           step)[prescription.component]
        : 0.;
    vector.compress(VectorOperation::insert);
  }


  template <int dim>
  Vector
  Impact<dim>::uniform(const Tensor<1, dim> &value) const
  {
    return uniform_field(body, value);
  }



  template <int dim>
  State
  Impact<dim>::state_in_flight(const Tensor<1, dim> &velocity)
  {
    return state_in_motion(Functions::ConstantFunction<dim>(
      std::vector<double>(velocity.begin_raw(), velocity.end_raw())));
  }



  template <int dim>
  State
  Impact<dim>::state_in_motion(const Function<dim> &velocity)
  {
    Vector start;
    body.interpolate(velocity, start);
    return state_with(start);
  }



  template <int dim>
  State
  Impact<dim>::state_of_parts()
  {
    // Nodes of parts that touch are in one place and move differently.
    const std::vector<unsigned int> part_of =
      body.parts_of_unknowns(parts.size());
    Vector start = body.make_vector();
    for (unsigned int p = 0; p < parts.size(); ++p)
      {
        const Vector velocity = uniform(parts[p].velocity);
        for (unsigned int i = 0; i < part_of.size(); ++i)
          if (part_of[i] == p)
            start.trilinos_vector()[0][i] = velocity.trilinos_vector()[0][i];
      }
    return state_with(start);
  }



  template <int dim>
  State
  Impact<dim>::state_with(const Vector &velocity)
  {
    check_clearance(body, obstacles);
    check_clearance(body, pairs);
    return system.initial_state(uniform(Tensor<1, dim>()),
                                velocity,
                                /* time */ 0.);
  }



  template <int dim>
  Obstacles
  foundation_below(const types::boundary_id boundary_id)
  {
    Tensor<1, dim> up;
    up[dim - 1] = 1.;
    return {{boundary_id, half_space_at_rest<dim>(Point<dim>(), up)}};
  }


  template struct Impact<1>;
  template struct Impact<2>;
  template struct Impact<3>;
  template Obstacles
  foundation_below<2>(const types::boundary_id);
  template Obstacles
  foundation_below<3>(const types::boundary_id);
} // namespace Ricochet
