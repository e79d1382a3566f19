// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/expressions.h>
#include <base/time_table.h>
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

    /// The vector field of @p dim functions.
    template <int dim>
    VectorField<dim>
    vector_field(
      const std::function<double(const unsigned int,
                                 const double      time,
                                 const Point<dim> &place)> &components)
    {
      return [components](const double time, const Point<dim> &place) {
        Tensor<1, dim> result;
        for (unsigned int c = 0; c < dim; ++c)
          result[c] = components(c, time, place);
        return result;
      };
    }
  } // namespace



  template <int dim>
  VectorField<dim>
  parse_vector_field(const std::string &text, const std::string &name)
  {
    return vector_field<dim>(parse_field<dim>(text, name, dim));
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
      "Point",
      point,
      "Of fixed, displacement and force, a place (m) whose nearest vertex of the body is "
      "held, moved or loaded, instead of a boundary. Empty: the boundary.",
      Patterns::List(Patterns::Double(), 0, dim));
    parameters.add_parameter(
      "Kind",
      kind,
      "fixed: does not move. displacement: moves as Value says (m), with the "
      "midpoint scheme or static. traction: is loaded by Value (Pa), a force per area of "
      "the undeformed body that keeps its direction. force: the same with the whole force "
      "(N), spread evenly. moment: the same with the moment about the middle of the boundary "
      "(N m), in 2D one expression. pressure: is loaded by Value (Pa), "
      "one expression, across the deformed surface, which it follows (for "
      "hyperelastic bodies). springs: is held by springs and dashpots, whose other ends are "
      "displaced by Value (m).",
      Patterns::Selection(
        "fixed|displacement|traction|force|moment|pressure|springs"));
    parameters.add_parameter(
      "Components",
      components,
      "Of fixed, displacement and springs, the directions that are prescribed: 'x, y'; "
      "empty for all.",
      Patterns::Anything());
    parameters.add_parameter(
      "Value",
      value,
      "Expressions of x, y, z and the time t, one for "
      "each direction, separated by semicolons; of force and moment "
      "of t alone.",
      Patterns::Anything());
    parameters.add_parameter(
      "Table",
      table,
      "File with a table of times (s) and values, separated by commas: Value (empty: 1) "
      "times what the table has at the time t, linear between its rows; one value for all "
      "directions or one for each.",
      Patterns::FileName());
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
    if (kind == "fixed")
      for (const std::string name : {"Value", "Table"})
        unused.push_back({name_of(name), "other kinds" + is});
    if (kind != "fixed" && kind != "displacement" && kind != "springs")
      unused.push_back(
        {name_of("Components"), "fixed, displacement and springs" + is});
    if (kind != "fixed" && kind != "displacement" && kind != "force")
      unused.push_back(
        {name_of("Point"), "fixed, displacement and force" + is});
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
  std::set<types::boundary_id>
  ConditionSection<dim>::find_ids(const SurfaceNames              &surfaces,
                                  const std::vector<unsigned int> &first_part,
                                  ImpactSetup<dim>                &setup) const
  {
    const auto found = surfaces.find(boundary, name_of("Boundary"));
    std::set<types::boundary_id> ids;
    if (point.empty() ||
        (kind != "fixed" && kind != "displacement" && kind != "force"))
      {
        for (const auto &surface : found)
          ids.insert(surface.ids.begin(), surface.ids.end());
        return ids;
      }
    if (point.size() != dim)
      throw InputError(name_of("Point") + " needs " + std::to_string(dim) +
                       " numbers.");
    if (found.size() > 1)
      throw InputError(name_of("Boundary") +
                       " has to name one body, of which " + name_of("Point") +
                       " chooses a vertex.");
    typename Body<dim>::Vertex vertex;
    for (unsigned int c = 0; c < dim; ++c)
      vertex.place[c] = point[c];
    vertex.begin   = first_part[found.front().body];
    vertex.end     = first_part[found.front().body + 1];
    vertex.n_parts = first_part.back();
    const types::boundary_id id =
      surfaces.n_boundaries() + setup.vertices.size();
    setup.vertices[id] = vertex;
    return {id};
  }



  template <int dim>
  typename ConditionSection<dim>::Field
  ConditionSection<dim>::field(const unsigned int n) const
  {
    std::string text = value;
    if (Utilities::trim(text).empty() && !table.empty())
      for (unsigned int c = 0; c < n; ++c)
        text += c == 0 ? "1" : "; 1";
    const Field of_text = parse_field<dim>(text, name_of("Value"), n);
    if (table.empty())
      return of_text;
    const TimeTable factors(table, name_of("Table"));
    if (factors.n_values() != 1 && factors.n_values() != n)
      throw InputError(name_of("Table") + ": '" + table + "' has " +
                       std::to_string(factors.n_values()) +
                       " values for each time, and should have one" +
                       (n > 1 ? " or " + std::to_string(n) : "") + ".");
    return [of_text, factors](const unsigned int c,
                              const double       time,
                              const Point<dim>  &place) {
      return of_text(c, time, place) *
        factors.value(factors.n_values() == 1 ? 0 : c, time);
    };
  }



  template <int dim>
  void
  ConditionSection<dim>::prescribe(const types::boundary_id id,
                                   const VectorField<dim>  &own,
                                   ImpactSetup<dim>        &setup) const
  {
    // Directions of one boundary may follow several conditions.
    const std::array<bool, dim> which = which_components();
    ImposedDisplacement<dim>   &all   = setup.imposed[id];
    for (unsigned int c = 0; c < dim; ++c)
      if (which[c] && all.components[c])
        throw InputError(section.where + ": the condition '" + section.name +
                         "' prescribes what another one prescribes "
                         "already, in direction " +
                         std::string("xyz").substr(c, 1) + ".");
    const VectorField<dim> other = all.value;
    if (other || own)
      all.value = [other, own, which](const double      time,
                                      const Point<dim> &place) {
        const Tensor<1, dim> zero, of_other = other ? other(time, place) : zero,
                                   of_own = own ? own(time, place) : zero;
        Tensor<1, dim> result;
        for (unsigned int c = 0; c < dim; ++c)
          result[c] = which[c] ? of_own[c] : of_other[c];
        return result;
      };
    for (unsigned int c = 0; c < dim; ++c)
      all.components[c] = all.components[c] || which[c];
  }



  template <int dim>
  void
  ConditionSection<dim>::add_to(const SurfaceNames              &surfaces,
                                const std::vector<unsigned int> &first_part,
                                ImpactSetup<dim>                &setup) const
  {
    const bool has_value = !Utilities::trim(value).empty() || !table.empty();
    if (kind == "springs" && stiffness == 0. && damping == 0.)
      throw InputError(section.where + ": the springs '" + section.name +
                       "' have neither " + name_of("Stiffness") + " nor " +
                       name_of("Damping") + ".");
    if (kind == "springs" && damping > 0. && has_value)
      throw InputError(name_of("Value") +
                       " displaces the ends of springs, not those of dashpots: "
                       "give them a condition of their own.");
    const std::set<types::boundary_id> ids =
      find_ids(surfaces, first_part, setup);
    const std::array<bool, dim> which        = which_components();
    const auto                  add_traction = [&](const types::boundary_id id,
                                  const VectorField<dim>  &own) {
      VectorField<dim> &traction = setup.tractions[id];
      traction                   = traction
                                           ? [first = traction,
           own](const double time,
                const Point<dim>
                  &place) { return first(time, place) + own(time, place); }
                                           : own;
    };

    if (kind == "fixed")
      for (const auto id : ids)
        prescribe(id, {}, setup);
    else if (kind == "displacement")
      for (const auto id : ids)
        prescribe(id, vector_field<dim>(field(dim)), setup);
    else if (kind == "traction")
      for (const auto id : ids)
        add_traction(id, vector_field<dim>(field(dim)));
    else if (kind == "force")
      setup.resultants.push_back(
        {ids,
         [force = vector_field<dim>(field(dim))](const double time) {
           return force(time, Point<dim>());
         },
         {}});
    else if (kind == "moment")
      setup.resultants.push_back(
        {ids, {}, [moment = field(dim == 2 ? 1 : 3)](const double time) {
           Tensor<1, 3> result;
           if (dim == 2)
             result[2] = moment(0, time, Point<dim>());
           else
             for (unsigned int c = 0; c < 3; ++c)
               result[c] = moment(c, time, Point<dim>());
           return result;
         }});
    else if (kind == "pressure")
      for (const auto id : ids)
        setup.pressures.push_back(
          {id,
           [pressure = field(1)](const double time, const Point<dim> &place) {
             return pressure(0, time, place);
           }});
    else
      for (const auto id : ids)
        {
          setup.springs.push_back({id, which, stiffness, damping});
          // The traction k (Value - u) in two terms.
          if (has_value && stiffness > 0.)
            add_traction(id,
                         [ends = vector_field<dim>(field(dim)),
                          which,
                          k = stiffness](const double      time,
                                         const Point<dim> &place) {
                           Tensor<1, dim> result = k * ends(time, place);
                           for (unsigned int c = 0; c < dim; ++c)
                             result[c] *= which[c];
                           return result;
                         });
        }
  }


  template struct ConditionSection<2>;
  template struct ConditionSection<3>;
  template VectorField<2>
  parse_vector_field<2>(const std::string &, const std::string &);
  template VectorField<3>
  parse_vector_field<3>(const std::string &, const std::string &);
} // namespace Ricochet
