// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/unknown_name.h>
#include <scene/surface_names.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>

namespace Ricochet
{
  using namespace dealii;

  std::map<types::boundary_id, types::boundary_id>
  SurfaceNames::add_body(
    const std::string                               &name,
    const std::set<types::boundary_id>              &own_ids,
    const std::map<std::string, types::boundary_id> &own_names)
  {
    Body body{name, {}, {}};
    for (const auto id : own_ids)
      body.id[id] = n_ids++;
    // A name may be one of something within the body.
    for (const auto &[own_name, id] : own_names)
      if (own_ids.count(id) > 0)
        body.own_names[own_name] = id;
    bodies.push_back(body);
    return body.id;
  }



  unsigned int
  SurfaceNames::find_body(const std::string &name) const
  {
    for (unsigned int b = 0; b < bodies.size(); ++b)
      if (bodies[b].name == name)
        return b;
    return bodies.size();
  }



  std::string
  SurfaceNames::name_of(const types::boundary_id id) const
  {
    for (const Body &body : bodies)
      for (const auto &[own, in_scene] : body.id)
        if (in_scene == id)
          {
            std::string text = std::to_string(own);
            for (const auto &[own_name, own_id] : body.own_names)
              if (own_id == own)
                text += " (" + own_name + ")";
            return text;
          }
    return "unknown";
  }



  std::vector<std::string>
  SurfaceNames::body_names() const
  {
    std::vector<std::string> names;
    for (const Body &body : bodies)
      names.push_back(body.name);
    return names;
  }



  namespace
  {
    std::string
    quoted(const std::string &name)
    {
      return "'" + name.substr(0, 100) + "'";
    }

    std::string
    list_of(const std::vector<std::string> &names)
    {
      return "\nThere is: " +
        (names.empty() ? "nothing" : boost::algorithm::join(names, ", ")) + ".";
    }
  } // namespace



  std::vector<SurfaceNames::Surface>
  SurfaceNames::find(const std::string &text, const std::string &where) const
  {
    std::vector<Surface> surfaces;
    for (const std::string &item : Utilities::split_string_list(text, ';'))
      {
        const std::size_t  colon = item.find(':');
        const std::string  name  = Utilities::trim(item.substr(0, colon));
        const unsigned int b     = find_body(name);
        if (b == bodies.size())
          throw unknown_name(where + ": there is no body " + quoted(name),
                             name,
                             body_names(),
                             list_of(body_names()));
        const Body &body = bodies[b];
        Surface     surface{b, {}};
        if (colon == std::string::npos)
          for (const auto &entry : body.id)
            surface.ids.insert(entry.second);
        else
          for (const std::string &boundary :
               Utilities::split_string_list(item.substr(colon + 1), ','))
            {
              std::vector<std::string> candidates;
              auto                     found = body.id.end();
              for (const auto &[own_name, id] : body.own_names)
                {
                  candidates.push_back(own_name);
                  if (own_name == boundary)
                    found = body.id.find(id);
                }
              for (auto entry = body.id.begin(); entry != body.id.end();
                   ++entry)
                {
                  candidates.push_back(std::to_string(entry->first));
                  if (candidates.back() == boundary)
                    found = entry;
                }
              if (found == body.id.end())
                throw unknown_name(where + ": the body " + quoted(name) +
                                     " has no boundary " + quoted(boundary),
                                   boundary,
                                   candidates,
                                   list_of(candidates));
              surface.ids.insert(found->second);
            }
        if (body.id.empty())
          throw InputError(where + ": the body " + quoted(name) +
                           " has no boundary.");
        if (surface.ids.empty())
          throw InputError(where + ": '" + item.substr(0, 100) +
                           "' names no boundary of the body " + quoted(name) +
                           "; without the colon it is all of it.");
        for (const Surface &other : surfaces)
          for (const auto id : surface.ids)
            if (other.ids.count(id) > 0)
              throw InputError(where + ": the boundary " + name_of(id) +
                               " of the body " + quoted(name) +
                               " is named twice.");
        surfaces.push_back(surface);
      }
    if (surfaces.empty())
      throw InputError(where + " names no body.");
    return surfaces;
  }
} // namespace Ricochet
