// What stands behind a checkpoint's checksums: its texts (scene, archive, lineage, curve), as a
// program with an error might have written them. The input is these texts, each ended by a zero.
#include <algorithm>
#include <span>
#include <string>

#include "files/file_seal.hpp"
#include "memory_file.hpp"
#include "model/checkpoint.hpp"
#include "scene/scene.hpp"

namespace {

std::string next_text(std::span<const char>& rest) {
  std::size_t size = 0;
  while (size < rest.size() && rest[size] != '\0') ++size;
  std::string text(rest.data(), size);
  rest = rest.subspan(std::min(size + 1, rest.size()));
  return text;
}

void write_file(const std::filesystem::path& path, std::span<const char> rest) {
  auto file = files::Hdf5File::create(path, {.user_block = files::seal_size});
  const auto put_number = [&](const char* name, std::int64_t number) {
    file.write<std::int64_t>(name, std::span(&number, 1), {1});
  };
  put_number("/meta/schema", record::checkpoint_schema);
  put_number("/meta/dimension", 2);
  put_number("/state/programme/step", 6);
  put_number("/state/programme/stage", 0);
  const double progress = 0.6;
  file.write<double>("/state/programme/progress", std::span(&progress, 1), {1});
  for (const char* name : {"/meta/scene", "/meta/materials", "/meta/lineage", "/history/curve"}) {
    file.write_text(name, next_text(rest));
  }
  for (const char* name : {"/meta/title", "/meta/versions", "/meta/created", "/meta/reason"}) {
    file.write_text(name, "");
  }
  files::ContentDigest digest;
  for (const char* group : {"/meta", "/history", "/state"}) files::add_group(digest, file, group);
  record::write_digest(file, digest);
  file.close();
  files::write_seal(path, record::checkpoint_schema, "fuzzer");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::MemoryFile memory;
  write_file(memory.path(), {reinterpret_cast<const char*>(data), size});
  try {
    record::CheckpointNotes notes;
    (void)record::open_checkpoint(memory.path(), notes);
    (void)model::scene_of(memory.path(), notes);
  } catch (const files::FileError&) {
    // refused with its reason
  }
  return 0;
}
