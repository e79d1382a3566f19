// SPDX-License-Identifier: LGPL-2.1-or-later

// Solutions of tangents with contact, by all that the linear solver has, against the
// tangent itself, through a sequence of states in which points open and close. The whole
// tangent on any number of ranks.

#include "condensed_solution.h"
#include "meshes.h"

#include <contact/obstacles/half_space.h>
#include <contact/obstacles/sphere_shape.h>
#include <base/exceptions.h>
#include <base/one_rank.h>
#include <contact/treatments/contact_treatment.h>
#include <discretization/hyperelastic_bulk.h>
#include <discretization/linear_bulk.h>
#include <materials/hyperelastic_law_implementation.h>
#include <materials/laws/ciarlet_geymonat.h>
#include <solvers/constraints.h>
#include <solvers/factorisation.h>
#include <solvers/linear_solver.h>
#include <solvers/multigrid.h>

#include <boost/test/unit_test.hpp>

using namespace Ricochet;
using dealii::VectorOperation;

BOOST_AUTO_TEST_SUITE(linear_solver)

namespace
{
  const LinearElastic material{1.5, 1.};

  struct Treatment
  {
    std::string  name, scheme;
    double       theta     = 1.;
    unsigned int degree    = 1;
    bool         simplices = true;
    double       friction  = 0.;
    // Size of the random displacements; two thirds of it are the gap.
    double displacement = .03;
    // The obstacle is a ball, against which directions turn; it is half as far.
    bool is_round = false;
  };

  std::vector<Treatment>
  all_treatments()
  {
    std::vector<Treatment> all;
    for (const bool simplices : {true, false})
      {
        for (const double theta : {1., -1., 0.})
          {
            all.push_back({"Nitsche", "HHT", theta, 2, simplices});
            all.push_back({"Nitsche-hybrid", "midpoint", theta, 1, simplices});
          }
        all.push_back(
          {"proximal augmented Lagrangian", "HHT", 1., 2, simplices});
        for (const double friction : {0., .3})
          {
            all.push_back({"Signorini multipliers",
                           "midpoint",
                           1.,
                           1,
                           simplices,
                           friction});
            all.push_back(
              {"Signorini active set", "midpoint", 1., 1, simplices, friction});
            all.push_back({"improved normal compliance",
                           "midpoint",
                           1.,
                           1,
                           simplices,
                           friction});
          }
      }
    for (const double friction : {0., .3})
      for (const std::string name : {"penalty",
                                     "improved normal compliance",
                                     "Signorini active set",
                                     "Signorini multipliers"})
        all.push_back({name, "midpoint", 1., 1, true, friction, .03, true});
    all.push_back({"Nitsche", "HHT", -1., 2, false, 0., .03, true});
    return all;
  }

  /// A ball below the middle of a cube's bottom.
  template <int dim>
  Obstacles
  ball(const double gap)
  {
    constexpr double     radius = 2.;
    dealii::Tensor<1, 3> centre;
    for (unsigned int c = 0; c + 1 < dim; ++c)
      centre[c] = .4;
    centre[dim - 1] = -gap - radius;
    return {{1,
             std::make_shared<RigidObstacle>(
               std::make_shared<SphereShape>(centre, radius, false))}};
  }

  /// Solve for a sequence of random states. @return the number of
  /// factorisations.
  template <int dim>
  unsigned int
  check(const Treatment                &treatment,
        const LinearSolver::Parameters &solver_parameters,
        const bool                      linear_body,
        const double                    tolerance)
  {
    const CubeAbovePlane<dim> cube(treatment.simplices, 3);
    ContactParameters         parameters;
    parameters.treatment                        = treatment.name;
    parameters.values["Nitsche theta"]          = treatment.theta;
    parameters.values["Nitsche gamma0"]         = 50.;
    parameters.values["Compliance coefficient"] = 20.;
    parameters.values["Compliance exponent"]    = 3.;
    parameters.values["Friction coefficient"]   = treatment.friction;
    parameters.values["Tangential compliance"]  = .5;
    parameters.values["Augmentation"]           = .5;
    const Body<dim> body(cube.triangulation,
                         treatment.degree,
                         {2},
                         {1},
                         multiplier_space(parameters),
                         MPI_COMM_WORLD);
    const auto      contact =
      make_contact(parameters,
                   scheme_traits(treatment.scheme),
                   body,
                   material,
                   treatment.is_round
                     ? ball<dim>(treatment.displacement / 3.)
                     : cube.plane(treatment.displacement / 1.5));
    const BodyMatrix            mass = assemble_mass_matrix(body, 1.);
    const LinearBulk<dim>       linear_bulk(body, material);
    const Material<dim>         nonlinear(std::make_shared<Hyperelastic<dim>>(
      std::make_shared<HyperelasticLawImplementation<CiarletGeymonat>>(
        CiarletGeymonat{.5, .005, .35}),
      PlaneState::plane_strain));
    const HyperelasticBulk<dim> nonlinear_bulk(body, nonlinear);
    const BulkOperator         &bulk = linear_body
              ? static_cast<const BulkOperator &>(linear_bulk)
              : static_cast<const BulkOperator &>(nonlinear_bulk);

    const dealii::IndexSet clamped =
      constrained_indices(body.constraints(), body.owned_indices());
    LinearSolver solver(
      solver_parameters,
      contact->structure(),
      linear_body,
      clamped,
      [&]() { return body.coarse_space(); },
      dim,
      mass.m(),
      dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));

    Vector zero = body.make_vector(), solution(zero), old_solution(zero);
    Vector residual(zero), right_hand_side(zero), result(zero);
    Vector old_force(zero), mean_velocity(zero);
    const ContactStart start{old_solution, old_force, mean_velocity, .1};
    const double       weight = .7;
    for (unsigned int seed = 0; seed < 6; ++seed)
      {
        randomise(solution, treatment.displacement, seed);
        randomise(old_solution, treatment.displacement, seed + 10);
        randomise(right_hand_side, 1., seed + 20);
        for (const auto i : clamped)
          right_hand_side(i) = 0.;
        right_hand_side.compress(VectorOperation::insert);
        old_force = -.2;
        contact->begin_stage(start, weight);
        contact->add_residual(solution, residual);
        contact->accept_iterate();
        contact->add_residual(solution, residual);

        Tangent tangent;
        if (linear_body)
          {
            tangent.body       = BodyKey{3., .5, weight};
            tangent.contact    = contact->active_set().tangent_key;
            tangent.body_terms = bulk.step_tangent_terms(.1);
            tangent.body_terms.push_back({3., &mass});
          }
        tangent.assemble_body = [&](Matrix &matrix) {
          // In place, as factorisations that are used again want it.
          if (matrix.m() == 0)
            matrix.reinit(body.sparsity_pattern());
          matrix = 0.;
          mass.add_to(3., matrix);
          bulk.add_step_tangent(old_solution, solution, .1, matrix);
          eliminate(body.constraints(), matrix);
        };
        tangent.add_contact = [&](Matrix &matrix) {
          contact->add_tangent(matrix);
          eliminate(body.constraints(), matrix);
        };
        tangent.add_open_contact = [&](Matrix &matrix) {
          contact->add_open_tangent(matrix);
          eliminate(body.constraints(), matrix);
        };
        tangent.differentiate_contact =
          [&](std::vector<FunctionalRow> &with_values,
              std::vector<FunctionalRow> &with_residual) {
            contact->differentiate_forces(with_values, with_residual);
          };
        if (solver.condenses())
          {
            ContactSchurComplement    &complement = solver.condensed(tangent);
            std::vector<FunctionalRow> change(complement.n_rows()),
              excess_change(complement.n_rows());
            tangent.differentiate_contact(change, excess_change);
            solve_condensed(complement,
                            change,
                            excess_change,
                            right_hand_side,
                            result);
          }
        else
          solver.solve(tangent, right_hand_side, result, false, 1e-11);

        Matrix matrix;
        tangent.assemble_body(matrix);
        tangent.add_contact(matrix);
        matrix.vmult(residual, result);
        residual -= right_hand_side;
        BOOST_CHECK_MESSAGE(residual.l2_norm() <
                              tolerance * right_hand_side.l2_norm(),
                            treatment.name
                              << ", theta " << treatment.theta << ", degree "
                              << treatment.degree << ", friction "
                              << treatment.friction << ", " << dim
                              << "D: residual " << residual.l2_norm());
      }
    return solver.n_factorisations();
  }

  bool
  takes_nonlinear_bodies(const Treatment &treatment)
  {
    return treatment.scheme == "midpoint" && treatment.name != "Nitsche-hybrid";
  }

  /// By multigrid, with linear and nonlinear bodies.
  void
  check_multigrid(const Treatment &treatment, const bool also_in_3d)
  {
    LinearSolver::Parameters parameters;
    parameters.type = "multigrid";
    check<2>(treatment, parameters, true, 1e-9);
    if (also_in_3d)
      check<3>(treatment, parameters, true, 1e-9);
    if (takes_nonlinear_bodies(treatment))
      check<2>(treatment, parameters, false, 1e-9);
  }
} // namespace



// Tangents of a clamped body: symmetric without prescribed columns, and with the
// solution of cleared rows alone, whose matrix is not symmetric.
BOOST_AUTO_TEST_CASE(constraints_leave_tangents_symmetric)
{
  const CubeAbovePlane<3> cube(true, 3);
  const Body<3>           body(cube.triangulation,
                     2,
                     {2},
                     {1},
                     MultiplierSpace::none,
                     MPI_COMM_WORLD);
  const LinearBulk<3>     bulk(body, {material});
  const dealii::IndexSet  clamped =
    constrained_indices(body.constraints(), body.owned_indices());
  const std::vector<dealii::types::global_dof_index> rows(clamped.begin(),
                                                          clamped.end());
  Vector one = body.make_vector(), other(one), product(one);
  randomise(one, 1., 1);
  randomise(other, 1., 2);
  Matrix     eliminated, cleared;
  const auto asymmetry = [&](const Matrix &matrix) {
    matrix.vmult(product, one);
    const double forward = other * product;
    matrix.vmult(product, other);
    return std::abs(forward - one * product) / std::abs(forward);
  };
  for (Matrix *matrix : {&eliminated, &cleared})
    {
      matrix->reinit(body.sparsity_pattern());
      assemble_mass_matrix(body, 3.).add_to(1., *matrix);
      bulk.add_tangent(1., one, *matrix);
    }
  eliminate(body.constraints(), eliminated);
  cleared.clear_rows(rows, 1.);
  BOOST_CHECK_SMALL(asymmetry(eliminated), 1e-13);
  BOOST_CHECK_GT(asymmetry(cleared), 1e-3);

  for (const auto i : clamped)
    {
      BOOST_CHECK_EQUAL(eliminated.diag_element(i), 1.);
      one(i) = 0.;
    }
  one.compress(VectorOperation::insert);
  Factorisation of_eliminated("MUMPS"), of_cleared("MUMPS");
  BOOST_REQUIRE(of_eliminated.factorise(eliminated, false));
  BOOST_REQUIRE(of_cleared.factorise(cleared, false));
  of_eliminated.solve(one, other);
  of_cleared.solve(one, product);
  for (const auto i : clamped)
    BOOST_CHECK_EQUAL(other(i), 0.);
  other -= product;
  BOOST_CHECK_SMALL(other.l2_norm() / product.l2_norm(), 1e-13);
}

// One factorisation, whatever contact does.
BOOST_AUTO_TEST_CASE(condensed_solutions_solve)
{
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    return;
  LinearSolver::Parameters parameters;
  parameters.type = "condensed";
  for (const Treatment &treatment : fewer_in_debug(all_treatments()))
    BOOST_TEST_CONTEXT(treatment.name << ", theta " << treatment.theta
                                      << ", degree " << treatment.degree)
    {
      BOOST_CHECK_EQUAL(check<2>(treatment, parameters, true, 1e-10), 1u);
      BOOST_CHECK_EQUAL(check<3>(treatment, parameters, true, 1e-10), 1u);
    }
}

BOOST_AUTO_TEST_CASE(direct_solutions_solve)
{
  LinearSolver::Parameters parameters;
  parameters.type = "direct";
  for (const std::string factorisation : {"KLU", "MUMPS"})
    {
      parameters.factorisation = factorisation;
      for (const Treatment &treatment : fewer_in_debug(all_treatments()))
        {
          // The other one meets each kind of contact once.
          if (factorisation == "MUMPS" && !treatment.simplices)
            continue;
          check<2>(treatment, parameters, true, 1e-10);
          if (takes_nonlinear_bodies(treatment))
            check<2>(treatment, parameters, false, 1e-10);
        }
    }
}

BOOST_AUTO_TEST_CASE(multigrid_solves)
{
  for (const Treatment &treatment : fewer_in_debug(all_treatments()))
    if (treatment.name != "proximal augmented Lagrangian" &&
        treatment.name != "Signorini multipliers")
      check_multigrid(treatment, true);
}

// Degree 2 without a sum: each new tangent is a matrix. Displacements are smaller,
// as the tangent of a crumpled body is indefinite. In nodes of simplices there is
// no contact of degree 2 in 3D.
BOOST_AUTO_TEST_CASE(multigrid_solves_with_assembled_tangents)
{
  for (const bool simplices : {true, false})
    for (const double friction : {0., .3})
      check_multigrid({"improved normal compliance",
                       "midpoint",
                       1.,
                       2,
                       simplices,
                       friction,
                       .006},
                      !simplices);
}

// Iterations do not grow with the body, nor with the stiffness of contact, which
// is oblique here, and in the last case so stiff that its unknowns are solved for
// directly. There are more coarse unknowns than aggregation leaves alone, on any number
// of ranks.
BOOST_AUTO_TEST_CASE(multigrid_needs_few_iterations)
{
  for (const double stiffness : fewer_in_debug<double>({1., 0., 100., 1e4}))
    for (const bool simplices : {false, true})
      {
        std::vector<int> iterations;
        for (const int n_cells : {simplices ? 3 : 4, simplices ? 5 : 8})
          {
            const CubeAbovePlane<3> cube(simplices, n_cells);
            const Body<3>           body(cube.triangulation,
                               2,
                               {2},
                               {1},
                               MultiplierSpace::none,
                               MPI_COMM_WORLD);
            const LinearBulk<3> bulk(body, {material}, MatrixStorage::blocks);
            const BodyMatrix    mass =
              assemble_mass_matrix(body, {1.}, MatrixStorage::blocks);
            dealii::Tensor<1, 3> normal({.4, .3, 1.});
            normal /= normal.norm();
            ContactParameters parameters;
            parameters.treatment = "penalty";
            const auto contact   = make_contact(
              parameters,
              scheme_traits("midpoint"),
              body,
              material,
              {{1,
                  half_space_at_rest<3>(dealii::Point<3>(0., 0., .2), normal)}});
            Vector solution = body.make_vector(), residual(solution),
                   right_hand_side(solution), result(solution);
            contact->begin_stage({solution, solution, solution, .1}, stiffness);
            contact->add_residual(solution, residual);
            const ContactStructure     structure = contact->structure();
            std::vector<FunctionalRow> change(
              structure.functionals->functionals.size()),
              with_residual(change);
            contact->differentiate_forces(change, with_residual);

            const dealii::IndexSet clamped =
              constrained_indices(body.constraints(), body.owned_indices());
            TangentOperator tangent(body.owned_indices(),
                                    clamped,
                                    structure.functionals->functionals,
                                    MPI_COMM_WORLD);
            MatrixSum       terms = bulk.tangent_terms(1.);
            terms.push_back({1., &mass});
            tangent.set_terms(terms);
            Multigrid multigrid(body.coarse_space(), true);
            multigrid.set_body(tangent, terms.size());
            tangent.set_change(change);
            multigrid.setup();
            randomise(right_hand_side, 1., 1);
            for (const auto i : clamped)
              right_hand_side(i) = 0.;
            right_hand_side.compress(VectorOperation::insert);
            iterations.push_back(
              multigrid.solve(right_hand_side, result, 1e-8));
            tangent.vmult(residual, result);
            residual -= right_hand_side;
            BOOST_CHECK_LT(residual.l2_norm(),
                           1e-7 * right_hand_side.l2_norm());
          }
        BOOST_TEST_MESSAGE("stiffness " << stiffness << ": " << iterations[0]
                                        << ", " << iterations[1]
                                        << " iterations");
        BOOST_CHECK_GT(iterations[0], 0);
        BOOST_CHECK_LE(iterations[1], 30);
        BOOST_CHECK_LE(iterations[1], 1.5 * iterations[0]);
      }
}

// A run that one rank is faster with takes one rank, unless that is refused.
BOOST_AUTO_TEST_CASE(several_ranks)
{
  LinearSolver::Parameters parameters;
  ContactStructure         contact;
  contact.functionals.emplace();
  const auto make = [&](const unsigned int dim,
                        const std::size_t  n_unknowns,
                        const unsigned int n_ranks) {
    return LinearSolver(parameters,
                        contact,
                        true,
                        {},
                        {},
                        dim,
                        n_unknowns,
                        n_ranks);
  };
  BOOST_CHECK(make(2, 5000, 1).condenses());
  BOOST_CHECK_THROW(make(2, 5000, 2), OneRankSuffices);
  BOOST_CHECK(!make(2, 500, 2).condenses());
  BOOST_CHECK(!make(2, 200000, 2).condenses());
  parameters.distribute = true;
  BOOST_CHECK(!make(2, 5000, 2).condenses());
  parameters.type = "condensed";
  BOOST_CHECK(make(2, 500, 1).condenses());
  BOOST_CHECK_THROW(make(2, 500, 2), InputError);
  parameters.distribute = false;
  BOOST_CHECK_THROW(make(2, 200000, 2), OneRankSuffices);
  contact.functionals.reset();
  BOOST_CHECK_THROW(make(2, 500, 1), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
