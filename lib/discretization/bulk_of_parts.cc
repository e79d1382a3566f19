// SPDX-License-Identifier: LGPL-2.1-or-later
#include <discretization/bulk_of_parts.h>
#include <discretization/hyperelastic_bulk.h>
#include <discretization/linear_bulk.h>

#include <algorithm>

namespace Ricochet
{
  namespace
  {
    /// The @p materials, with one without any stress in place of those that are not linear, or
    /// that are.
    template <int dim>
    std::vector<Material<dim>>
    with_stress(const std::vector<Material<dim>> &materials, const bool linear)
    {
      std::vector<Material<dim>> result;
      for (const Material<dim> &material : materials)
        result.push_back(material.linear.has_value() == linear
                           ? material
                           : Material<dim>(LinearElastic{0., 0.}));
      return result;
    }
  } // namespace



  template <int dim>
  std::vector<std::unique_ptr<BulkOperator>>
  bulk_of_parts(const Body<dim>                  &body,
                const std::vector<Material<dim>> &materials,
                const MatrixStorage               storage)
  {
    std::vector<std::unique_ptr<BulkOperator>> terms;
    if (std::any_of(materials.begin(),
                    materials.end(),
                    [](const Material<dim> &material) {
                      return material.linear.has_value();
                    }))
      terms.push_back(
        std::make_unique<LinearBulk<dim>>(body,
                                          with_stress(materials, true),
                                          storage));
    if constexpr (dim > 1)
      if (!are_linear(materials))
        terms.push_back(std::make_unique<HyperelasticBulk<dim>>(
          body,
          with_stress(materials, false)));
    return terms;
  }


  template std::vector<std::unique_ptr<BulkOperator>>
  bulk_of_parts(const Body<1> &,
                const std::vector<Material<1>> &,
                const MatrixStorage);
  template std::vector<std::unique_ptr<BulkOperator>>
  bulk_of_parts(const Body<2> &,
                const std::vector<Material<2>> &,
                const MatrixStorage);
  template std::vector<std::unique_ptr<BulkOperator>>
  bulk_of_parts(const Body<3> &,
                const std::vector<Material<3>> &,
                const MatrixStorage);
} // namespace Ricochet
