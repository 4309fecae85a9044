#include "files/content_digest.hpp"

#include <algorithm>
#include <cstring>

namespace files {

namespace {

constexpr std::uint64_t golden_ratio = 0x9e3779b97f4a7c15U;

// One to one in `hash` for a given word and in `word` for a given hash.
std::uint64_t mixed(std::uint64_t hash, std::uint64_t word) {
  hash = (hash ^ word) * golden_ratio;
  return hash ^ (hash >> 32U);
}

template <class T>
void add_values(ContentDigest& digest, const Hdf5File& file, const std::string& path) {
  const std::vector<T> values = file.read_all<T>(path);
  digest.add(path, std::as_bytes(std::span(values)));
}

void add_dataset(ContentDigest& digest, const Hdf5File& file, const std::string& path) {
  const DatasetInfo info = file.info(path);
  if (info.type == "float64") {
    add_values<double>(digest, file, path);
  } else if (info.type == "float32") {
    add_values<float>(digest, file, path);
  } else if (info.type == "int64") {
    add_values<std::int64_t>(digest, file, path);
  } else if (info.type == "int32") {
    add_values<std::int32_t>(digest, file, path);
  } else if (info.type == "text") {
    const std::string text = file.read_text(path);
    digest.add(path, std::as_bytes(std::span(text)));
  } else {
    throw FileError(file.file(), path + " holds " + info.type + ", which is not used here");
  }
}

}  // namespace

std::uint64_t hash_of(std::span<const std::byte> content, std::uint64_t seed) {
  std::uint64_t hash = seed;
  while (!content.empty()) {
    std::uint64_t word = 0;
    const std::size_t size = std::min(content.size(), sizeof word);
    std::memcpy(&word, content.data(), size);
    hash = mixed(hash, word);
    content = content.subspan(size);
  }
  return hash;
}

void ContentDigest::add(std::string_view path, std::span<const std::byte> content) {
  const std::uint64_t name = hash_of(std::as_bytes(std::span(path)), path.size());
  sum_ += hash_of(content, mixed(name, content.size()));
}

void add_group(ContentDigest& digest, const Hdf5File& file, const std::string& group) {
  for (const std::string& name : file.list(group)) {
    const std::string path = group + "/" + name;
    if (file.is_group(path)) {
      add_group(digest, file, path);
    } else {
      add_dataset(digest, file, path);
    }
  }
}

}  // namespace files
