#include "record/frame_series.hpp"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "files/durable_file.hpp"

namespace record {

namespace {

/// The entries of a list as `write` writes it.
/// @throws nlohmann::json::exception saying what it has instead.
std::vector<FrameSeries::Entry> entries_of(const std::string& text) {
  const nlohmann::json list = nlohmann::json::parse(text);
  std::vector<FrameSeries::Entry> entries;
  for (const auto& entry : list.at("files")) {
    entries.push_back({entry.at("name").get<std::string>(), entry.at("time").get<double>()});
  }
  return entries;
}

}  // namespace

FrameSeries FrameSeries::resume(std::filesystem::path file, double time,
                                const files::SystemCalls& system) {
  FrameSeries series(std::move(file), system);
  if (!std::filesystem::exists(series.file_)) return series;
  try {
    series.entries_ = entries_of(files::read_text(series.file_));
  } catch (const nlohmann::json::exception& failure) {
    throw files::FileError(series.file_,
                           std::string("is no frame list of this program: ") + failure.what());
  }
  std::erase_if(series.entries_, [&](const Entry& entry) { return entry.time > time; });
  series.write();
  return series;
}

void FrameSeries::append(std::string name, double time) {
  entries_.push_back({std::move(name), time});
  write();
}

// One entry per line, for those who read it; the names are ours and hold nothing to be escaped.
void FrameSeries::write() const {
  std::string text = "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n";
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "    {{ \"name\": \"{}\", \"time\": {} }}{}\n",
                   entries_[i].name, entries_[i].time, i + 1 < entries_.size() ? "," : "");
  }
  text += "  ]\n}\n";
  files::write_text_durably(file_, text, *system_);
}

}  // namespace record
