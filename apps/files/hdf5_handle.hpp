#pragma once

// Private to the HDF5 layer: handles that close themselves, and HDF5's errors as exceptions.

#include <hdf5.h>

#include <string>
#include <type_traits>
#include <utility>

#include "files/file_error.hpp"

namespace files::hdf5 {

/// While it lives, HDF5 does not print its error stack.
class Silence {
 public:
  Silence() {
    H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// Turns HDF5's error stack into a FileError about `what` in `file`.
[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what);

/// Passes on a result that is not negative, fails otherwise.
template <class Result>
Result check(Result result, const std::filesystem::path& file, const std::string& what) {
  if (result < 0) fail(file, what);
  return result;
}

/// An HDF5 object that closes itself.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  [[nodiscard]] hid_t id() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

/// The type of T in memory and in the file (whose byte order is that of the machine).
template <class T>
hid_t native_type() {
  if constexpr (std::is_same_v<T, double>)
    return H5T_NATIVE_DOUBLE;
  else if constexpr (std::is_same_v<T, float>)
    return H5T_NATIVE_FLOAT;
  else if constexpr (std::is_same_v<T, std::int64_t>)
    return H5T_NATIVE_INT64;
  else if constexpr (std::is_same_v<T, std::int32_t>)
    return H5T_NATIVE_INT32;
  else
    return H5T_NATIVE_UINT8;
}

/// A fixed-length, null-padded UTF-8 string type; HDF5 has no strings of length 0.
[[nodiscard]] Handle text_type(std::size_t length, const std::filesystem::path& file);

/// Name of a stored type: float64, int32, text ...; "other" if it is none of ours.
[[nodiscard]] std::string type_name(hid_t type);

}  // namespace files::hdf5
