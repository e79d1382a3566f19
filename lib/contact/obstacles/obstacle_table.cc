// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <contact/obstacles/cylinder_shape.h>
#include <contact/obstacles/half_space.h>
#include <contact/obstacles/level_set.h>
#include <contact/obstacles/obstacle_parameters.h>
#include <contact/obstacles/sphere_shape.h>
#include <contact/obstacles/torus_shape.h>

#include <functional>
#include <set>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    struct Entry
    {
      std::string name;
      /// The parameters of the shape.
      std::set<std::string> uses;
      std::function<std::shared_ptr<const ObstacleShape>(
        const ObstacleParameters<dim> &)>
        make;
    };

    // The table of all shapes: a new one is one file and one entry here.
    template <int dim>
    const std::vector<Entry<dim>> &
    table()
    {
      using P                                     = ObstacleParameters<dim>;
      static const std::vector<Entry<dim>> shapes = [] {
        std::vector<Entry<dim>> list = {
          {"half space",
           {"Centre", "Direction"},
           [](const P &p) {
             return std::make_shared<HalfSpace>(in_space(p.centre),
                                                in_space(p.direction));
           }},
          {dim == 2 ? "circle" : "sphere",
           {"Centre", "Radius", "Body inside"},
           [](const P &p) {
             return std::make_shared<SphereShape>(in_space(p.centre),
                                                  p.radius,
                                                  p.hollow);
           }},
          {"level set", {"Function", "Gradient", "Length"}, [](const P &p) {
             return std::make_shared<LevelSet>(dim,
                                               p.function,
                                               split_expressions(p.gradient),
                                               p.length);
           }}};
        // Shapes in 3D only: in 2D their sections are circles or shapes listed
        // above.
        if constexpr (dim == 3)
          {
            list.push_back(
              {"cylinder",
               {"Centre", "Direction", "Radius", "Body inside"},
               [](const P &p) {
                 return std::make_shared<CylinderShape>(p.centre,
                                                        p.direction,
                                                        p.radius,
                                                        p.hollow);
               }});
            list.push_back(
              {"torus",
               {"Centre", "Direction", "Radius", "Tube radius"},
               [](const P &p) {
                 return std::make_shared<TorusShape>(p.centre,
                                                     p.direction,
                                                     p.radius,
                                                     p.tube_radius);
               }});
          }
        return list;
      }();
      return shapes;
    }

    template <int dim>
    const Entry<dim> &
    find(const ObstacleParameters<dim> &parameters)
    {
      for (const Entry<dim> &entry : table<dim>())
        if (entry.name == parameters.shape)
          return entry;
      AssertThrow(false, ExcMessage("unknown obstacle " + parameters.shape));
      return table<dim>().front();
    }
  } // namespace



  template <int dim>
  ObstacleParameters<dim>::ObstacleParameters()
  {
    direction[dim - 1] = 1.;
    rotation_axis[2]   = 1.;
  }



  template <int dim>
  void
  ObstacleParameters<dim>::add_parameters(ParameterHandler &parameters)
  {
    std::string shapes;
    for (const Entry<dim> &entry : table<dim>())
      shapes += (shapes.empty() ? "" : "|") + entry.name;

    parameters.enter_subsection(section);
    parameters.add_parameter("Shape",
                             shape,
                             "Surface of the rigid obstacle.",
                             Patterns::Selection(shapes));
    parameters.add_parameter(
      "Centre",
      centre,
      "A point of the plane or the axis, or the centre (m). Used by all shapes "
      "but the level set.");
    parameters.add_parameter(
      "Direction",
      direction,
      dim == 2 ? "Normal of the plane, towards the body; of any length."
               : "Normal of the plane, towards the body, or axis of cylinder "
                 "and torus; of any length.");
    parameters.add_parameter("Radius",
                             radius,
                             dim == 2
                               ? "Radius of the circle (m)."
                               : "Radius of sphere and cylinder, or of the "
                                 "circle in the middle of a torus (m).",
                             Patterns::Double(1e-30));
    if constexpr (dim == 3)
      parameters.add_parameter("Tube radius",
                               tube_radius,
                               "Radius of the tube of a torus (m).",
                               Patterns::Double(1e-30));
    parameters.add_parameter("Body inside",
                             hollow,
                             "The obstacle is all that lies outside: a bowl, a "
                             "drum, a tube.");
    parameters.add_parameter(
      "Function",
      function,
      "Level set: a function of x, y and z that is zero on the surface and "
      "positive where the body may be. The gap is its value over the length of "
      "its gradient.");
    parameters.add_parameter(
      "Gradient",
      gradient,
      "Level set: derivatives of the function, separated "
      "by semicolons.");
    parameters.add_parameter(
      "Length",
      length,
      "Level set: length over which the gradient changes "
      "noticeably (m); differences that replace second "
      "derivatives are taken over a thousandth of it.",
      Patterns::Double(1e-30));
    parameters.add_parameter(
      "Translation",
      translation,
      "Displacement of the obstacle (m), expressions of the time "
      "t separated by semicolons.");
    parameters.add_parameter("Rotation",
                             rotation,
                             "Angle (rad) by which the obstacle is turned, an "
                             "expression of the time t.");
    parameters.add_parameter("Rotation centre",
                             rotation_centre,
                             "The point about which it turns, where it is "
                             "before any translation (m).");
    if constexpr (dim == 3)
      parameters.add_parameter("Rotation axis",
                               rotation_axis,
                               "The axis about which it turns, of any length.");
    parameters.leave_subsection();
  }



  template <int dim>
  std::vector<UnusedParameter>
  ObstacleParameters<dim>::unused_parameters() const
  {
    const Entry<dim>            &own = find(*this);
    std::vector<UnusedParameter> unused;
    std::set<std::string>        names;
    for (const Entry<dim> &entry : table<dim>())
      names.insert(entry.uses.begin(), entry.uses.end());
    for (const std::string &name : names)
      if (own.uses.count(name) == 0)
        {
          std::string owners;
          for (const Entry<dim> &entry : table<dim>())
            if (entry.uses.count(name) > 0)
              owners += (owners.empty() ? "" : " and ") + entry.name;
          unused.push_back({section + "/" + name,
                            owners + "; " + section + "/Shape is " + shape});
        }
    if (Utilities::trim(rotation) == "0")
      {
        const std::string owner = "rotation; " + section + "/Rotation is 0";
        unused.push_back({section + "/Rotation centre", owner});
        if (dim == 3)
          unused.push_back({section + "/Rotation axis", owner});
      }
    return unused;
  }



  template <int dim>
  std::shared_ptr<const RigidObstacle>
  ObstacleParameters<dim>::make(const double final_time) const
  {
    const Entry<dim> &own = find(*this);
    if (own.uses.count("Direction") > 0 && direction.norm() == 0.)
      throw InputError(section + "/Direction is a vector of no length.");
    if (rotation_axis.norm() == 0.)
      throw InputError(section + "/Rotation axis is a vector of no length.");
    std::vector<std::string> way = split_expressions(translation);
    if (way.size() != dim)
      throw InputError(section + "/Translation needs " + std::to_string(dim) +
                       " expressions, separated by semicolons; it has " +
                       std::to_string(way.size()) + ".");
    way.resize(3, "0");
    const RigidMotion motion(way,
                             rotation,
                             in_space(rotation_centre),
                             rotation_axis);
    // A motion that is not finite later is an error of the input, too.
    try
      {
        for (unsigned int k = 0; k <= 1000; ++k)
          motion.placement(k * 1e-3 * final_time);
      }
    catch (const ComputationError &error)
      {
        throw InputError(error.what());
      }
    return std::make_shared<RigidObstacle>(own.make(*this), motion);
  }


  template struct ObstacleParameters<2>;
  template struct ObstacleParameters<3>;
} // namespace Ricochet
