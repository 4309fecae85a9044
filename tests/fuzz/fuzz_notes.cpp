// What stands behind a checkpoint's checksums: its texts (scene, archive, lineage, curve), as a
// program with an error might have written them. The input is these texts, each ended by a zero.
#include <algorithm>
#include <span>
#include <string>

#include "memory_file.hpp"
#include "wiring/checkpoint.hpp"
#include "wiring/file_seal.hpp"

namespace {

std::string next_text(std::span<const char>& rest) {
  std::size_t size = 0;
  while (size < rest.size() && rest[size] != '\0') ++size;
  std::string text(rest.data(), size);
  rest = rest.subspan(std::min(size + 1, rest.size()));
  return text;
}

void write_file(const std::filesystem::path& path, std::span<const char> rest) {
  auto file = wiring::Hdf5File::create(path, {.user_block = wiring::seal_size});
  const auto put_number = [&](const char* name, std::int64_t number) {
    file.write<std::int64_t>(name, std::span(&number, 1), {1});
  };
  put_number("/meta/schema", wiring::checkpoint_schema);
  put_number("/meta/dimension", 2);
  put_number("/state/programme/step", 6);
  for (const char* name : {"/meta/scene", "/meta/materials", "/meta/lineage", "/history/curve"}) {
    file.write_text(name, next_text(rest));
  }
  for (const char* name : {"/meta/title", "/meta/versions", "/meta/created", "/meta/reason"}) {
    file.write_text(name, "");
  }
  wiring::ContentDigest digest;
  for (const char* group : {"/meta", "/history", "/state"}) wiring::add_group(digest, file, group);
  wiring::write_digest(file, digest);
  file.close();
  wiring::write_seal(path, wiring::checkpoint_schema, "fuzzer");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::MemoryFile memory;
  write_file(memory.path(), {reinterpret_cast<const char*>(data), size});
  try {
    wiring::CheckpointNotes notes;
    (void)wiring::open_checkpoint(memory.path(), notes);
    (void)wiring::scene_of(memory.path(), notes);
  } catch (const wiring::FileError&) {
    // refused with its reason
  }
  return 0;
}
