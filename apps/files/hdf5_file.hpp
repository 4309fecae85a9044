#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "files/file_error.hpp"
#include "files/system_calls.hpp"

namespace files {

/// Extents of a dataset, slowest first (row-major), as HDF5 counts them.
using Shape = std::vector<std::size_t>;

/// An attribute's value; texts are UTF-8 of fixed length.
using Attribute = std::variant<std::int64_t, double, std::string, std::vector<std::int64_t>>;

/// What a dataset is, without its data.
struct DatasetInfo {
  Shape shape;
  std::string type;  // float64, float32, int64, int32, uint8, text
  std::string unit;  // "" if none was given
};

/// How a new file is laid out.
struct Hdf5Layout {
  int deflate = 0;  // 0: as is; 1 (fast) .. 9 (small): compressed, at the price of time
  std::uint64_t user_block = 0;  // [bytes] left to the caller at the beginning: 0, 512, 1024, ...
};

namespace hdf5 {
struct DriverReport;
}

/// One HDF5 file, plain enough for h5py and ParaView: chunked datasets with checksums, units as
/// attributes. Paths are absolute ("/state/stress"); missing groups on the way are made.
///
/// Every failure is a FileError that names file, object and HDF5's own innermost reason; HDF5
/// prints nothing. Not for use by several threads at once.
class Hdf5File {
 public:
  /// Makes a new file, replacing an old one.
  /// @param system  must outlive the file
  [[nodiscard]] static Hdf5File create(const std::filesystem::path& file,
                                       const Hdf5Layout& layout = {},
                                       const SystemCalls& system = system_calls());
  /// Opens a file for reading.
  [[nodiscard]] static Hdf5File open(const std::filesystem::path& file);
  /// The same of a copy; file() and messages name what it is a copy of.
  [[nodiscard]] static Hdf5File open_copy(const std::filesystem::path& copy,
                                          const std::filesystem::path& original);

  Hdf5File(Hdf5File&& other) noexcept;
  Hdf5File& operator=(Hdf5File&& other) noexcept;
  ~Hdf5File();

  /// Writes a dataset; T is double, float, std::int64_t, std::int32_t or std::uint8_t.
  /// @throws std::invalid_argument if `values` and `shape` disagree.
  template <class T>
  void write(const std::string& path, std::span<const T> values, const Shape& shape,
             std::string_view unit = "");
  /// Writes a text as a checksummed dataset of one string.
  void write_text(const std::string& path, std::string_view text);
  /// Makes a group, and those on the way.
  void make_group(const std::string& path);
  /// Attaches an attribute to an existing object ("/" is the file).
  void write_attribute(const std::string& path, const std::string& name, const Attribute& value);

  /// Reads a dataset whose type and shape must be exactly these.
  template <class T>
  void read(const std::string& path, std::span<T> values, const Shape& shape) const;
  /// Reads a dataset of this type and any shape.
  /// @throws FileError also if it claims more values than the file can hold.
  template <class T>
  [[nodiscard]] std::vector<T> read_all(const std::string& path) const;
  [[nodiscard]] std::string read_text(const std::string& path) const;
  [[nodiscard]] Attribute read_attribute(const std::string& path, const std::string& name) const;

  [[nodiscard]] bool has(const std::string& path) const;
  [[nodiscard]] bool has_attribute(const std::string& path, const std::string& name) const;
  [[nodiscard]] bool is_group(const std::string& path) const;
  [[nodiscard]] DatasetInfo info(const std::string& path) const;
  /// Names in a group, sorted.
  /// @throws FileError also if the group is nested deeper than any file of ours has one, so that a
  /// walk through a damaged file ends.
  [[nodiscard]] std::vector<std::string> list(const std::string& path) const;
  /// Names of an object's attributes, sorted.
  [[nodiscard]] std::vector<std::string> list_attributes(const std::string& path) const;

  /// Closes the file and says whether all was written: the destructor cannot.
  void close();

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  Hdf5File(std::filesystem::path file, int deflate);
  void require_written(const std::string& what) const;

  std::filesystem::path file_;
  std::unique_ptr<hdf5::DriverReport> report_;  // HDF5 knows it by its address
  std::int64_t id_ = -1;                        // hid_t
  int deflate_ = 0;
};

}  // namespace files
