// SPDX-License-Identifier: LGPL-2.1-or-later

// # Unknowns a second
//
// The parts of a time step, each by itself: the forces of a cube (residual),
// their derivative (tangent), the product of this matrix with a vector, its
// factorisation and a solution with it, a cycle of multigrid and its set-up.
// For each the time of the fastest of several calls, and the bytes that have to
// go through memory at the least: its input and output, once each, as stored.
// Divided by the bandwidth of the machine, which the same run measures
// (McCalpin's triad, a = b + s c, whose bytes are counted in the same way),
// they are the time that the kernel would take if nothing but memory limited
// it.
//
// Bytes at the least are
// - residual: of a linear body the matrix, two displacements and the force; of a
//   nonlinear one, whose cells are computed anew, two displacements, the force, and for
//   each cell the numbers of its unknowns;
// - tangent: the values of the matrix, once (linear: twice, as they are copied);
// - product: the matrix and two vectors;
// - factorisation: the factor, once, as large as its memory on the heap;
// - back-substitution: the factor, twice, and two vectors;
// - product by blocks (of a linear body, stiffness and mass, as large bodies store
//   them): the matrices and two vectors;
// - multigrid cycle: four products on the finest level, without the others; set-up: one.
//
//     kernels benchmarks/throughput.prm --output-dir DIR
//
// The folder gets kernels.csv. With several ranks all take part in each kernel, and in
// the triad.

#include <base/exceptions.h>
#include <base/files.h>
#include <base/program.h>
#include <discretization/hyperelastic_bulk.h>
#include <discretization/linear_bulk.h>
#include <materials/hyperelastic_law_implementation.h>
#include <materials/laws/neo_hookean.h>
#include <solvers/sparse_cholesky.h>
#include <solvers/multigrid.h>

#include <deal.II/base/utilities.h>
#include <deal.II/distributed/shared_tria.h>
#include <deal.II/grid/grid_generator.h>

#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <sstream>

namespace GridGenerator = dealii::GridGenerator;
namespace Patterns      = dealii::Patterns;
namespace Utilities     = dealii::Utilities;
namespace parallel      = dealii::parallel;
using dealii::ParameterHandler;
using dealii::VectorOperation;
using namespace Ricochet;

namespace
{
  const std::vector<std::string> all_kernels = {"residual",
                                                "tangent",
                                                "matrix-vector product",
                                                "factorisation",
                                                "back-substitution",
                                                "product by blocks",
                                                "multigrid cycle",
                                                "multigrid set-up"};

  std::string
  alternatives(const std::vector<std::string> &names)
  {
    std::string text;
    for (const std::string &name : names)
      text += (text.empty() ? "" : "|") + name;
    return text;
  }



  /// Seconds of the fastest of several calls of @p kernel, for at least @p seconds in
  /// all. Collective.
  double
  fastest(const std::function<void()> &kernel, const double seconds)
  {
    using Clock    = std::chrono::steady_clock;
    double best    = std::numeric_limits<double>::max();
    double all     = 0.;
    int    n_calls = 0;
    while (n_calls < 2 || all < seconds)
      {
        MPI_Barrier(MPI_COMM_WORLD);
        const auto begin = Clock::now();
        kernel();
        const double mine =
          std::chrono::duration<double>(Clock::now() - begin).count();
        // The same on all ranks, so that all stop at the same time.
        const double spent = Utilities::MPI::max(mine, MPI_COMM_WORLD);
        best               = std::min(best, spent);
        all += spent;
        ++n_calls;
      }
    return best;
  }



  /// Bytes a second of all ranks in a = b + s c, on arrays of so many @p megabytes in
  /// all.
  double
  triad(const unsigned int megabytes, const double seconds)
  {
    const std::size_t n = megabytes * std::size_t(1000000) / 3 /
      sizeof(double) / Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    std::vector<double> a(n, 1.), b(n, 2.), c(n, 3.);
    double              s     = .5;
    const double        spent = fastest(
      [&]() {
        double *const       to   = a.data();
        const double *const from = b.data();
        const double *const with = c.data();
        for (std::size_t i = 0; i < n; ++i)
          to[i] = from[i] + s * with[i];
        // A sink, as results that are never read need not be computed.
        s = to[n / 2] > 0. ? .5 : .25;
      },
      seconds);
    return Utilities::MPI::sum(3. * sizeof(double) * n, MPI_COMM_WORLD) / spent;
  }



  /// Bytes that are in use on the heap of this rank.
  double
  heap()
  {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks) +
      static_cast<double>(info.hblkhd);
  }



  double
  bytes_of(const Matrix &matrix)
  {
    return 12. * matrix.n_nonzero_elements() + 4. * matrix.m();
  }
} // namespace



class Kernels
{
public:
  void
  add_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Bodies");
    prm.add_parameter("Materials",
                      materials,
                      "Of the cube.",
                      Patterns::List(Patterns::Selection("linear|neo-Hookean"),
                                     1));
    prm.add_parameter(
      "Elements",
      elements,
      "Cells of its meshes.",
      Patterns::List(Patterns::Selection("tetrahedra|hexahedra"), 1));
    prm.add_parameter("Degree",
                      degree,
                      "Of the displacement.",
                      Patterns::Integer(1, 2));
    prm.add_parameter(
      "Cells",
      sizes,
      "Along an edge of the cube, of each mesh; tetrahedra are five "
      "of a hexahedron each.",
      Patterns::List(Patterns::Integer(1, 1000), 1));
    prm.leave_subsection();
    prm.enter_subsection("Kernels");
    prm.add_parameter(
      "Names",
      names,
      "Which are measured.",
      Patterns::List(Patterns::Selection(alternatives(all_kernels)), 1));
    prm.add_parameter(
      "Seconds",
      seconds,
      "Each is called again and again for so long, and twice at "
      "least.",
      Patterns::Double(0.));
    prm.leave_subsection();
    prm.enter_subsection("Memory");
    prm.add_parameter(
      "Megabytes",
      megabytes,
      "Of the three arrays of the triad in all, which have to be much "
      "larger than the caches.",
      Patterns::Integer(1));
    prm.leave_subsection();
  }



  void
  validate() const
  {
    for (const std::string kernel :
         {"product by blocks", "multigrid cycle", "multigrid set-up"})
      if (degree == 1 && measures(kernel))
        throw InputError("Kernels/Names: '" + kernel +
                         "' is for displacements of degree 2.");
  }



  void
  run(RunFolder &folder)
  {
    folder.begin();
    table << "material,elements,unknowns,kernel,seconds,bytes,"
             "unknowns_per_second,bandwidth\n";
    for (const std::string &material : materials)
      for (const std::string &element : elements)
        for (const unsigned int size : sizes)
          {
            folder.log(material + ", " + element + ", " + std::to_string(size) +
                       " along an edge");
            // In the same minute as the kernels.
            bandwidth = triad(megabytes, seconds);
            measure(material, element, size);
          }
    on_first_rank(MPI_COMM_WORLD, [&]() {
      write_atomically(folder.file("kernels.csv"), table.str());
    });
    folder.log("kernels.csv is written");
  }



private:
  void
  measure(const std::string &material,
          const std::string &element,
          const unsigned int size)
  {
    parallel::shared::Triangulation<3> triangulation(MPI_COMM_WORLD);
    if (element == "tetrahedra")
      GridGenerator::subdivided_hyper_cube_with_simplices(triangulation, size);
    else
      GridGenerator::subdivided_hyper_cube(triangulation, size);
    const Body<3>                 body(triangulation,
                       degree,
                       {},
                       {},
                       MultiplierSpace::none,
                       MPI_COMM_WORLD);
    const LinearElastic           law{1.5, 1.};
    const bool                    is_linear = material == "linear";
    std::unique_ptr<BulkOperator> bulk;
    if (is_linear)
      bulk = std::make_unique<LinearBulk<3>>(body, law);
    else
      {
        const auto hyperelastic = std::make_shared<Hyperelastic<3>>(
          std::make_shared<HyperelasticLawImplementation<NeoHookean>>(
            NeoHookean{law.lambda, law.mu}),
          PlaneState::plane_strain);
        bulk = std::make_unique<HyperelasticBulk<3>>(body,
                                                     Material<3>(hyperelastic));
      }
    const BodyMatrix mass = assemble_mass_matrix(body, 1.);

    Vector old_solution = body.make_vector(), new_solution(old_solution),
           force(old_solution);
    // Small strains, so that no cell is inverted.
    const double amplitude = .02 / size;
    for (const auto i : body.owned_indices())
      {
        old_solution(i) = amplitude * std::sin(.1 * i);
        new_solution(i) = amplitude * std::cos(.1 * i);
      }
    old_solution.compress(VectorOperation::insert);
    new_solution.compress(VectorOperation::insert);
    constexpr double time_step = .1;

    Matrix tangent;
    tangent.reinit(body.sparsity_pattern());
    const double n           = body.owned_indices().size();
    const double entries     = tangent.n_nonzero_elements();
    const auto   set_tangent = [&]() {
      tangent = 0.;
      bulk->add_step_tangent(old_solution, new_solution, time_step, tangent);
    };
    const double cells          = triangulation.n_global_active_cells();
    const double residual_bytes = 24. * n +
      (is_linear ? bytes_of(tangent)
                 : 4. * cells * body.dof_handler().get_fe().n_dofs_per_cell());
    const auto add = [&](const std::string           &kernel,
                         const double                 bytes,
                         const std::function<void()> &call) {
      if (!measures(kernel))
        return;
      const double spent = fastest(call, seconds);
      table << material << "," << element << "," << static_cast<unsigned int>(n)
            << "," << kernel << "," << spent << "," << bytes << "," << n / spent
            << "," << bandwidth << "\n";
    };
    add("residual", residual_bytes, [&]() {
      bulk->step_force(old_solution, new_solution, time_step, force);
    });
    add("tangent", (is_linear ? 16. : 8.) * entries, set_tangent);
    set_tangent();
    add("matrix-vector product", bytes_of(tangent) + 16. * n, [&]() {
      tangent.vmult(force, new_solution);
    });
    if (measures("factorisation") || measures("back-substitution"))
      measure_factorisation(tangent, mass, new_solution, force, add);
    if (is_linear &&
        (measures("product by blocks") || measures("multigrid cycle") ||
         measures("multigrid set-up")))
      measure_multigrid(body, law, new_solution, force, add);
  }



  using Add = std::function<void(const std::string           &kernel,
                                 const double                 bytes,
                                 const std::function<void()> &call)>;

  void
  measure_factorisation(Matrix           &tangent,
                        const BodyMatrix &mass,
                        const Vector     &right_hand_side,
                        Vector           &solution,
                        const Add        &add) const
  {
    // As in a time step: without inertia the cube could move as it likes.
    mass.add_to(400., tangent);
    if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
      throw InputError("Factorisations of bodies are on one rank.");
    SparseCholesky cholesky(SparseCholesky::Kind::frozen_tangent);
    const double   before    = heap();
    const auto     factorise = [&]() {
      if (!cholesky.factorise(tangent))
        throw ComputationError("The matrix of a cube cannot be factored.");
    };
    factorise();
    const double factor = heap() - before;
    add("factorisation", factor, factorise);
    std::vector<double> forward;
    add("back-substitution", 2. * factor + 16. * tangent.m(), [&]() {
      const TriangularSolves &solves = cholesky.factor();
      solves.forward(right_hand_side.trilinos_vector()[0], forward);
      solves.backward(forward, solution.trilinos_vector()[0]);
    });
  }



  /// The body as it is stored for multigrid.
  void
  measure_multigrid(const Body<3>       &body,
                    const LinearElastic &law,
                    const Vector        &right_hand_side,
                    Vector              &solution,
                    const Add           &add) const
  {
    const LinearBulk<3> bulk(body, {law}, MatrixStorage::blocks);
    const BodyMatrix    mass =
      assemble_mass_matrix(body, {1.}, MatrixStorage::blocks);
    TangentOperator tangent(body.owned_indices(),
                            constrained_indices(body.constraints(),
                                                body.owned_indices()),
                            Functionals(),
                            MPI_COMM_WORLD);
    MatrixSum       terms = bulk.step_tangent_terms(.1);
    terms.push_back({400., &mass});
    tangent.set_terms(terms);
    Multigrid multigrid(body.coarse_space(), true);
    multigrid.set_body(tangent, terms.size());
    multigrid.setup();
    double bytes = 0.;
    for (const MatrixTerm &term : terms)
      bytes += term.matrix->memory_consumption();
    bytes = Utilities::MPI::sum(bytes, MPI_COMM_WORLD) + 16. * tangent.m();
    const double single_bytes =
      Utilities::MPI::sum(static_cast<double>(
                            multigrid.memory_of_finest_level()),
                          MPI_COMM_WORLD) +
      8. * tangent.m();
    add("product by blocks", bytes, [&]() {
      tangent.vmult(solution, right_hand_side);
    });
    add("multigrid cycle", 4. * single_bytes, [&]() {
      multigrid.vmult(solution, right_hand_side);
    });
    add("multigrid set-up", single_bytes, [&]() { multigrid.setup(); });
  }



  bool
  measures(const std::string &kernel) const
  {
    return std::find(names.begin(), names.end(), kernel) != names.end();
  }



  std::vector<std::string>  materials = {"linear", "neo-Hookean"};
  std::vector<std::string>  elements  = {"tetrahedra", "hexahedra"};
  unsigned int              degree    = 2;
  std::vector<unsigned int> sizes     = {4, 8, 12};
  std::vector<std::string>  names     = all_kernels;
  double                    seconds   = 1.;
  unsigned int              megabytes = 384;

  // Bytes a second.
  double             bandwidth = 0.;
  std::ostringstream table;
};



int
main(int argc, char **argv)
{
  Kernels kernels;
  return run_program(
    argc,
    argv,
    {"kernels",
     "Unknowns a second of the parts of a time step, beside the bandwidth of memory.",
     [&](ParameterHandler &parameters) { kernels.add_parameters(parameters); },
     [&]() { kernels.validate(); },
     [&](RunFolder &folder) { kernels.run(folder); }});
}
