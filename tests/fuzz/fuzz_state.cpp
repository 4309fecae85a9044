// The numbers behind a checkpoint's checksums, as a program with an error might have written them:
// the state of a sound checkpoint, edited, sealed anew, read as a resumed run reads it, and
// evaluated once. The input is a list of edits: dataset, kind, place, eight bytes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "equilibrium/equilibrium.hpp"
#include "files/file_seal.hpp"
#include "memory_file.hpp"
#include "model/build.hpp"
#include "model/checkpoint.hpp"
#include "model/state_file.hpp"
#include "scene/scene.hpp"

namespace {

using files::Hdf5File;
using Values = std::variant<std::vector<double>, std::vector<float>, std::vector<std::int64_t>,
                            std::vector<std::int32_t>, std::string>;

struct Dataset {
  std::string path;
  files::Shape shape;
  Values values;
};

Values values_of(const Hdf5File& file, const std::string& path, const std::string& type) {
  if (type == "float64") return file.read_all<double>(path);
  if (type == "float32") return file.read_all<float>(path);
  if (type == "int64") return file.read_all<std::int64_t>(path);
  if (type == "int32") return file.read_all<std::int32_t>(path);
  return file.read_text(path);
}

void add_datasets(std::vector<Dataset>& all, const Hdf5File& file, const std::string& group) {
  for (const std::string& name : file.list(group)) {
    const std::string path = group + "/" + name;
    if (file.is_group(path)) {
      add_datasets(all, file, path);
    } else {
      const auto info = file.info(path);
      all.push_back({path, info.shape, values_of(file, path, info.type)});
    }
  }
}

/// A sound checkpoint and the model it belongs to, read once.
struct Sound {
  std::vector<Dataset> notes;
  std::vector<Dataset> state;
  model::Model<2> model;
};

Sound read_sound() {
  const std::filesystem::path path = std::filesystem::path(FPM_STORED_CHECKPOINTS) / "schema-9.hdf";
  record::CheckpointNotes notes;
  const Hdf5File file = record::open_checkpoint(path, notes);
  Sound sound{{}, {}, model::build_model<2>(model::scene_of(path, notes))};
  add_datasets(sound.notes, file, "/meta");
  add_datasets(sound.notes, file, "/history");
  add_datasets(sound.state, file, "/state");
  return sound;
}

struct Edit {
  std::uint8_t dataset = 0;
  std::uint8_t kind = 0;
  std::uint16_t place = 0;
  std::array<std::uint8_t, 8> bytes{};
};
constexpr std::size_t edit_size = 12;

/// Edits one dataset: a value, its length or its type.
void apply_edit(const Edit& edit, std::vector<Dataset>& datasets) {
  Dataset& dataset = datasets[edit.dataset % datasets.size()];
  std::visit(
      [&](auto& values) {
        using T = typename std::remove_cvref_t<decltype(values)>::value_type;
        if (edit.kind % 4 == 0) {  // shorter or longer
          std::uint16_t size = 0;
          std::memcpy(&size, edit.bytes.data(), sizeof size);
          values.resize(size % 4096U);
          dataset.shape = {values.size()};
        } else if (!values.empty()) {
          std::memcpy(&values[edit.place % values.size()], edit.bytes.data(), sizeof(T));
        }
      },
      dataset.values);
  const auto* numbers = std::get_if<std::vector<std::int64_t>>(&dataset.values);
  if (edit.kind % 16 == 15 && numbers != nullptr) {
    dataset.values = std::vector<double>(numbers->begin(), numbers->end());
  }
}

void write(Hdf5File& file, const Dataset& dataset) {
  std::visit(
      [&](const auto& values) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(values)>, std::string>) {
          file.write_text(dataset.path, values);
        } else {
          using T = typename std::remove_cvref_t<decltype(values)>::value_type;
          file.write<T>(dataset.path, values, dataset.shape);
        }
      },
      dataset.values);
}

void write_file(const std::filesystem::path& path, const std::vector<Dataset>& notes,
                const std::vector<Dataset>& state) {
  auto file = Hdf5File::create(path, {.user_block = files::seal_size});
  for (const Dataset& dataset : notes) write(file, dataset);
  for (const Dataset& dataset : state) write(file, dataset);
  files::ContentDigest digest;
  for (const char* group : {"/meta", "/history", "/state"}) files::add_group(digest, file, group);
  record::write_digest(file, digest);
  file.close();
  files::write_seal(path, record::checkpoint_schema, "fuzzer");
}

void evaluate(const model::Model<2>& model, model::State<2>& state) {
  equilibrium::Equilibrium<2> equilibrium(model, state);
  equilibrium.rebuild_operator();
  equilibrium.begin_step(state.programme.load);
  const Eigen::VectorXd increment = Eigen::VectorXd::Zero(2 * model.size());
  Eigen::VectorXd residual = increment;
  (void)equilibrium(increment, residual);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Sound sound = read_sound();
  std::vector<Dataset> state = sound.state;
  for (std::size_t at = 0; at + edit_size <= size; at += edit_size) {
    Edit edit;
    edit.dataset = data[at];
    edit.kind = data[at + 1];
    std::memcpy(&edit.place, data + at + 2, sizeof edit.place);
    std::memcpy(edit.bytes.data(), data + at + 4, sizeof edit.bytes);
    apply_edit(edit, state);
  }
  const fuzz::MemoryFile memory;
  write_file(memory.path(), sound.notes, state);
  try {
    record::CheckpointNotes notes;
    const Hdf5File file = record::open_checkpoint(memory.path(), notes);
    auto read = model::read_state(file, sound.model, notes.schema);
    evaluate(sound.model, read);
  } catch (const files::FileError&) {
    // refused with its reason
  }
  return 0;
}
