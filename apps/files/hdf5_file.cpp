#include "files/hdf5_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "files/hdf5_driver.hpp"
#include "files/hdf5_handle.hpp"

namespace files {

namespace {

using hdf5::check;
using hdf5::Handle;
using hdf5::Silence;

// Values per chunk: large enough that overhead is nothing, small enough for HDF5's 1 MiB cache.
constexpr std::size_t chunk_values = std::size_t{1} << 16;

std::size_t product(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

std::string text_of(const Shape& shape) {
  return fmt::format("{}", fmt::join(shape, " x "));
}

/// Whole rows, as many as fit into one chunk; no extent may be 0.
std::vector<hsize_t> chunk_of(const Shape& shape) {
  std::vector<hsize_t> chunk(shape.begin(), shape.end());
  for (auto& extent : chunk) extent = std::max<hsize_t>(extent, 1);
  hsize_t row = 1;
  for (std::size_t i = 1; i < chunk.size(); ++i) row *= chunk[i];
  chunk[0] = std::min(chunk[0], std::max<hsize_t>(chunk_values / row, 1));
  return chunk;
}

/// Creates a checksummed dataset, with the groups above it.
Handle create_dataset(hid_t file_id, const std::filesystem::path& file, const std::string& path,
                      hid_t type, const Shape& shape, int deflate) {
  const std::vector<hsize_t> extents(shape.begin(), shape.end());
  const auto rank = static_cast<int>(shape.size());
  const auto chunk = chunk_of(shape);
  const Handle space(check(H5Screate_simple(rank, extents.data(), nullptr), file, path), H5Sclose);
  const Handle creation(check(H5Pcreate(H5P_DATASET_CREATE), file, path), H5Pclose);
  check(H5Pset_chunk(creation.id(), rank, chunk.data()), file, path);
  if (deflate > 0) {
    check(H5Pset_shuffle(creation.id()), file, path);
    check(H5Pset_deflate(creation.id(), static_cast<unsigned>(deflate)), file, path);
  }
  check(H5Pset_fletcher32(creation.id()), file, path);
  const Handle link(check(H5Pcreate(H5P_LINK_CREATE), file, path), H5Pclose);
  check(H5Pset_create_intermediate_group(link.id(), 1), file, path);
  return {check(H5Dcreate2(file_id, path.c_str(), type, space.id(), link.id(), creation.id(),
                           H5P_DEFAULT),
                file, path + " cannot be created"),
          H5Dclose};
}

Handle open_dataset(hid_t file_id, const std::filesystem::path& file, const std::string& path) {
  return {check(H5Dopen2(file_id, path.c_str(), H5P_DEFAULT), file, path + " cannot be opened"),
          H5Dclose};
}

Shape shape_of(hid_t dataset, const std::filesystem::path& file, const std::string& path) {
  const Handle space(check(H5Dget_space(dataset), file, path), H5Sclose);
  const int rank = check(H5Sget_simple_extent_ndims(space.id()), file, path);
  std::vector<hsize_t> extents(static_cast<std::size_t>(rank));
  check(H5Sget_simple_extent_dims(space.id(), extents.data(), nullptr), file, path);
  return {extents.begin(), extents.end()};
}

std::string type_of(hid_t dataset, const std::filesystem::path& file, const std::string& path) {
  const Handle type(check(H5Dget_type(dataset), file, path), H5Tclose);
  return hdf5::type_name(type.id());
}

template <class T>
void require_type(hid_t dataset, const std::filesystem::path& file, const std::string& path) {
  const std::string found = type_of(dataset, file, path);
  const std::string wanted = hdf5::type_name(hdf5::native_type<T>());
  if (found != wanted) {
    throw FileError(file, fmt::format("{} holds {}, not {}", path, found, wanted));
  }
}

// A damaged extent must not make a reader ask for more memory than there is.
void require_plausible(const Shape& shape, hid_t file_id, const std::filesystem::path& file,
                       const std::string& path) {
  constexpr double most_values_per_byte = 1032.0;  // the limit of deflate, one byte each
  hsize_t bytes = 0;
  check(H5Fget_filesize(file_id, &bytes), file, path);
  const double values =
      std::accumulate(shape.begin(), shape.end(), 1.0,
                      [](double product, std::size_t extent) { return product * double(extent); });
  if (values > most_values_per_byte * static_cast<double>(bytes)) {
    throw FileError(file, path + " claims more values than the file holds");
  }
}

template <class T>
void read_values(hid_t dataset, const std::filesystem::path& file, const std::string& path,
                 std::span<T> values) {
  if (values.empty()) return;
  check(H5Dread(dataset, hdf5::native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
        file, path + " cannot be read");
}

}  // namespace

Hdf5File::Hdf5File(std::filesystem::path file, int deflate)
    : file_(std::move(file)), report_(std::make_unique<hdf5::DriverReport>()), deflate_(deflate) {}

Hdf5File Hdf5File::create(const std::filesystem::path& file, const Hdf5Layout& layout,
                          const SystemCalls& system) {
  const Silence silence;
  const std::string what = "cannot be created";
  Hdf5File made(file, layout.deflate);
  const Handle creation(check(H5Pcreate(H5P_FILE_CREATE), file, what), H5Pclose);
  check(H5Pset_userblock(creation.id(), layout.user_block), file, what);
  const Handle access(check(H5Pcreate(H5P_FILE_ACCESS), file, what), H5Pclose);
  check(hdf5::use_driver(access.id(), system, *made.report_), file, what);
  made.id_ = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation.id(), access.id());
  if (made.report_->not_opened != 0) throw system_error(file, what, made.report_->not_opened);
  check(made.id_, file, what);
  return made;
}

Hdf5File Hdf5File::open_copy(const std::filesystem::path& copy,
                             const std::filesystem::path& original) {
  Hdf5File opened = open(copy);
  opened.file_ = original;
  return opened;
}

Hdf5File Hdf5File::open(const std::filesystem::path& file) {
  const Silence silence;
  std::error_code failure;
  if (!std::filesystem::exists(file, failure)) throw FileError(file, "there is no such file");
  Hdf5File opened(file, 0);
  const Handle access(check(H5Pcreate(H5P_FILE_ACCESS), file, "cannot be opened"), H5Pclose);
  check(hdf5::use_driver(access.id(), system_calls(), *opened.report_), file, "cannot be opened");
  opened.id_ = H5Fopen(file.c_str(), H5F_ACC_RDONLY, access.id());
  if (opened.report_->not_opened != 0) {
    throw system_error(file, "cannot be opened", opened.report_->not_opened);
  }
  check(opened.id_, file, "is no whole HDF5 file");
  return opened;
}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : file_(std::move(other.file_)),
      report_(std::move(other.report_)),
      id_(std::exchange(other.id_, -1)),
      deflate_(other.deflate_) {}

Hdf5File& Hdf5File::operator=(Hdf5File&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(report_, other.report_);
  std::swap(id_, other.id_);
  std::swap(deflate_, other.deflate_);
  return *this;
}

Hdf5File::~Hdf5File() {
  if (id_ < 0) return;
  const Silence silence;
  H5Fclose(id_);
}

void Hdf5File::require_written(const std::string& what) const {
  if (report_->failure != 0) throw system_error(file_, what, report_->failure);
}

void Hdf5File::close() {
  const Silence silence;
  if (id_ < 0) return;
  const bool closed = H5Fclose(std::exchange(id_, -1)) >= 0;
  require_written("cannot be written");
  check(closed ? 0 : -1, file_, "cannot be closed");
}

template <class T>
void Hdf5File::write(const std::string& path, std::span<const T> values, const Shape& shape,
                     std::string_view unit) {
  if (shape.empty() || product(shape) != values.size()) {
    throw std::invalid_argument(
        fmt::format("{}: {} values for the shape {}", path, values.size(), text_of(shape)));
  }
  const Silence silence;
  {
    const Handle dataset =
        create_dataset(id_, file_, path, hdf5::native_type<T>(), shape, deflate_);
    if (!values.empty()) {
      check(H5Dwrite(dataset.id(), hdf5::native_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT,
                     values.data()),
            file_, path + " cannot be written");
    }
  }
  require_written("cannot be written");
  if (!unit.empty()) write_attribute(path, "unit", std::string(unit));
}

template <class T>
void Hdf5File::read(const std::string& path, std::span<T> values, const Shape& shape) const {
  const Silence silence;
  const Handle dataset = open_dataset(id_, file_, path);
  require_type<T>(dataset.id(), file_, path);
  const Shape found = shape_of(dataset.id(), file_, path);
  if (found != shape || product(shape) != values.size()) {
    throw FileError(
        file_, fmt::format("{} has the shape {}, not {}", path, text_of(found), text_of(shape)));
  }
  read_values(dataset.id(), file_, path, values);
}

template <class T>
std::vector<T> Hdf5File::read_all(const std::string& path) const {
  const Silence silence;
  const Handle dataset = open_dataset(id_, file_, path);
  require_type<T>(dataset.id(), file_, path);
  const Shape shape = shape_of(dataset.id(), file_, path);
  require_plausible(shape, id_, file_, path);
  std::vector<T> values(product(shape));
  read_values<T>(dataset.id(), file_, path, values);
  return values;
}

void Hdf5File::write_text(const std::string& path, std::string_view text) {
  const Silence silence;
  const Handle type = hdf5::text_type(text.size(), file_);
  const Handle dataset = create_dataset(id_, file_, path, type.id(), {1}, deflate_);
  const std::string padded(text.empty() ? std::string_view("\0", 1) : text);
  check(H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data()), file_,
        path + " cannot be written");
}

std::string Hdf5File::read_text(const std::string& path) const {
  const Silence silence;
  const Handle dataset = open_dataset(id_, file_, path);
  const Handle type(check(H5Dget_type(dataset.id()), file_, path), H5Tclose);
  const bool one = shape_of(dataset.id(), file_, path) == Shape{1};
  if (!one || hdf5::type_name(type.id()) != "text") throw FileError(file_, path + " is no text");
  std::string text(H5Tget_size(type.id()), '\0');
  check(H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), file_,
        path + " cannot be read");
  text.resize(text.find_last_not_of('\0') + 1);
  return text;
}

DatasetInfo Hdf5File::info(const std::string& path) const {
  const Silence silence;
  DatasetInfo info;
  const Handle dataset = open_dataset(id_, file_, path);
  info.shape = shape_of(dataset.id(), file_, path);
  info.type = type_of(dataset.id(), file_, path);
  if (has_attribute(path, "unit")) {
    const Attribute unit = read_attribute(path, "unit");
    if (const auto* text = std::get_if<std::string>(&unit)) info.unit = *text;
  }
  return info;
}

#define WIRING_INSTANTIATE(T)                                                            \
  template void Hdf5File::write<T>(const std::string&, std::span<const T>, const Shape&, \
                                   std::string_view);                                    \
  template void Hdf5File::read<T>(const std::string&, std::span<T>, const Shape&) const; \
  template std::vector<T> Hdf5File::read_all<T>(const std::string&) const;
WIRING_INSTANTIATE(double)
WIRING_INSTANTIATE(float)
WIRING_INSTANTIATE(std::int64_t)
WIRING_INSTANTIATE(std::int32_t)
WIRING_INSTANTIATE(std::uint8_t)
#undef WIRING_INSTANTIATE

}  // namespace files
