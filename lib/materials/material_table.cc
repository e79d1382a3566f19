// SPDX-License-Identifier: LGPL-2.1-or-later
#include <materials/laws/ciarlet_geymonat.h>
#include <materials/laws/mooney_rivlin.h>
#include <materials/laws/neo_hookean.h>
#include <materials/laws/saint_venant_kirchhoff.h>
#include <materials/laws/yeoh.h>
#include <materials/material_table.h>

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
    NamedTable<MaterialEntry> &
    table()
    {
      static NamedTable<MaterialEntry> laws(
        "an",
        "elastic law",
        {linear_elastic(),
         material_entry<CiarletGeymonat>(),
         material_entry<SaintVenantKirchhoff>(),
         material_entry<NeoHookean>(),
         material_entry<MooneyRivlin>(),
         material_entry<Yeoh>()});
      return laws;
    }
  } // namespace



  const NamedTable<MaterialEntry> &
  material_table()
  {
    return table();
  }



  void
  register_material(const MaterialEntry &entry)
  {
    table().add(entry);
  }
} // namespace Ricochet
