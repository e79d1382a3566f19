// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_contact_treatment_h
#define ricochet_contact_treatments_contact_treatment_h

#include <base/own_parameter.h>
#include <base/parameter_file.h>
#include <contact/contact_operator.h>
#include <contact/surfaces/contact_pair.h>
#include <materials/linear_elastic.h>
#include <time_integration/scheme_traits.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Ricochet
{
  template <int dim>
  class PairContact;

  /// Everything about the contact treatment that a user chooses.
  struct ContactParameters
  {
    /// Of the parameter file; several contacts have sections of their own.
    std::string section      = "Contact";
    std::string treatment    = "Nitsche";
    std::string friction_law = "Coulomb";
    /// The parameters of all laws, as they declare them.
    ParameterValues values = all_parameters();
    /// Between bodies: "points", "mortar", "dual mortar" or "cut faces".
    std::string coupling = "points";

    /// Let the values that have a unit be zero, which stands for set_missing().
    void
    leave_open();

    /**
     * Give the values that are zero: what enters the solution is ten times as stiff as
     * the layer of cells at the surface, which cannot widen and so has the wave modulus;
     * what steers Newton's method is as stiff as the body, friction as stiff as waves in
     * it. So results do not depend on units.
     */
    void
    set_missing(const Scales &scales);

    /// Names and values of the parameters that have a unit and that the treatment makes
    /// use of.
    std::vector<std::pair<std::string, double>>
    used_values() const;

    void
    add_parameters(dealii::ParameterHandler &parameters);

    /// What programs with contact between bodies have besides.
    void
    add_pair_parameters(dealii::ParameterHandler &parameters);

    /// Those of all treatments and friction laws.
    static OwnParameters
    all_parameters();

    /// The parameters that the treatment makes no use of.
    std::vector<UnusedParameter>
    unused_parameters() const;

  private:
    OwnParameters
    used_parameters() const;
  };

  /// Names of all contact treatments, as a pattern for Patterns::Selection.
  std::string
  contact_treatment_names();

  /// The time schemes that can be combined with the treatment of @p parameters
  /// and the kind of mass; in the order of the table of schemes.
  std::vector<std::string>
  schemes_allowed(const ContactParameters &parameters,
                  const bool               redistributed_mass);

  /**
   * Refuse a combination of treatment, scheme, mass, friction and material that
   * has no meaning, and values out of range.
   *
   * @param linear_material the body is linear elastic.
   * @param viscous the body is viscous.
   * @throws InputError that names what is allowed.
   */
  void
  check_combination(const ContactParameters &parameters,
                    const SchemeTraits      &scheme,
                    const bool               redistributed_mass,
                    const bool               linear_material,
                    const bool               viscous);

  /// The same for contact between bodies, beside check_combination(). Where what is
  /// before what changes, it is formulated over the steps of the midpoint scheme, for
  /// treatments that need neither stress nor the multipliers of rigid obstacles.
  /// @param is_self a surface touches itself.
  /// @param dim of space, in which there is less than in the plane.
  /// @throws InputError that names what is allowed.
  void
  check_pair_combination(const ContactParameters &parameters,
                         const SchemeTraits      &scheme,
                         const bool               is_self = false,
                         const unsigned int       dim     = 2);

  /// The promise of the treatment in a time scheme; against obstacles, on cut faces, and
  /// between bodies.
  /// @param mortar_dim the dimension of bodies that are coupled by mortar; 0 for others.
  EnergyPromise
  energy_promise(const ContactParameters &parameters,
                 const SchemeTraits      &scheme,
                 const unsigned int       mortar_dim = 0);

  /// The promises of all treatments as a table in Markdown, for the documentation.
  std::string
  promises_as_table();

  /// Whether the treatment is a constraint in nodes: an active set or multipliers, of
  /// which a node can follow one only.
  bool
  is_constraint(const ContactParameters &parameters);

  /// Whether it takes the stress of the body at the surface.
  bool
  uses_stress(const ContactParameters &parameters);

  /// Names of the treatments that are no constraints.
  std::string
  names_of_laws();

  /// The multiplier space that the treatment of @p parameters needs.
  MultiplierSpace
  multiplier_space(const ContactParameters &parameters);

  /// The same for contact between bodies.
  MultiplierSpace
  pair_multiplier_space(const ContactParameters &parameters);

  /// The treatment that @p parameters name between the surfaces of the @p pairs.
  /// @throws InputError see PairContact
  template <int dim>
  std::unique_ptr<PairContact<dim>>
  make_pair_contact(const ContactParameters        &parameters,
                    const SchemeTraits             &scheme,
                    const Body<dim>                &body,
                    const std::vector<ContactPair> &pairs);

  /// The same on the cut faces between linear elastic bodies with the @p materials, by
  /// material id or one for all, see CutFaces.
  /// @throws InputError see CutFaces; and when Nitsche's parameter is too small for it
  /// to be stable.
  template <int dim>
  std::unique_ptr<ContactOperator>
  make_cut_face_contact(const ContactParameters          &parameters,
                        const SchemeTraits               &scheme,
                        const Body<dim>                  &body,
                        const std::vector<LinearElastic> &materials,
                        const std::vector<ContactPair>   &pairs);

  /// The treatment that @p parameters name, for the time scheme @p scheme, on
  /// @p body against @p obstacles. @p stress is that of the body on the contact
  /// boundary; empty where it is not linear, and then the treatments that use it
  /// are refused.
  ///
  /// @throws InputError when Nitsche's parameter is below its bound of stability
  /// on this mesh, or the points of contact cannot be made.
  template <int dim>
  std::unique_ptr<ContactOperator>
  make_contact(const ContactParameters                     &parameters,
               const SchemeTraits                          &scheme,
               const Body<dim>                             &body,
               const std::common_type_t<LinearStress<dim>> &stress,
               const Obstacles                             &obstacles);
} // namespace Ricochet

#endif
