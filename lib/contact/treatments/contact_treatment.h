// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_contact_treatment_h
#define ricochet_contact_treatments_contact_treatment_h

#include <base/own_parameter.h>
#include <base/parameter_file.h>
#include <contact/contact_operator.h>
#include <contact/surfaces/contact_pair.h>
#include <materials/linear_elastic.h>
#include <materials/viscosity.h>
#include <time_integration/scheme_traits.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Ricochet
{
  template <int dim>
  class PairContact;

  /// A user's choices for the contact treatment.
  struct ContactParameters
  {
    /// Section of the parameter file; several contacts have sections of their
    /// own.
    std::string section      = "Contact";
    std::string treatment    = "Nitsche";
    std::string friction_law = "Coulomb";
    /// Stick of treatments whose friction need not be exact: "regularised" or "exact".
    std::string stick = "regularised";
    /// The parameters of all laws, as they declare them.
    ParameterValues values = all_parameters();
    /// Between bodies: "points", "mortar", "dual mortar" or "cut faces".
    std::string coupling = "points";
    /// Between bodies: corners of the master are points, too, see PairContact.
    bool corners = false;

    /// Let the values that have a unit be zero, which stands for set_missing().
    void
    leave_open();

    /**
     * Set the values that are zero: stiffnesses in the solution are ten times that of
     * the layer of cells at the surface, which cannot widen and so has the wave
     * modulus; those that affect Newton's method alone are that of the body, and those
     * of friction the impedance of waves in it. So results do not depend on units.
     */
    void
    set_missing(const Scales &scales);

    /// Names and values of the parameters that have a unit and that the treatment uses.
    std::vector<std::pair<std::string, double>>
    used_values() const;

    void
    add_parameters(dealii::ParameterHandler &parameters);

    /// Add the parameters of programs with contact between bodies.
    void
    add_pair_parameters(dealii::ParameterHandler &parameters);

    /// The parameters of all treatments and friction laws.
    static OwnParameters
    all_parameters();

    /// The parameters that the treatment does not use.
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
   * @param linear_material the body is linear elastic. @param velocity_force in the body.
   * @param degree of the displacements.
   * @throws InputError that names what is allowed.
   */
  void
  check_combination(const ContactParameters &parameters,
                    const SchemeTraits      &scheme,
                    const bool               redistributed_mass,
                    const bool               linear_material,
                    const VelocityForce      velocity_force,
                    const unsigned int       degree = 1);

  /// Properties of bodies and surfaces in contact that a combination may depend on.
  struct PairProperties
  {
    /// A surface touches itself.
    bool         is_self = false;
    unsigned int dim     = 2;
    /// Degree of the displacements.
    unsigned int degree             = 1;
    bool         linear_material    = true;
    bool         redistributed_mass = false;
  };

  /// As check_combination(), for contact between bodies, where treatments need neither
  /// stress nor the multipliers of rigid obstacles, except on cut faces.
  /// @throws InputError that names what is allowed.
  void
  check_pair_combination(const ContactParameters &parameters,
                         const SchemeTraits      &scheme,
                         const PairProperties    &properties = {});

  /// Each treatment with each choice of its parameters, and a name for it: "Nitsche, theta =
  /// -1".
  std::vector<std::pair<std::string, ContactParameters>>
  treatment_variants();

  /// The promise of the treatment in a time scheme; against obstacles and on cut faces,
  /// and between bodies.
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

  /// Whether there is friction.
  bool
  has_friction(const ContactParameters &parameters);

  /// Whether the treatment uses the stress of the body at the surface.
  bool
  uses_stress(const ContactParameters &parameters);

  /// Names of the treatments that are no constraints.
  std::string
  names_of_laws();

  /// The multiplier space that the treatment of @p parameters needs.
  MultiplierSpace
  multiplier_space(const ContactParameters &parameters);

  /// The multiplier space for contact between bodies.
  MultiplierSpace
  pair_multiplier_space(const ContactParameters &parameters);

  /// The treatment of @p parameters between the surfaces of the @p pairs.
  /// @throws InputError see PairContact
  template <int dim>
  std::unique_ptr<PairContact<dim>>
  make_pair_contact(const ContactParameters        &parameters,
                    const SchemeTraits             &scheme,
                    const Body<dim>                &body,
                    const std::vector<ContactPair> &pairs);

  /// The treatment on the cut faces between linear elastic bodies with the
  /// @p materials, by material id or one for all, see CutFaces.
  /// @throws InputError see CutFaces; and when Nitsche's parameter is too small for it
  /// to be stable.
  template <int dim>
  std::unique_ptr<ContactOperator>
  make_cut_face_contact(const ContactParameters          &parameters,
                        const SchemeTraits               &scheme,
                        const Body<dim>                  &body,
                        const std::vector<LinearElastic> &materials,
                        const std::vector<ContactPair>   &pairs);

  /// The treatment of @p parameters, for the time scheme @p scheme, on @p body
  /// against @p obstacles. @p stress is that of the body on the contact
  /// boundary; empty where it is not linear, in which case the treatments that
  /// use it are refused.
  ///
  /// @throws InputError when Nitsche's parameter is below its bound of stability
  /// on this mesh, or the contact points cannot be set up.
  template <int dim>
  std::unique_ptr<ContactOperator>
  make_contact(const ContactParameters                     &parameters,
               const SchemeTraits                          &scheme,
               const Body<dim>                             &body,
               const std::common_type_t<LinearStress<dim>> &stress,
               const Obstacles                             &obstacles);
} // namespace Ricochet

#endif
