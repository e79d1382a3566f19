// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/all_ranks.h>
#include <base/stopwatch.h>
#include <solvers/gathered_body.h>

namespace Ricochet
{
  using namespace dealii;

  GatheredBody::GatheredBody(std::unique_ptr<Factorisation>       on_one_rank,
                             const ContactStructure::ActsThrough &contact,
                             TangentSolver::Costs                &spent)
    : FactoredBody(contact)
    , factorisation(std::move(on_one_rank))
    , spent(spent)
  {}



  void
  GatheredBody::make_nearby()
  {
    const MPI_Comm communicator = matrix.get_mpi_communicator();
    places                      = FunctionalPlaces(contact, communicator);
    all_contact.functionals =
      functionals_of_all_ranks(contact.functionals, communicator);
    all_contact.order = of_all_ranks(contact.order, communicator);
    if (first_rank.is_here())
      nearby = std::make_unique<NearbyBody>(std::move(factorisation),
                                            all_contact,
                                            spent);
    factorisation.reset();
  }



  bool
  GatheredBody::factorise(const Tangent &tangent)
  {
    assemble(tangent);
    const Stopwatch         stopwatch(spent.factorising);
    const Epetra_CrsMatrix &all_rows =
      first_rank.gather(matrix.trilinos_matrix());
    if (factorisation)
      make_nearby();
    bool is_at_hand = false;
    first_rank.run([&]() { is_at_hand = nearby->factorise(all_rows); });
    return first_rank.knows(is_at_hand);
  }



  void
  GatheredBody::begin(const Vector &right_hand_side)
  {
    const Vector &all = first_rank.gather(right_hand_side);
    if (first_rank.is_here())
      nearby->begin(all);
  }



  void
  GatheredBody::observe(std::vector<double> &values)
  {
    if (first_rank.is_here())
      nearby->observe(values);
    first_rank.broadcast(values.data(), values.size());
  }



  void
  GatheredBody::finish(const std::vector<double> &coefficients,
                       Vector                    &solution)
  {
    const std::vector<double> all =
      of_all_ranks(coefficients, matrix.get_mpi_communicator());
    if (first_rank.is_here())
      nearby->finish(all, first_rank.result());
    first_rank.scatter_result(solution);
  }



  void
  GatheredBody::add_functionals(const std::vector<double> &coefficients,
                                Vector                    &vector) const
  {
    const Functionals &own = contact.functionals;
    for (unsigned int f = 0; f < coefficients.size(); ++f)
      if (coefficients[f] != 0.)
        for (std::size_t k = own.begin[f]; k < own.begin[f + 1]; ++k)
          vector(own.index[k]) += coefficients[f] * own.value[k];
    vector.compress(VectorOperation::add);
  }



  std::vector<double>
  GatheredBody::along_functionals(const Vector &vector)
  {
    const Vector       &all = first_rank.gather(vector);
    std::vector<double> products(n_functionals());
    if (first_rank.is_here())
      products = nearby->along_functionals(all);
    first_rank.broadcast(products.data(), products.size());
    std::vector<double> own;
    for (unsigned int f = 0; f < contact.functionals.size(); ++f)
      own.push_back(products[places.numbers[f]]);
    return own;
  }



  void
  GatheredBody::add_compliance(const double               factor,
                               const std::vector<double> &coefficients,
                               std::vector<double>       &values)
  {
    if (first_rank.is_here())
      nearby->add_compliance(factor, coefficients, values);
    first_rank.broadcast(values.data(), values.size());
  }



  void
  GatheredBody::solve_contact(const std::vector<FunctionalRow> &change,
                              const std::vector<FunctionalRow> &excess_change,
                              std::vector<double>              &coefficients,
                              const std::vector<double>        &values)
  {
    std::vector<NumberedRows> rows =
      rows_of_all_ranks(change,
                        excess_change,
                        places.numbers,
                        matrix.get_mpi_communicator());
    first_rank.run([&]() {
      std::vector<FunctionalRow> all_change(n_functionals()),
        all_excess_change(n_functionals());
      for (NumberedRows &own : rows)
        {
          all_change[own.number]        = std::move(own.rows[0]);
          all_excess_change[own.number] = std::move(own.rows[1]);
        }
      nearby->solve_contact(all_change,
                            all_excess_change,
                            coefficients,
                            values);
    });
    first_rank.broadcast(coefficients.data(), coefficients.size());
  }
} // namespace Ricochet
