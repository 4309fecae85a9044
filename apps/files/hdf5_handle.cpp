#include "files/hdf5_handle.hpp"

#include <algorithm>
#include <cstdint>

namespace files::hdf5 {

namespace {

/// HDF5 walks from the innermost error outwards when asked to walk upward; the first is the cause.
herr_t keep_first(unsigned level, const H5E_error2_t* error, void* data) {
  auto& reason = *static_cast<std::string*>(data);
  if (level == 0 && error->desc != nullptr) reason = error->desc;
  return 0;
}

}  // namespace

void fail(const std::filesystem::path& file, const std::string& what) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
  throw FileError(file, reason.empty() ? what : what + " (HDF5: " + reason + ")");
}

Handle text_type(std::size_t length, const std::filesystem::path& file) {
  Handle type(check(H5Tcopy(H5T_C_S1), file, "cannot make a text type"), H5Tclose);
  check(H5Tset_size(type.id(), std::max<std::size_t>(length, 1)), file, "cannot size a text type");
  check(H5Tset_strpad(type.id(), H5T_STR_NULLPAD), file, "cannot pad a text type");
  check(H5Tset_cset(type.id(), H5T_CSET_UTF8), file, "cannot set a text type to UTF-8");
  return type;
}

std::string type_name(hid_t type) {
  if (H5Tget_class(type) == H5T_STRING) {
    return H5Tis_variable_str(type) > 0 ? "other" : "text";
  }
  const std::pair<hid_t, const char*> known[] = {{H5T_NATIVE_DOUBLE, "float64"},
                                                 {H5T_NATIVE_FLOAT, "float32"},
                                                 {H5T_NATIVE_INT64, "int64"},
                                                 {H5T_NATIVE_INT32, "int32"},
                                                 {H5T_NATIVE_UINT8, "uint8"}};
  for (const auto& [native, name] : known) {
    if (H5Tequal(type, native) > 0) return name;
  }
  return "other";
}

}  // namespace files::hdf5
