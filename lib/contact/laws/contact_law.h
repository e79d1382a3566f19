// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_laws_contact_law_h
#define ricochet_contact_laws_contact_law_h

#include <deal.II/base/template_constraints.h>
#include <deal.II/base/tensor.h>

#include <Sacado_Fad_SFad.hpp>

#include <utility>

namespace Ricochet
{
  /**
   * The state variables of a law of normal contact in one point of the contact
   * boundary. Signs: gap > 0 is separated, pressures are positive in
   * compression.
   */
  template <typename Number = double>
  struct ContactPointState
  {
    /// Distance to the obstacle (m); negative when penetrating.
    Number gap{};
    /// Pressure of the body's own stress, -sigma_n(u_h) (Pa).
    Number stress_pressure{};
    /// Contact multiplier (Pa), where the treatment has one.
    Number multiplier{};
  };

  /// The generalised forces of a law, per unit of area: the virtual work is gap
  /// * delta(gap) + stress_pressure * delta(stress_pressure) + multiplier *
  /// delta(multiplier).
  template <typename Number = double>
  struct ContactPointForce
  {
    Number gap{};
    Number stress_pressure{};
    Number multiplier{};
  };

  /// Derivatives of the three forces (rows: gap, stress pressure, multiplier)
  /// with respect to the three state variables (columns, same order).
  using ContactPointTangent = dealii::Tensor<2, 3>;

  /// Positive part.
  template <typename Number>
  Number
  positive_part(const Number &x)
  {
    return x > 0. ? x : Number(0.);
  }

  /// Heaviside function with H(0) = 1/2.
  inline double
  heaviside(const double x)
  {
    return x > 0. ? 1. : (x < 0. ? 0. : .5);
  }

  /// Requirements of a law: the points in which it is evaluated, and the
  /// unknowns that it needs.
  struct ContactLawTraits
  {
    /// Nodes with a lumped boundary mass instead of quadrature points.
    bool nodal = false;
    /// The law brings a multiplier field.
    bool needs_multiplier = false;
    /// The law reads the stress pressure.
    bool uses_stress = false;
    /// The law reads the old state too, as a discrete derivative does; only
    /// the midpoint scheme can use it.
    bool is_two_point = false;
    /// Coulomb's friction with a tangential compliance can be added: minus the
    /// force on the gap is a contact pressure.
    bool takes_friction = false;
    /// The tangent depends on branch() only: factorisations can be reused while
    /// the branches stay the same. Otherwise the force is a pressure, never
    /// negative, that depends on the gap alone and falls with it.
    bool piecewise_linear = true;
    /// potential() is the potential of force(), so that a modified energy
    /// exists.
    bool has_potential = true;
  };

  /**
   * A pointwise contact law: a pure function of the state of one point,
   * independent of meshes, materials and time schemes.
   *
   * A concrete law is a struct from which ContactLawImplementation makes one of this
   * class, see contact_law_table.h; the table is in contact_treatment_table.cc.
   */
  class ContactLaw
  {
  public:
    virtual ~ContactLaw() = default;

    virtual ContactLawTraits
    traits() const = 0;

    /**
     * @param new_state state at the point where the law is enforced.
     * @param old_state state at the beginning of the step, for two-point laws.
     * @param cell_diameter h_T (m), by which some laws scale.
     */
    virtual ContactPointForce<>
    force(const ContactPointState<> &new_state,
          const ContactPointState<> &old_state,
          const double               cell_diameter) const = 0;

    /// Derivative of force() with respect to @p new_state.
    virtual ContactPointTangent
    tangent(const ContactPointState<> &new_state,
            const ContactPointState<> &old_state,
            const double               cell_diameter) const = 0;

    /// The smooth branch of the law on which the state is; 0 means no contact.
    virtual int
    branch(const ContactPointState<> &new_state,
           const ContactPointState<> &old_state,
           const double               cell_diameter) const = 0;

    /// Energy stored by the law per unit of area (J/m^2).
    virtual double
    potential(const ContactPointState<> &state,
              const double               cell_diameter) const = 0;

    /// The contact pressure of the law itself at a state (Pa).
    virtual double
    pressure(const ContactPointState<> &state,
             const double               cell_diameter) const = 0;

    /// Stiffness (Pa/m) that makes the multiplier's equation comparable with
    /// the forces; 1 for laws without multiplier.
    virtual double
    multiplier_scale(const double /*cell_diameter*/) const
    {
      return 1.;
    }
  };

  /**
   * Turns a struct with a templated force into a ContactLaw. By the template
   * the tests differentiate the same force that the programs use by automatic
   * differentiation, which also gives the tangent of laws without a tangent of
   * their own.
   */
  template <typename Law>
  class ContactLawImplementation : public ContactLaw
  {
  public:
    explicit ContactLawImplementation(const Law &law)
      : law(law)
    {}

    ContactLawTraits
    traits() const override
    {
      return Law::traits();
    }

    ContactPointForce<>
    force(const ContactPointState<> &new_state,
          const ContactPointState<> &old_state,
          const double               cell_diameter) const override
    {
      return law.template force<double>(new_state, old_state, cell_diameter);
    }

    ContactPointTangent
    tangent(const ContactPointState<> &new_state,
            const ContactPointState<> &old_state,
            const double               cell_diameter) const override
    {
      if constexpr (has<tangent_of>)
        return law.tangent(new_state, old_state, cell_diameter);
      else
        {
          using AD = Sacado::Fad::SFad<double, 3>;
          const ContactPointState<AD> variables{AD(3, 0, new_state.gap),
                                                AD(3,
                                                   1,
                                                   new_state.stress_pressure),
                                                AD(3, 2, new_state.multiplier)};
          const ContactPointForce<AD> force =
            law.template force<AD>(variables, old_state, cell_diameter);
          ContactPointTangent tangent;
          for (unsigned int c = 0; c < 3; ++c)
            {
              tangent[0][c] = force.gap.dx(c);
              tangent[1][c] = force.stress_pressure.dx(c);
              tangent[2][c] = force.multiplier.dx(c);
            }
          return tangent;
        }
    }

    /// Default for laws without a branch() of their own: whether there is a
    /// pressure.
    int
    branch(const ContactPointState<> &new_state,
           const ContactPointState<> &old_state,
           const double               cell_diameter) const override
    {
      if constexpr (has<branch_of>)
        return law.branch(new_state, old_state, cell_diameter);
      else
        return force(new_state, old_state, cell_diameter).gap != 0.;
    }

    double
    potential(const ContactPointState<> &state,
              const double               cell_diameter) const override
    {
      return law.potential(state, cell_diameter);
    }

    double
    pressure(const ContactPointState<> &state,
             const double               cell_diameter) const override
    {
      if constexpr (has<pressure_of>)
        return law.pressure(state, cell_diameter);
      else
        return -force(state, state, cell_diameter).gap;
    }

    double
    multiplier_scale(const double cell_diameter) const override
    {
      if constexpr (Law::traits().needs_multiplier)
        return law.stiffness(cell_diameter);
      else
        return 1.;
    }

  private:
    // Optional functions of the law.
    template <typename L>
    using tangent_of = decltype(std::declval<const L &>().tangent(
      std::declval<ContactPointState<>>(),
      std::declval<ContactPointState<>>(),
      1.));
    template <typename L>
    using branch_of = decltype(std::declval<const L &>().branch(
      std::declval<ContactPointState<>>(),
      std::declval<ContactPointState<>>(),
      1.));
    template <typename L>
    using pressure_of =
      decltype(std::declval<const L &>()
                 .pressure(std::declval<ContactPointState<>>(), 1.));

    template <template <typename...> class Operation>
    static constexpr bool has =
      dealii::internal::is_supported_operation<Operation, Law>;

    const Law law;
  };
} // namespace Ricochet

#endif
