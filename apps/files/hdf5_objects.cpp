// Groups and attributes of Hdf5File; datasets are in hdf5_file.cpp.

#include <algorithm>

#include "files/hdf5_file.hpp"
#include "files/hdf5_handle.hpp"

namespace files {

namespace {

using hdf5::check;
using hdf5::Handle;
using hdf5::Silence;

Handle open_object(std::int64_t file_id, const std::filesystem::path& file,
                   const std::string& path) {
  return {check(H5Oopen(file_id, path.c_str(), H5P_DEFAULT), file, path + " cannot be opened"),
          H5Oclose};
}

void write_values(hid_t object, const std::filesystem::path& file, const std::string& what,
                  const std::string& name, hid_t type, hid_t space, const void* values) {
  const Handle attribute(
      check(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), file, what),
      H5Aclose);
  check(H5Awrite(attribute.id(), type, values), file, what);
}

/// Appends the name of each attribute or link that HDF5 shows.
herr_t add_attribute(hid_t, const char* name, const H5A_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

herr_t add_link(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

}  // namespace

void Hdf5File::make_group(const std::string& path) {
  const Silence silence;
  if (has(path)) return;
  const Handle link(check(H5Pcreate(H5P_LINK_CREATE), file_, path), H5Pclose);
  check(H5Pset_create_intermediate_group(link.id(), 1), file_, path);
  const Handle group(check(H5Gcreate2(id_, path.c_str(), link.id(), H5P_DEFAULT, H5P_DEFAULT),
                           file_, path + " cannot be made"),
                     H5Gclose);
}

void Hdf5File::write_attribute(const std::string& path, const std::string& name,
                               const Attribute& value) {
  const Silence silence;
  const std::string what = path + "@" + name + " cannot be written";
  const Handle object = open_object(id_, file_, path);
  const Handle scalar(check(H5Screate(H5S_SCALAR), file_, what), H5Sclose);
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    write_values(object.id(), file_, what, name, H5T_NATIVE_INT64, scalar.id(), integer);
  } else if (const auto* number = std::get_if<double>(&value)) {
    write_values(object.id(), file_, what, name, H5T_NATIVE_DOUBLE, scalar.id(), number);
  } else if (const auto* text = std::get_if<std::string>(&value)) {
    const Handle type = hdf5::text_type(text->size(), file_);
    write_values(object.id(), file_, what, name, type.id(), scalar.id(), text->c_str());
  } else {
    const auto& list = std::get<std::vector<std::int64_t>>(value);
    const hsize_t size = list.size();
    const Handle space(check(H5Screate_simple(1, &size, nullptr), file_, what), H5Sclose);
    write_values(object.id(), file_, what, name, H5T_NATIVE_INT64, space.id(), list.data());
  }
}

Attribute Hdf5File::read_attribute(const std::string& path, const std::string& name) const {
  const Silence silence;
  const std::string what = path + "@" + name + " cannot be read";
  const Handle object = open_object(id_, file_, path);
  const Handle attribute(check(H5Aopen(object.id(), name.c_str(), H5P_DEFAULT), file_, what),
                         H5Aclose);
  const Handle type(check(H5Aget_type(attribute.id()), file_, what), H5Tclose);
  const Handle space(check(H5Aget_space(attribute.id()), file_, what), H5Sclose);
  const auto count =
      static_cast<std::size_t>(check(H5Sget_simple_extent_npoints(space.id()), file_, what));
  const bool scalar = H5Sget_simple_extent_type(space.id()) == H5S_SCALAR;
  const std::string kind = hdf5::type_name(type.id());
  if (kind == "int64") {
    std::vector<std::int64_t> list(count);
    check(H5Aread(attribute.id(), type.id(), list.data()), file_, what);
    return scalar ? Attribute(list.at(0)) : Attribute(list);
  }
  if (kind == "float64" && scalar) {
    double number = 0.0;
    check(H5Aread(attribute.id(), type.id(), &number), file_, what);
    return number;
  }
  if (kind == "text" && scalar) {
    std::string text(H5Tget_size(type.id()), '\0');
    check(H5Aread(attribute.id(), type.id(), text.data()), file_, what);
    text.resize(text.find_last_not_of('\0') + 1);
    return text;
  }
  throw FileError(file_, path + "@" + name + " has a type that is not used here");
}

bool Hdf5File::has(const std::string& path) const {
  const Silence silence;
  if (path == "/") return true;
  // HDF5 wants every link on the way to exist before it answers about the next.
  for (std::size_t slash = path.find('/', 1);; slash = path.find('/', slash + 1)) {
    if (H5Lexists(id_, path.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    if (slash == std::string::npos) return true;
  }
}

bool Hdf5File::has_attribute(const std::string& path, const std::string& name) const {
  const Silence silence;
  return has(path) && H5Aexists_by_name(id_, path.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

bool Hdf5File::is_group(const std::string& path) const {
  const Silence silence;
  if (!has(path)) return false;
  const Handle object = open_object(id_, file_, path);
  return H5Iget_type(object.id()) == H5I_GROUP;
}

std::vector<std::string> Hdf5File::list(const std::string& path) const {
  // In a damaged file a link can lead back to where it came from: no walk must follow it for ever.
  constexpr std::ptrdiff_t deepest = 3;
  if (std::ranges::count(path, '/') > deepest) {
    throw FileError(file_, path + " is a group deeper than any of ours: a link leads in a circle");
  }
  const Silence silence;
  const Handle group(
      check(H5Gopen2(id_, path.c_str(), H5P_DEFAULT), file_, path + " cannot be opened as a group"),
      H5Gclose);
  std::vector<std::string> names;
  check(H5Literate(group.id(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, add_link, &names), file_,
        path + " cannot be listed");
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> Hdf5File::list_attributes(const std::string& path) const {
  const Silence silence;
  const Handle object = open_object(id_, file_, path);
  std::vector<std::string> names;
  check(H5Aiterate2(object.id(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, add_attribute, &names),
        file_, path + " has attributes that cannot be listed");
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace files
