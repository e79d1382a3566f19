// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_material_table_h
#define ricochet_materials_material_table_h

#include <base/named_table.h>
#include <materials/hyperelastic_law_implementation.h>
#include <materials/linear_elastic.h>
#include <materials/plane_state.h>

#include <deal.II/base/template_constraints.h>

#include <functional>
#include <memory>
#include <string>

namespace Ricochet
{
  /**
   * An elastic law as named in parameter files. A hyperelastic law is a struct
   * with
   *
   *     static constexpr const char *name;
   *     static OwnParameters parameters();
   *     static Law make(const ParameterValues &);
   *     energy(), gradient(), hessian()            see HyperelasticLaw
   *
   * and, optionally, the functions that CompletedLaw provides otherwise,
   * `static void check(const ParameterValues &, PlaneState)` that throws
   * InputError for values without meaning, and `static constexpr const char
   * *remark` for the documentation.
   */
  struct MaterialEntry
  {
    std::string   name;
    std::string   remark;
    OwnParameters parameters;
    /// Large strains; empty for the linear law.
    std::function<std::shared_ptr<const HyperelasticLaw>(
      const ParameterValues &)>
      make;
    /// Lamé's parameters in 3D (Pa).
    std::function<LinearElastic(const ParameterValues &)> at_small_strains;
    /// Throws InputError.
    std::function<void(const ParameterValues &, const PlaneState)> check;
  };

  /// All elastic laws; the linear one is the first.
  const NamedTable<MaterialEntry> &
  material_table();

  /// Add a law to the table. Programs do this before they declare parameters.
  /// @throws dealii::ExcMessage when there is one of its name.
  void
  register_material(const MaterialEntry &entry);



  namespace internal
  {
    // Optional members of a law.
    template <typename Law>
    using material_check_of =
      decltype(Law::check(std::declval<ParameterValues>(),
                          PlaneState::plane_strain));
    template <typename Law>
    using remark_of = decltype(Law::remark);
  } // namespace internal

  /// The entry of the hyperelastic law @p Law.
  template <typename Law>
  MaterialEntry
  material_entry()
  {
    using dealii::internal::is_supported_operation;
    MaterialEntry entry;
    entry.name       = Law::name;
    entry.parameters = Law::parameters();
    entry.make       = [](const ParameterValues &values) {
      return std::make_shared<HyperelasticLawImplementation<Law>>(
        Law::make(values));
    };
    entry.at_small_strains = [](const ParameterValues &values) {
      return CompletedLaw<Law>(Law::make(values)).at_small_strains();
    };
    if constexpr (is_supported_operation<internal::remark_of, Law>)
      entry.remark = Law::remark;
    if constexpr (is_supported_operation<internal::material_check_of, Law>)
      entry.check = Law::check;
    return entry;
  }

  /// Add the hyperelastic law @p Law to the table.
  template <typename Law>
  void
  register_material()
  {
    register_material(material_entry<Law>());
  }
} // namespace Ricochet

#endif
