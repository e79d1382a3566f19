// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_scene_surface_names_h
#define ricochet_scene_surface_names_h

#include <deal.II/base/types.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace Ricochet
{
  /// Names of surfaces in a scene of several bodies, each of which has boundary
  /// ids, and possibly names for them, of its own.
  class SurfaceNames
  {
  public:
    /// A surface of one body: its boundary ids in the scene.
    struct Surface
    {
      unsigned int                         body;
      std::set<dealii::types::boundary_id> ids;
    };

    /**
     * Number the boundaries of a body, the next one, in the scene.
     * @param own_ids in the body's mesh.
     * @param own_names of some of them.
     * @return the numbers in the scene by those in the mesh.
     */
    std::map<dealii::types::boundary_id, dealii::types::boundary_id>
    add_body(
      const std::string                                       &name,
      const std::set<dealii::types::boundary_id>              &own_ids,
      const std::map<std::string, dealii::types::boundary_id> &own_names);

    /// Number of the body @p name, or nothing that is one: n_bodies().
    unsigned int
    find_body(const std::string &name) const;

    unsigned int
    n_bodies() const
    {
      return bodies.size();
    }

    /**
     * The surfaces that @p text names: "ball", all of its boundary, or "ball: 3, sole",
     * some of it; several bodies are separated by semicolons.
     *
     * @param where for messages: "Contact ball on floor/Surface".
     * @throws InputError for a body or a boundary that does not exist, with those that
     * do.
     */
    std::vector<Surface>
    find(const std::string &text, const std::string &where) const;

    /// Description of the boundary with the number @p id of the scene in its
    /// body: its number there, and its name if it has one.
    std::string
    name_of(const dealii::types::boundary_id id) const;

    /// Boundaries of all bodies; their numbers are below.
    dealii::types::boundary_id
    n_boundaries() const
    {
      return n_ids;
    }

    /// Names of all bodies, for messages.
    std::vector<std::string>
    body_names() const;

  private:
    struct Body
    {
      std::string                                                      name;
      std::map<dealii::types::boundary_id, dealii::types::boundary_id> id;
      std::map<std::string, dealii::types::boundary_id> own_names;
    };

    std::vector<Body>          bodies;
    dealii::types::boundary_id n_ids = 0;
  };
} // namespace Ricochet

#endif
