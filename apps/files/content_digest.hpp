#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "files/hdf5_file.hpp"

namespace files {

/// A 64-bit hash that changes with any single 8-byte word; no cryptographic one.
/// @param seed  the hash of what came before, a multiple of 8 bytes
[[nodiscard]] std::uint64_t hash_of(std::span<const std::byte> content, std::uint64_t seed);

/// A 64-bit digest of datasets, whatever their order. It tells damage from soundness beyond the
/// checksums of single chunks (a dataset missing or exchanged); it is no cryptographic hash.
class ContentDigest {
 public:
  /// Takes in one dataset: any change of a single 8-byte word changes the digest.
  void add(std::string_view path, std::span<const std::byte> content);
  [[nodiscard]] std::int64_t value() const { return static_cast<std::int64_t>(sum_); }

 private:
  std::uint64_t sum_ = 0;
};

/// The digest of all datasets below a group. Reads each of them, so that every checksum is tested.
/// @throws FileError naming the dataset that is damaged or of a type that is not used here.
void add_group(ContentDigest& digest, const Hdf5File& file, const std::string& group);

}  // namespace files
