// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <output/hdf5_image.h>

#include <hdf5.h>

namespace Ricochet
{
  namespace
  {
    void
    check(const long long result)
    {
      if (result < 0)
        throw ComputationError("HDF5 cannot make a table.");
    }

    /// A handle of HDF5 that is closed at the end.
    class Handle
    {
    public:
      Handle(const hid_t id, herr_t (*close)(hid_t))
        : id(id)
        , close(close)
      {
        check(id);
      }

      ~Handle()
      {
        close(id);
      }

      Handle(const Handle &) = delete;
      Handle &
      operator=(const Handle &) = delete;

      operator hid_t() const
      {
        return id;
      }

    private:
      const hid_t id;
      herr_t (*const close)(hid_t);
    };

    hid_t
    new_file()
    {
      // Memory for the start of HDF5, which crashes where it does not get any.
      std::vector<char>(8 << 20);
      const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
      check(H5Pset_fapl_core(access, 1 << 16, /* on disk */ false));
      const hid_t file =
        H5Fcreate("in memory", H5F_ACC_TRUNC, H5P_DEFAULT, access);
      check(file);
      return file;
    }
  } // namespace



  Hdf5Image::Hdf5Image()
    : file(new_file())
  {}



  Hdf5Image::~Hdf5Image()
  {
    H5Fclose(file);
  }



  void
  Hdf5Image::add(const std::string         &path,
                 const std::vector<double> &values,
                 const unsigned int         n_columns,
                 const std::string         &unit)
  {
    const hsize_t sizes[2] = {values.size() / n_columns, n_columns};
    const Handle space(H5Screate_simple(n_columns == 1 ? 1 : 2, sizes, nullptr),
                       H5Sclose);
    const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    check(H5Pset_create_intermediate_group(links, 1));
    const Handle data(H5Dcreate2(file,
                                 path.c_str(),
                                 H5T_NATIVE_DOUBLE,
                                 space,
                                 links,
                                 H5P_DEFAULT,
                                 H5P_DEFAULT),
                      H5Dclose);
    if (!values.empty())
      check(H5Dwrite(data,
                     H5T_NATIVE_DOUBLE,
                     H5S_ALL,
                     H5S_ALL,
                     H5P_DEFAULT,
                     values.data()));
    const Handle scalar(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle text(H5Tcopy(H5T_C_S1), H5Tclose);
    check(H5Tset_size(text, H5T_VARIABLE));
    const Handle attribute(
      H5Acreate2(data, "unit", text, scalar, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
    const char *const unit_text = unit.c_str();
    check(H5Awrite(attribute, text, &unit_text));
  }



  void
  Hdf5Image::add_attribute(const std::string &name, const double value)
  {
    const Handle scalar(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate2(file,
                                      name.c_str(),
                                      H5T_NATIVE_DOUBLE,
                                      scalar,
                                      H5P_DEFAULT,
                                      H5P_DEFAULT),
                           H5Aclose);
    check(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value));
  }



  std::string
  Hdf5Image::bytes() const
  {
    check(H5Fflush(file, H5F_SCOPE_GLOBAL));
    const ssize_t size = H5Fget_file_image(file, nullptr, 0);
    check(size);
    std::string image(size, '\0');
    check(H5Fget_file_image(file, image.data(), image.size()));
    return image;
  }
} // namespace Ricochet
