#include "compare/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "files/hdf5_file.hpp"
#include "files/unsealed_file.hpp"
#include "record/checkpoint_file.hpp"
#include "record/checkpoint_folder.hpp"
#include "record/curve_file.hpp"

namespace comparison {

using files::FileError;
using files::Hdf5File;
using record::CurveRow;

namespace {

const std::string curve_group = "curve/";
constexpr int plane = 2;  // whose names of columns stand for those in 3D, too
const std::string points_path = "/VTKHDF/Points";

/// Where each field of a source is: its column of the curve, or its dataset.
struct Origins {
  std::shared_ptr<const Hdf5File> file;
  std::map<std::string, std::string> datasets;  // by name
  std::vector<CurveRow> rows;
  std::vector<std::string> measures;  // of the rows
};

Quantity dataset_of(const Hdf5File& file, const std::string& path) {
  const files::DatasetInfo info = file.info(path);
  Quantity quantity{info.unit, info.shape, {}};
  if (info.type == "float64") {
    quantity.values = file.read_all<double>(path);
  } else if (info.type == "float32") {
    const auto narrow = file.read_all<float>(path);
    quantity.values = std::vector<double>(narrow.begin(), narrow.end());
  } else if (info.type == "int64") {
    quantity.values = file.read_all<std::int64_t>(path);
  } else if (info.type == "int32") {
    const auto narrow = file.read_all<std::int32_t>(path);
    quantity.values = std::vector<std::int64_t>(narrow.begin(), narrow.end());
  } else {
    throw FileError(file.file(), path + " holds " + info.type + ", which cannot be compared");
  }
  return quantity;
}

Quantity column_of(const Origins& origins, const std::string& name) {
  const std::vector<CurveRow>& rows = origins.rows;
  const auto measure = std::ranges::find(origins.measures, name);
  if (measure != origins.measures.end()) {
    const auto at = static_cast<std::size_t>(measure - origins.measures.begin());
    std::vector<double> values;
    for (const CurveRow& row : rows) values.push_back(row.measures[at]);
    return {"", {rows.size()}, std::move(values)};
  }
  Quantity quantity{"", {rows.size()}, {}};
  for (const CurveRow& row : rows) {
    CurveRow::for_each_column(row, [&](std::string_view column, const auto& value, auto&&...) {
      if (column != name) return;
      using Values = std::vector<std::remove_cvref_t<decltype(value)>>;
      if (quantity.values.index() != decltype(quantity.values)(Values()).index()) {
        quantity.values = Values();
      }
      std::get<Values>(quantity.values).push_back(value);
    });
  }
  return quantity;
}

void add_datasets(Origins& origins, const std::string& group, const std::string& prefix) {
  for (const std::string& name : origins.file->list(group)) {
    const std::string path = group + "/" + name;
    if (origins.file->is_group(path)) {
      add_datasets(origins, path, prefix + name + "/");
    } else {
      origins.datasets[prefix + name] = path;
    }
  }
}

// The wall time is another one in every run.
bool is_compared(const std::string& column) {
  return column != "wall_s";
}

Quantity loaded(const Origins& origins, const std::string& name) {
  if (const auto found = origins.datasets.find(name); found != origins.datasets.end()) {
    return dataset_of(*origins.file, found->second);
  }
  if (name.starts_with(curve_group)) {
    return column_of(origins, name.substr(curve_group.size()));
  }
  throw std::logic_error(name + " is no field of the source");
}

Source source_of(std::string what, Origins origins) {
  Source source{std::move(what), {}, {}, {}, {}};
  for (const auto& entry : origins.datasets) source.names.push_back(entry.first);
  if (!origins.rows.empty()) {
    for (const std::string& column : record::column_names({plane, origins.measures})) {
      if (is_compared(column)) source.names.push_back(curve_group + column);
    }
  }
  std::ranges::sort(source.names);
  for (const CurveRow& row : origins.rows) source.steps.push_back(row.step);
  if (origins.file && origins.file->has(points_path)) {
    source.points = origins.file->read_all<double>(points_path);
  }
  source.load = [origins = std::move(origins)](const std::string& name) {
    return loaded(origins, name);
  };
  return source;
}

Source curve_source(const std::filesystem::path& path) {
  Origins origins;
  origins.rows = record::read_curve(path);
  origins.measures = record::read_curve_columns(path).measures;
  if (origins.rows.empty()) throw FileError(path, "has no row");
  const auto last = origins.rows.back().step;
  return source_of(fmt::format("curve to step {}", last), std::move(origins));
}

Source checkpoint_source(const std::filesystem::path& path) {
  record::CheckpointNotes notes;
  Origins origins;
  origins.file = std::make_shared<const Hdf5File>(record::open_checkpoint(path, notes));
  add_datasets(origins, "/state", "");
  origins.rows = std::move(notes.history);
  origins.measures = std::move(notes.measures);
  const auto step = origins.rows.back().step;
  return source_of(fmt::format("checkpoint of step {}", step), std::move(origins));
}

Source frame_source(const std::filesystem::path& path) {
  Origins origins;
  origins.file = std::make_shared<const Hdf5File>(files::open_unsealed(path));
  if (!origins.file->has("/VTKHDF/PointData")) throw FileError(path, "is no frame");
  add_datasets(origins, "/VTKHDF/PointData", "");
  origins.datasets["Points"] = points_path;
  return source_of("frame", std::move(origins));
}

Source folder_source(const std::filesystem::path& path) {
  std::vector<std::string> objections;
  const auto newest = record::newest_usable(path / "checkpoints", objections);
  if (newest) return checkpoint_source(*newest);
  throw FileError(path, objections.empty() ? "is no output folder: it has no checkpoint"
                                           : "has no usable checkpoint: " + objections.front());
}

}  // namespace

Source open_source(const std::filesystem::path& path) {
  std::error_code failure;
  if (!std::filesystem::exists(path, failure)) throw FileError(path, "there is no such file");
  if (std::filesystem::is_directory(path)) return folder_source(path);
  if (path.extension() == ".csv") return curve_source(path);
  return record::is_checkpoint(path) ? checkpoint_source(path) : frame_source(path);
}

}  // namespace comparison
