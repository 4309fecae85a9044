#include "files/vtkhdf.hpp"

#include <fmt/format.h>

#include <charconv>
#include <iterator>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "files/durable_file.hpp"

namespace files {

namespace {

constexpr std::uint8_t vertex_cell = 1;  // VTK_VERTEX

// One entry per line, so that the list reads back without a JSON library.
constexpr std::string_view series_head = "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n";
constexpr std::string_view series_tail = "  ]\n}\n";
constexpr std::string_view name_opens = "    { \"name\": \"";
constexpr std::string_view time_opens = "\", \"time\": ";
constexpr std::string_view entry_closes = " }";

/// `{ "name": "...", "time": ... }` with or without a comma; nothing if it is no such line.
std::optional<FrameSeries::Entry> parse_entry(std::string_view line) {
  if (!line.empty() && line.back() == ',') line.remove_suffix(1);
  const std::size_t time = line.find(time_opens);
  if (!line.starts_with(name_opens) || !line.ends_with(entry_closes) ||
      time == std::string_view::npos) {
    return std::nullopt;
  }
  FrameSeries::Entry entry;
  entry.name = line.substr(name_opens.size(), time - name_opens.size());
  const std::string_view number = line.substr(
      time + time_opens.size(), line.size() - time - time_opens.size() - entry_closes.size());
  const char* end = number.data() + number.size();
  const auto [stop, failure] = std::from_chars(number.data(), end, entry.time);
  if (failure != std::errc{} || stop != end) return std::nullopt;
  return entry;
}

}  // namespace

void write_vtkhdf(Hdf5File& file, std::span<const double> points,
                  std::span<const PointField> fields) {
  const std::size_t n = points.size() / 3;
  if (points.size() % 3 != 0) {
    throw std::invalid_argument(
        fmt::format("VTKHDF points: {} coordinates are not 3 per particle", points.size()));
  }
  file.make_group("/VTKHDF");
  // ParaView wants Type as a fixed-length text.
  file.write_attribute("/VTKHDF", "Type", std::string("UnstructuredGrid"));
  file.write_attribute("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});

  const std::vector<std::int64_t> count{static_cast<std::int64_t>(n)};
  for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"}) {
    file.write<std::int64_t>(std::string("/VTKHDF/") + name, count, {1});
  }
  std::vector<std::int64_t> numbers(n + 1);
  std::iota(numbers.begin(), numbers.end(), std::int64_t{0});
  file.write<std::int64_t>("/VTKHDF/Offsets", numbers, {n + 1});
  file.write<std::int64_t>("/VTKHDF/Connectivity", std::span(numbers).first(n), {n});
  file.write<std::uint8_t>("/VTKHDF/Types", std::vector<std::uint8_t>(n, vertex_cell), {n});
  file.write<double>("/VTKHDF/Points", points, {n, 3}, "m");

  file.make_group("/VTKHDF/PointData");
  for (const PointField& field : fields) {
    const auto components = static_cast<std::size_t>(field.components);
    if (field.values.size() != n * components) {
      throw std::invalid_argument(fmt::format("VTKHDF field {}: {} values for {} particles of {}",
                                              field.name, field.values.size(), n, components));
    }
    const Shape shape = components == 1 ? Shape{n} : Shape{n, components};
    file.write<double>("/VTKHDF/PointData/" + field.name, field.values, shape, field.unit);
  }
}

void write_frame(const std::filesystem::path& path, std::int64_t step, double time,
                 std::span<const double> points, std::span<const PointField> fields, int deflate,
                 const SystemCalls& system) {
  const auto fill = [&](const std::filesystem::path& temporary) {
    Hdf5File file = Hdf5File::create(temporary, {.deflate = deflate}, system);
    file.write_attribute("/", "step", step);
    file.write_attribute("/", "time", time);
    write_vtkhdf(file, points, fields);
    file.close();
  };
  write_durably(path, fill, system);
}

FrameSeries FrameSeries::resume(std::filesystem::path file, double time,
                                const SystemCalls& system) {
  FrameSeries series(std::move(file), system);
  if (!std::filesystem::exists(series.file_)) return series;
  const std::string text = read_text(series.file_);
  if (!text.starts_with(series_head) || !text.ends_with(series_tail)) {
    throw FileError(series.file_, "is no frame list of this program");
  }
  for (std::size_t at = series_head.size(); at < text.size() - series_tail.size();) {
    const std::size_t end = text.find('\n', at);
    const auto entry = parse_entry(std::string_view(text).substr(at, end - at));
    if (!entry)
      throw FileError(series.file_, "has a line that names no frame: " + text.substr(at, end - at));
    if (entry->time <= time) series.entries_.push_back(*entry);
    at = end + 1;
  }
  series.write();
  return series;
}

void FrameSeries::append(std::string name, double time) {
  entries_.push_back({std::move(name), time});
  write();
}

void FrameSeries::write() const {
  std::string text(series_head);
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{}{}{}{}{}{}\n", name_opens, entries_[i].name,
                   time_opens, entries_[i].time, entry_closes, i + 1 < entries_.size() ? "," : "");
  }
  text += series_tail;
  write_text_durably(file_, text, *system_);
}

}  // namespace files
