// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_impact_loop_h
#define ricochet_problems_impact_loop_h

#include <output/contact_series.h>
#include <output/field_extremes.h>
#include <output/vtu_series.h>
#include <problems/impact.h>

namespace Ricochet
{
  /**
   * The time loop of an impact that writes its fields: a program adds the columns of its
   * own, and runs it.
   */
  template <int dim>
  class ImpactLoop : public TimeLoop
  {
  public:
    /**
     * @param impact must live as long as the loop.
     * @param materials of the parts, or of the only body.
     * @param contact_names see TimeLoop.
     * @param units of the ledger.
     */
    ImpactLoop(
      const TimeLoop::Parameters                              &parameters,
      Impact<dim>                                             &impact,
      const std::vector<Material<dim>>                        &materials,
      const std::map<dealii::types::boundary_id, std::string> &contact_names,
      RunFolder                                               &folder,
      const Units                                             &units = {})
      : TimeLoop(parameters,
                 folder,
                 impact.system,
                 *impact.scheme,
                 contact_names,
                 units)
      , fields(impact.body,
               materials,
               *impact.contact,
               impact.obstacles,
               folder,
               parameters.field_format())
      , extremes(impact.body, materials)
      , contact_series(impact.body,
                       *impact.contact,
                       contact_names,
                       folder,
                       units)
    {
      write_fields = [this](const State &state, const unsigned int step) {
        fields.write(state, step);
        extremes.update(state);
      };
      field_extremes = [this]() -> const std::vector<FieldExtreme> & {
        return extremes.all();
      };
      write_contact = [this](const State &state, const unsigned int step) {
        contact_series.write(state, step);
      };
    }

    // The functions above have the address of the loop.
    ImpactLoop(const ImpactLoop &) = delete;

  private:
    VtuSeries<dim>     fields;
    FieldExtremes<dim> extremes;
    ContactSeries<dim> contact_series;
  };
} // namespace Ricochet

#endif
