// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_linear_elastic_h
#define ricochet_materials_linear_elastic_h

#include <base/exceptions.h>
#include <base/own_parameter.h>
#include <base/parameter_file.h>
#include <materials/plane_state.h>

#include <deal.II/base/symmetric_tensor.h>

namespace Ricochet
{
  /**
   * Isotropic linear elasticity, a pure function of the strain (paper C, (1)):
   * stress = lambda tr(strain) I + 2 mu strain.
   *
   * In 1D the modulus of a bar is lambda + 2 mu; for a bar of modulus E take
   * lambda = 0 and mu = E/2.
   */
  struct LinearElastic
  {
    /// First Lamé parameter (Pa).
    double lambda = 0.;
    /// Shear modulus (Pa).
    double mu = 0.;

    static constexpr const char *name = "linear elastic";

    /// Young's modulus and Poisson's ratio, which other laws take, too.
    static OwnParameters
    parameters()
    {
      return {OwnParameter("Young modulus", 1e10)
                .means("Young's modulus",
                       "Pa",
                       ". Not used by Ciarlet-Geymonat.")
                .at_least(1e-30)
                .belongs_to("the other laws"),
              OwnParameter("Poisson ratio", .35)
                .means("Poisson's ratio, above -1 and below 1/2. Not used by "
                       "Ciarlet-Geymonat.",
                       "",
                       "")
                .at_least(-1.)
                .at_most(.5)
                .must([](const double value) {
                  if (!(value > -1. && value < .5))
                    throw InputError(
                      "The Poisson ratio must lie between -1 and 1/2, both "
                      "excluded; it is " +
                      to_text(value) + ".");
                })
                .belongs_to("the other laws")};
    }

    static LinearElastic
    make(const ParameterValues &values)
    {
      return from_young(values["Young modulus"], values["Poisson ratio"]);
    }

    /// From Young's modulus (Pa) and Poisson's ratio (paper A, 6.1, with the
    /// factors of its Lamé parameters corrected).
    static LinearElastic
    from_young(const double young_modulus, const double poisson_ratio)
    {
      return {young_modulus * poisson_ratio /
                ((1. + poisson_ratio) * (1. - 2. * poisson_ratio)),
              young_modulus / (2. * (1. + poisson_ratio))};
    }

    /// The law of a flat body in the same form: in plane stress the first Lamé
    /// parameter becomes 2 lambda mu/(lambda + 2 mu) (paper A, 6.1).
    LinearElastic
    in_plane(const PlaneState plane_state) const
    {
      return plane_state == PlaneState::plane_strain
        ? *this
        : LinearElastic{2. * lambda * mu / (lambda + 2. * mu), mu};
    }

    /// The law as a function: stress().
    template <int dim>
    dealii::SymmetricTensor<2, dim>
    operator()(const dealii::SymmetricTensor<2, dim> &strain) const
    {
      return stress(strain);
    }

    /// Cauchy stress (Pa) for the small @p strain.
    template <int dim, typename Number>
    dealii::SymmetricTensor<2, dim, Number>
    stress(const dealii::SymmetricTensor<2, dim, Number> &strain) const
    {
      return lambda * trace(strain) *
        dealii::unit_symmetric_tensor<dim, Number>() +
        2. * mu * strain;
    }
  };
} // namespace Ricochet

#endif
