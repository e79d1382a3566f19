// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <contact/kinematics/contact_points.h>

#include <deal.II/fe/fe_values.h>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    const std::shared_ptr<const RigidObstacle> &
    obstacle_of(const Obstacles         &obstacles,
                const types::boundary_id boundary_id)
    {
      const auto entry = obstacles.find(boundary_id);
      AssertThrow(entry != obstacles.end(),
                  ExcMessage("Contact boundary " + std::to_string(boundary_id) +
                             " has no obstacle."));
      return entry->second;
    }

    /// Set the data of a point at @p x that come from the obstacle of its
    /// boundary.
    void
    set_obstacle(const Obstacles         &obstacles,
                 const types::boundary_id boundary_id,
                 const Tensor<1, 3>      &x,
                 ContactPoint            &point)
    {
      point.boundary_id        = boundary_id;
      point.obstacle           = obstacle_of(obstacles, boundary_id);
      point.reference_position = x;
      point.initial_gap        = point.obstacle->gap(x, 0.);
      point.obstacle_normal    = point.obstacle->normal(x, 0.);
    }
  } // namespace



  Tensor<1, 3>
  stress_direction(const RigidObstacle &obstacle,
                   const Tensor<1, 3>  &obstacle_normal,
                   const Tensor<1, 3>  &outward_normal)
  {
    return obstacle.is_plane_at_rest() ? obstacle_normal : -outward_normal;
  }



  template <int dim>
  ContactPoints
  make_quadrature_contact_points(
    const Body<dim>                             &body,
    const std::common_type_t<LinearStress<dim>> &stress,
    const Obstacles                             &obstacles)
  {
    const FEValuesExtractors::Vector displacement(0);
    const FiniteElement<dim>        &element = body.dof_handler().get_fe();
    FEFaceValues<dim>                face_values(body.mapping(),
                                  element,
                                  body.face_quadrature(),
                                  update_values | update_gradients |
                                    update_quadrature_points |
                                    update_normal_vectors | update_JxW_values);

    std::unique_ptr<FEFaceValues<dim>>   multiplier_values;
    std::vector<types::global_dof_index> indices(element.n_dofs_per_cell());
    std::vector<types::global_dof_index> multiplier_indices;
    if (body.has_multipliers())
      {
        multiplier_values = std::make_unique<FEFaceValues<dim>>(
          body.mapping(),
          body.multiplier_dof_handler().get_fe(),
          body.face_quadrature(),
          update_values);
        multiplier_indices.resize(multiplier_values->dofs_per_cell);
      }

    ContactPoints points;
    for (const auto &cell : body.dof_handler().active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        for (const unsigned int f : cell->face_indices())
          {
            const auto face = cell->face(f);
            if (!face->at_boundary() ||
                obstacles.count(face->boundary_id()) == 0)
              continue;

            face_values.reinit(cell, f);
            cell->get_dof_indices(indices);
            if (body.has_multipliers())
              {
                const auto multiplier_cell = body.multiplier_cell(cell);
                multiplier_values->reinit(multiplier_cell, f);
                multiplier_cell->get_dof_indices(multiplier_indices);
              }
            for (const unsigned int q : face_values.quadrature_point_indices())
              {
                ContactPoint point;
                point.weight        = face_values.JxW(q);
                point.cell_diameter = cell->diameter();
                set_obstacle(obstacles,
                             face->boundary_id(),
                             in_space<dim>(face_values.quadrature_point(q)),
                             point);
                const Tensor<1, 3> against_stress =
                  stress_direction(*point.obstacle,
                                   point.obstacle_normal,
                                   in_space(face_values.normal_vector(q)));
                point.begin = points.index.size();
                for (const unsigned int i : face_values.dof_indices())
                  {
                    double stress_pressure = 0.;
                    if (stress)
                      {
                        const Tensor<1, dim> traction =
                          stress(
                            face_values[displacement].symmetric_gradient(i,
                                                                         q)) *
                          face_values.normal_vector(q);
                        for (unsigned int c = 0; c < dim; ++c)
                          stress_pressure += against_stress[c] * traction[c];
                      }
                    points.add_displacement(
                      body.system_index(indices[i]),
                      element.system_to_component_index(i).first,
                      face_values.shape_value(i, q),
                      stress_pressure);
                  }
                for (unsigned int i = 0; i < multiplier_indices.size(); ++i)
                  {
                    const types::global_dof_index index =
                      body.multiplier_system_index(multiplier_indices[i]);
                    const double value = multiplier_values->shape_value(i, q);

                    // Multipliers exist on the contact boundary only, and the
                    // shape functions of the others sum up to 1 on it. Other sets
                    // than the first one are those of contacts between bodies.
                    if (index == numbers::invalid_dof_index || value == 0. ||
                        multiplier_values->get_fe()
                            .system_to_component_index(i)
                            .first > 0)
                      continue;
                    points.add_multiplier(index, value);
                  }
                point.end = points.index.size();
                points.points.push_back(point);
              }
          }
      }
    return points;
  }



  template <int dim>
  ContactPoints
  make_contact_nodes(const Body<dim> &body,
                     const Obstacles &obstacles,
                     const bool       with_multipliers)
  {
    const FiniteElement<dim> &element = body.dof_handler().get_fe();

    // Data of each owned node, by the system index of its first displacement.
    // Ghost cells are visited, too: an owned node may lie only on contact faces
    // of cells of other ranks.
    struct Node
    {
      ContactPoint                                 point;
      std::array<types::global_dof_index, dim + 1> index;
    };
    std::map<types::global_dof_index, Node> nodes;

    // The lumped boundary mass, on the first displacement of each node. The sum
    // of their moduli distinguishes zero from round-off.
    Vector lumped_boundary_mass = body.make_vector();
    Vector sum_of_moduli        = body.make_vector();

    FEFaceValues<dim>                    face_values(body.mapping(),
                                  element,
                                  body.face_quadrature(),
                                  update_values | update_JxW_values);
    std::vector<types::global_dof_index> indices(element.n_dofs_per_cell());
    std::vector<types::global_dof_index> multiplier_indices(
      with_multipliers
        ? body.multiplier_dof_handler().get_fe().n_dofs_per_cell()
        : 0);
    for (const auto &cell : body.dof_handler().active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        for (const unsigned int f : cell->face_indices())
          {
            const auto face = cell->face(f);
            if (!face->at_boundary() ||
                obstacles.count(face->boundary_id()) == 0)
              continue;

            cell->get_dof_indices(indices);
            if (cell->is_locally_owned())
              face_values.reinit(cell, f);
            if (with_multipliers)
              body.multiplier_cell(cell)->get_dof_indices(multiplier_indices);

            // The element's own has_support_on_face() is true for all shape
            // functions of simplices.
            std::vector<types::global_dof_index> face_indices(
              element.n_dofs_per_face(f));
            face->get_dof_indices(face_indices);
            const std::set<types::global_dof_index> face_dofs(
              face_indices.begin(),
              face_indices.end());

            for (unsigned int i = 0; i < element.n_dofs_per_cell(); ++i)
              {
                const auto [component, node] =
                  element.system_to_component_index(i);
                if (component != 0 || face_dofs.count(indices[i]) == 0)
                  continue;
                const types::global_dof_index first =
                  body.system_index(indices[i]);

                if (cell->is_locally_owned())
                  {
                    double mass = 0., moduli = 0.;
                    for (const unsigned int q :
                         face_values.quadrature_point_indices())
                      {
                        const double term =
                          face_values.shape_value(i, q) * face_values.JxW(q);
                        mass += term;
                        moduli += std::abs(term);
                      }
                    lumped_boundary_mass(first) += mass;
                    sum_of_moduli(first) += moduli;
                  }
                if (!body.owned_indices().is_element(first))
                  continue;

                Node &info = nodes[first];
                info.point.cell_diameter =
                  std::max(info.point.cell_diameter, cell->diameter());
                for (unsigned int c = 0; c < dim; ++c)
                  info.index[c] = body.system_index(
                    indices[element.component_to_system_index(c, node)]);
                if (with_multipliers)
                  info.index[dim] = body.multiplier_system_index(
                    multiplier_indices[body.multiplier_dof_handler()
                                         .get_fe()
                                         .component_to_system_index(0, node)]);

                set_obstacle(obstacles,
                             face->boundary_id(),
                             in_space<dim>(
                               body.mapping().transform_unit_to_real_cell(
                                 cell,
                                 element.unit_support_point(i))),
                             info.point);
              }
          }
      }
    lumped_boundary_mass.compress(VectorOperation::add);
    sum_of_moduli.compress(VectorOperation::add);

    ContactPoints points;
    for (auto &[first, node] : nodes)
      {
        const double mass   = lumped_boundary_mass(first);
        const double moduli = sum_of_moduli(first);
        node.point.weight   = std::abs(mass) > 1e-10 * moduli ? mass : 0.;
        node.point.begin    = points.index.size();
        for (unsigned int c = 0; c < dim; ++c)
          points.add_displacement(node.index[c], c, 1., 0.);
        if (with_multipliers)
          points.add_multiplier(node.index[dim], 1.);
        node.point.end = points.index.size();
        points.points.push_back(node.point);
      }
    return points;
  }


  template <int dim>
  ContactPoints
  make_nodal_contact_points(const Body<dim> &body,
                            const Obstacles &obstacles,
                            const bool       with_multipliers,
                            const bool       eliminates_rows)
  {
    const unsigned int degree = body.dof_handler().get_fe().degree;
    if (with_multipliers && degree > 1)
      throw InputError(
        "Multipliers in the nodes need displacements of degree "
        "1; with degree " +
        std::to_string(degree) +
        " take the proximal augmented Lagrangian or the active "
        "set.");
    const ContactPoints points =
      make_contact_nodes(body, obstacles, with_multipliers);
    bool positive = true, clamped = false;
    for (const ContactPoint &point : points.points)
      {
        positive = positive && point.weight > 0.;
        // The parts of the normal along which the node is held, and is free.
        Tensor<1, 3> held, free;
        for (unsigned int k = point.begin; k < point.end; ++k)
          if (points.shape_value[k] != 0.)
            (body.constraints().is_constrained(points.index[k])
               ? held
               : free)[points.component[k]] = 1.;
        if (held.norm() == 0.)
          continue;
        for (unsigned int c = 0; c < 3; ++c)
          {
            held[c] *= point.obstacle_normal[c];
            free[c] *= point.obstacle_normal[c];
          }
        // Where rows are replaced, that along the normal has to be one of the body.
        if (with_multipliers)
          clamped = clamped || free.norm() < 1e-12;
        else if (eliminates_rows)
          clamped = clamped || held.norm() > 1e-12 ||
            !point.obstacle->is_plane_at_rest();
      }
    if (Utilities::MPI::max(clamped ? 1 : 0, body.communicator) == 1)
      throw InputError(
        "Constraints in the nodes need nodes that can move: the contact "
        "boundary and the held boundary share some. They may where the held "
        "component is tangential to a plane obstacle at rest, as on a plane of "
        "symmetry. Leave a part of the boundary free between them, or take a "
        "treatment that is a law: normal compliance, or one that integrates "
        "over the boundary.");
    if (Utilities::MPI::min(positive ? 1 : 0, body.communicator) == 0)
      throw InputError(
        "Nodal contact needs nodes with a positive lumped "
        "boundary mass; elements of degree " +
        std::to_string(degree) +
        " on this mesh have others. Take degree 1, or one of "
        "the treatments that integrate over the boundary.");
    return points;
  }


  template ContactPoints
  make_quadrature_contact_points(const Body<1> &,
                                 const LinearStress<1> &,
                                 const Obstacles &);
  template ContactPoints
  make_quadrature_contact_points(const Body<2> &,
                                 const LinearStress<2> &,
                                 const Obstacles &);
  template ContactPoints
  make_quadrature_contact_points(const Body<3> &,
                                 const LinearStress<3> &,
                                 const Obstacles &);
  template ContactPoints
  make_contact_nodes(const Body<1> &, const Obstacles &, const bool);
  template ContactPoints
  make_nodal_contact_points(const Body<1> &,
                            const Obstacles &,
                            const bool,
                            const bool);
  template ContactPoints
  make_contact_nodes(const Body<2> &, const Obstacles &, const bool);
  template ContactPoints
  make_nodal_contact_points(const Body<2> &,
                            const Obstacles &,
                            const bool,
                            const bool);
  template ContactPoints
  make_contact_nodes(const Body<3> &, const Obstacles &, const bool);
  template ContactPoints
  make_nodal_contact_points(const Body<3> &,
                            const Obstacles &,
                            const bool,
                            const bool);
} // namespace Ricochet
