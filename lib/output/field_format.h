// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_field_format_h
#define ricochet_output_field_format_h

namespace Ricochet
{
  /// Files for fields: VTU, or HDF5 with an XDMF file. Both have values in single precision, as the
  /// patches of deal.II.
  enum class FieldFormat
  {
    vtu,
    hdf5
  };
} // namespace Ricochet

#endif
