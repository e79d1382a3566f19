// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/expressions.h>
#include <contact/obstacles/obstacle_shape.h>
#include <scene/condition_section.h>

#include <deal.II/base/utilities.h>

#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// The values of @p n expressions of x, y, z and t in @p text.
    template <int dim>
    std::function<
      double(const unsigned int, const double time, const Point<dim> &place)>
    parse_field(const std::string &text,
                const std::string &name,
                const unsigned int n)
    {
      const std::vector<std::string> texts = split_expressions(text);
      if (texts.size() != n)
        throw InputError(name + " needs " + std::to_string(n) +
                         (n == 1 ? " expression" : " expressions") +
                         ", separated by semicolons; it has " +
                         std::to_string(texts.size()) + ".");
      const Expressions expressions("x,y,z", texts, name, /* of time */ true);
      return [expressions, name](const unsigned int c,
                                 const double       time,
                                 const Point<dim>  &place) {
        const double value = expressions.value(c, in_space<dim>(place), time);
        if (!std::isfinite(value))
          throw ComputationError(
            name + " is not finite at t = " + to_text(time) + ".");
        return value;
      };
    }
  } // namespace



  template <int dim>
  VectorField<dim>
  parse_vector_field(const std::string &text, const std::string &name)
  {
    return
      [field = parse_field<dim>(text, name, dim)](const double      time,
                                                  const Point<dim> &place) {
        Tensor<1, dim> result;
        for (unsigned int c = 0; c < dim; ++c)
          result[c] = field(c, time, place);
        return result;
      };
  }



  template <int dim>
  void
  ConditionSection<dim>::add_parameters(ParameterHandler &parameters)
  {
    parameters.enter_subsection(section.full_name());
    parameters.add_parameter(
      "Boundary",
      boundary,
      "Where: a body, or some of its boundaries by numbers or names, 'beam: 3, "
      "foot'; several bodies are separated by semicolons.",
      Patterns::Anything());
    parameters.add_parameter(
      "Kind",
      kind,
      "fixed: does not move. displacement: moves as Value says (m), with the "
      "midpoint scheme or static. traction: is loaded by Value (Pa), a force per area of "
      "the undeformed body that keeps its direction. pressure: is loaded by Value (Pa), "
      "one expression, across the deformed surface, which it follows (for "
      "hyperelastic bodies). springs: is held by springs "
      "and dashpots.",
      Patterns::Selection("fixed|displacement|traction|pressure|springs"));
    parameters.add_parameter(
      "Components",
      components,
      "Of fixed, displacement and springs, the directions that are prescribed: 'x, y'; "
      "empty for all.",
      Patterns::Anything());
    parameters.add_parameter("Value",
                             value,
                             "Expressions of x, y, z and the time t, one for "
                             "each direction, separated by semicolons.",
                             Patterns::Anything());
    parameters.add_parameter("Stiffness",
                             stiffness,
                             "Of springs: traction against the displacement "
                             "(Pa/m).",
                             Patterns::Double(0.));
    parameters.add_parameter("Damping",
                             damping,
                             "Of dashpots: traction against the velocity (Pa "
                             "s/m), with the midpoint scheme.",
                             Patterns::Double(0.));
    parameters.leave_subsection();
  }



  template <int dim>
  std::vector<UnusedParameter>
  ConditionSection<dim>::unused_parameters() const
  {
    std::vector<UnusedParameter> unused;
    const std::string            is = "; " + name_of("Kind") + " is " + kind;
    if (kind == "fixed" || kind == "springs")
      unused.push_back(
        {name_of("Value"), "displacement, traction and pressure" + is});
    if (kind == "traction" || kind == "pressure")
      unused.push_back(
        {name_of("Components"), "fixed, displacement and springs" + is});
    if (kind != "springs")
      for (const std::string name : {"Stiffness", "Damping"})
        unused.push_back({name_of(name), "springs" + is});
    return unused;
  }



  template <int dim>
  std::array<bool, dim>
  ConditionSection<dim>::which_components() const
  {
    std::array<bool, dim> which{};
    if (Utilities::trim(components).empty())
      which.fill(true);
    else
      for (const std::string &letter :
           Utilities::split_string_list(components, ','))
        {
          const std::size_t c = std::string("xyz").find(letter);
          if (letter.size() != 1 || c >= dim)
            throw InputError(name_of("Components") + ": '" +
                             letter.substr(0, 100) +
                             "' is no direction. Allowed: " +
                             (dim == 2 ? "x, y." : "x, y, z."));
          which[c] = true;
        }
    return which;
  }



  template <int dim>
  void
  ConditionSection<dim>::add_to(const SurfaceNames &surfaces,
                                ImpactSetup<dim>   &setup) const
  {
    const std::array<bool, dim> which = which_components();
    VectorField<dim>            field;
    if (kind == "springs" && stiffness == 0. && damping == 0.)
      throw InputError(section.where + ": the springs '" + section.name +
                       "' have neither " + name_of("Stiffness") + " nor " +
                       name_of("Damping") + ".");
    if (kind == "displacement" || kind == "traction")
      field = parse_vector_field<dim>(value, name_of("Value"));
    std::function<double(const double, const Point<dim> &)> pressure;
    if (kind == "pressure")
      pressure = [field = parse_field<dim>(value, name_of("Value"), 1)](
                   const double      time,
                   const Point<dim> &place) { return field(0, time, place); };
    for (const auto &surface : surfaces.find(boundary, name_of("Boundary")))
      for (const auto id : surface.ids)
        if (kind == "pressure")
          setup.pressures.push_back({id, pressure});
        else if (kind == "springs")
          setup.springs.push_back({id, which, stiffness, damping});
        else if (kind == "traction")
          {
            VectorField<dim> &traction = setup.tractions[id];
            traction                   = traction
                                ? [first = traction, field](
                  const double time,
                  const Point<dim>
                    &place) { return first(time, place) + field(time, place); }
                                : field;
          }
        else
          {
            // Directions of one boundary may follow several conditions.
            ImposedDisplacement<dim> &all = setup.imposed[id];
            for (unsigned int c = 0; c < dim; ++c)
              if (which[c] && all.components[c])
                throw InputError(section.where + ": the condition '" +
                                 section.name +
                                 "' prescribes what another one prescribes "
                                 "already, in direction " +
                                 std::string("xyz").substr(c, 1) + ".");
            const VectorField<dim> first = all.value;
            if (first || field)
              all.value = [first, field, which](const double      time,
                                                const Point<dim> &place) {
                const Tensor<1, dim> zero,
                  before = first ? first(time, place) : zero,
                  own    = field ? field(time, place) : zero;
                Tensor<1, dim> result;
                for (unsigned int c = 0; c < dim; ++c)
                  result[c] = which[c] ? own[c] : before[c];
                return result;
              };
            for (unsigned int c = 0; c < dim; ++c)
              all.components[c] = all.components[c] || which[c];
          }
  }


  template struct ConditionSection<2>;
  template struct ConditionSection<3>;
  template VectorField<2>
  parse_vector_field<2>(const std::string &, const std::string &);
  template VectorField<3>
  parse_vector_field<3>(const std::string &, const std::string &);
} // namespace Ricochet
