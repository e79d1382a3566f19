// SPDX-License-Identifier: LGPL-2.1-or-later
#include <materials/laws/ciarlet_geymonat.h>
#include <materials/laws/neo_hookean.h>
#include <materials/laws/saint_venant_kirchhoff.h>
#include <materials/material_table.h>

#include <deal.II/base/exceptions.h>

namespace Ricochet
{
  namespace
  {
    MaterialEntry
    linear_elastic()
    {
      MaterialEntry entry;
      entry.name             = LinearElastic::name;
      entry.parameters       = LinearElastic::parameters();
      entry.at_small_strains = LinearElastic::make;
      return entry;
    }

    // The table of elastic laws: a new one is one file in laws/ and one line here.
    std::vector<MaterialEntry> &
    table()
    {
      static std::vector<MaterialEntry> entries = {
        linear_elastic(),
        material_entry<CiarletGeymonat>(),
        material_entry<SaintVenantKirchhoff>(),
        material_entry<NeoHookean>()};
      return entries;
    }
  } // namespace



  const std::vector<MaterialEntry> &
  material_table()
  {
    return table();
  }



  void
  register_material(const MaterialEntry &entry)
  {
    for (const MaterialEntry &other : table())
      AssertThrow(other.name != entry.name,
                  dealii::ExcMessage("There is an elastic law '" + entry.name +
                                     "' already."));
    table().push_back(entry);
  }
} // namespace Ricochet
