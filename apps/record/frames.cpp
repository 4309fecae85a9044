#include "record/frames.hpp"

#include <fmt/format.h>

#include "files/durable_file.hpp"

namespace record {

namespace {

// Frames beyond the step a run goes on from: it writes its own. By their names, for a killed run
// may have written a frame that its series does not list.
void remove_later(const std::filesystem::path& folder, std::int64_t step) {
  const std::string last = Frames::name(step);
  std::vector<std::filesystem::path> later;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    const bool frame = name.starts_with("frame-") && name.ends_with(".hdf");
    // Longer numbers are larger ones.
    const bool beyond = name.size() != last.size() ? name.size() > last.size() : name > last;
    if (frame && beyond) later.push_back(entry.path());
  }
  for (const auto& file : later) std::filesystem::remove(file, ignored);
}

}  // namespace

void write_frame(const std::filesystem::path& path, std::int64_t step, double time,
                 std::span<const double> points, std::span<const files::PointField> fields,
                 int deflate, const files::SystemCalls& system) {
  const auto fill = [&](const std::filesystem::path& temporary) {
    files::Hdf5File file = files::Hdf5File::create(temporary, {.deflate = deflate}, system);
    file.write_attribute("/", "step", step);
    file.write_attribute("/", "time", time);
    files::write_vtkhdf(file, points, fields);
    file.close();
  };
  files::write_durably(path, fill, system);
}

Frames::Frames(const RunFolder& folder, int every, int deflate, std::int64_t step,
               std::optional<double> last_time)
    : folder_(folder.frames()),
      system_(folder.system()),
      every_(every),
      deflate_(deflate),
      series_(last_time ? FrameSeries::resume(folder.series(), *last_time, system_)
                        : FrameSeries(folder.series(), system_)) {
  if (every_ > 0) files::create_folder(folder_, system_);
  if (last_time) remove_later(folder_, step);
}

std::string Frames::name(std::int64_t step) {
  return fmt::format("frame-{:06}.hdf", step);
}

bool Frames::due(std::int64_t step) const {
  return every_ > 0 && step % every_ == 0 && lacks(step);
}

bool Frames::lacks(std::int64_t step) const {
  const auto& entries = series_.entries();
  return every_ > 0 && (entries.empty() || entries.back().name != "frames/" + name(step));
}

void Frames::write(std::int64_t step, double time, std::span<const double> points,
                   std::span<const files::PointField> fields) {
  write_frame(folder_ / name(step), step, time, points, fields, deflate_, system_);
  series_.append("frames/" + name(step), time);
}

}  // namespace record
