#include "info/describe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "bounds/limit_bracket.hpp"
#include "files/hdf5_file.hpp"
#include "files/unsealed_file.hpp"
#include "files/vtkhdf.hpp"
#include "info/describe_checkpoint.hpp"
#include "record/curve_file.hpp"
#include "record/run_lock.hpp"

namespace info {

namespace {

using files::FileError;
using files::Hdf5File;

std::string attribute_text(const files::Attribute& value) {
  if (const auto* list = std::get_if<std::vector<std::int64_t>>(&value)) {
    return fmt::format("{}", fmt::join(*list, ", "));
  }
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  return fmt::format("{}", std::get<std::int64_t>(value));
}

std::string first_line(const std::string& text) {
  const std::size_t end = text.find('\n');
  if (end == std::string::npos) return text;
  const auto lines = std::count(text.begin(), text.end(), '\n');
  return fmt::format("{} ... ({} lines)", text.substr(0, end), lines);
}

void describe_attributes(std::string& out, const Hdf5File& file, const std::string& path,
                         const std::string& indent) {
  for (const std::string& name : file.list_attributes(path)) {
    if (name == "unit") continue;  // shown beside its dataset
    std::string value;
    try {
      value = attribute_text(file.read_attribute(path, name));
    } catch (const FileError& failure) {
      value = failure.reason();
    }
    fmt::format_to(std::back_inserter(out), "{}@{} = {}\n", indent, name, value);
  }
}

void describe_group(std::string& out, const Hdf5File& file, const std::string& path, int depth) {
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  describe_attributes(out, file, path, indent);
  for (const std::string& name : file.list(path)) {
    const std::string child = (path == "/" ? "" : path) + "/" + name;
    if (file.is_group(child)) {
      fmt::format_to(std::back_inserter(out), "{}{}/\n", indent, name);
      describe_group(out, file, child, depth + 1);
      continue;
    }
    const files::DatasetInfo info = file.info(child);
    const std::string shape = fmt::format("{}", fmt::join(info.shape, " x "));
    const std::string unit = info.unit.empty() ? "" : fmt::format(" [{}]", info.unit);
    fmt::format_to(std::back_inserter(out), "{}{}: {} {}{}\n", indent, name, info.type, shape,
                   unit);
    if (info.type == "text") {
      fmt::format_to(std::back_inserter(out), "{}  {}\n", indent,
                     first_line(file.read_text(child)));
    }
    describe_attributes(out, file, child, indent + "  ");
  }
}

std::vector<std::filesystem::path> hdf_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".hdf") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string curve_summary(const std::filesystem::path& curve) {
  try {
    const auto rows = record::read_curve(curve);
    if (rows.empty()) return "no step yet";
    const record::CurveRow& last = rows.back();
    return fmt::format(
        "{} rows, last step {}: load {:.6g}, settlement {:.6g} m, d/B {:.4f}, mean "
        "pressure {:.6g} Pa, {} plastic particles",
        rows.size(), last.step, last.load_parameter, last.settlement, last.settlement_over_B,
        last.mean_pressure, last.plastic_particles);
  } catch (const FileError& failure) {
    return failure.reason();
  }
}

std::string bracket_summary(const std::filesystem::path& bracket) {
  try {
    return "collapse load " + bounds::bracket_line(bounds::read_limit_bracket(bracket));
  } catch (const FileError& failure) {
    return failure.reason();
  }
}

std::string lock_summary(const std::filesystem::path& folder) {
  const record::LockOwner owner = record::lock_owner(folder);
  if (owner.alive) return "running: " + owner.name;
  return owner.name.empty() ? "not running" : "killed, or its machine went down: " + owner.name;
}

std::string checkpoint_summary(const std::filesystem::path& checkpoint) {
  try {
    record::CheckpointNotes notes;
    (void)record::open_checkpoint(checkpoint, notes);
    return checkpoint_line(notes);
  } catch (const FileError& failure) {
    return "UNUSABLE: " + failure.reason();
  }
}

}  // namespace

std::string describe_file(const std::filesystem::path& path) {
  record::CheckpointNotes notes;
  const bool checkpoint = record::is_checkpoint(path);
  const Hdf5File file =
      checkpoint ? record::open_checkpoint(path, notes) : files::open_unsealed(path);
  std::string out = fmt::format("{} ({} bytes)\n", path.string(), std::filesystem::file_size(path));
  if (checkpoint) out += describe_checkpoint(notes) + "  contents\n";
  describe_group(out, file, "/", checkpoint ? 2 : 1);
  return out;
}

std::string scene_in(const std::filesystem::path& checkpoint) {
  record::CheckpointNotes notes;
  (void)record::open_checkpoint(checkpoint, notes);
  return notes.scene;
}

std::string describe_folder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::directory_iterator probe(folder, failure);
  if (failure) throw FileError(folder, "cannot be read: " + failure.message());
  std::string out = folder.string() + "\n";
  const auto line = [&out](std::string_view name, const std::string& value) {
    fmt::format_to(std::back_inserter(out), "  {:<12} {}\n", name, value);
  };
  line("run", lock_summary(folder));
  const auto curve = folder / "curve.csv";
  line("curve", std::filesystem::exists(curve) ? curve_summary(curve) : "none");
  const auto bracket = folder / "limit" / "bracket.json";
  if (std::filesystem::exists(bracket)) line("limit", bracket_summary(bracket));
  const auto frames = hdf_files(folder / "frames");
  line("frames", frames.empty() ? "none"
                                : fmt::format("{}, last {}", frames.size(),
                                              frames.back().filename().string()));
  const auto checkpoints = hdf_files(folder / "checkpoints");
  if (checkpoints.empty()) line("checkpoints", "none");
  for (const auto& checkpoint : checkpoints) {
    line("checkpoint", checkpoint.filename().string() + ": " + checkpoint_summary(checkpoint));
  }
  return out;
}

}  // namespace info
