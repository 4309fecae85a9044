#include "wiring/checkpoint_file.hpp"

#include <fmt/format.h>

#include <array>
#include <ctime>

namespace wiring {

namespace {

const std::string schema_path = "/meta/schema";
const std::string dimension_path = "/meta/dimension";
const std::string curve_path = "/history/curve";
const std::string step_path = "/state/programme/step";
const std::string digest_path = "/digest";
const std::array<std::string, 3> digested_groups{"/meta", "/history", "/state"};

void put_number(Hdf5File& file, const std::string& path, std::int64_t number,
                ContentDigest& digest) {
  file.write<std::int64_t>(path, std::span(&number, 1), {1});
  digest.add(path, std::as_bytes(std::span(&number, 1)));
}

void put_text(Hdf5File& file, const std::string& path, const std::string& text,
              ContentDigest& digest) {
  file.write_text(path, text);
  digest.add(path, std::as_bytes(std::span(text)));
}

std::int64_t number_at(const Hdf5File& file, const std::string& path) {
  std::int64_t number = 0;
  file.read<std::int64_t>(path, std::span(&number, 1), {1});
  return number;
}

std::vector<CurveRow> history_of(const Hdf5File& file) {
  const std::string text = file.read_text(curve_path);
  std::vector<CurveRow> rows;
  try {
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = text.find('\n', at);
      const std::string_view line = std::string_view(text).substr(at, end - at);
      if (at > 0) rows.push_back(parse_curve_line(line));  // the first line is the header
      at = end == std::string::npos ? text.size() : end + 1;
    }
  } catch (const std::invalid_argument& failure) {
    throw FileError(file.file(), curve_path + ": " + failure.what());
  }
  return rows;
}

void require_schema(const Hdf5File& file) {
  if (!file.has(schema_path)) throw FileError(file.file(), "is no checkpoint of this program");
  const std::int64_t schema = number_at(file, schema_path);
  if (schema == checkpoint_schema) return;
  const std::string versions = file.read_text("/meta/versions");
  throw FileError(file.file(), fmt::format("has checkpoint schema {} (written by {}); this program "
                                           "reads schema {}",
                                           schema, versions, checkpoint_schema));
}

void require_digest(const Hdf5File& file) {
  if (!file.has(digest_path)) throw FileError(file.file(), "is not complete");
  ContentDigest digest;
  for (const std::string& group : digested_groups) add_group(digest, file, group);
  if (digest.value() != number_at(file, digest_path)) {
    throw FileError(file.file(), "its datasets are not those it was written with");
  }
}

CheckpointNotes notes_of(const Hdf5File& file) {
  CheckpointNotes notes;
  CheckpointNotes::for_each_text(notes, [&](const char* name, std::string& text) {
    text = file.read_text(std::string("/meta/") + name);
  });
  notes.dimension = static_cast<int>(number_at(file, dimension_path));
  notes.history = history_of(file);
  const std::int64_t step = number_at(file, step_path);
  if (notes.history.empty() || notes.history.back().step != step) {
    throw FileError(file.file(), fmt::format("its history does not end at its step {}", step));
  }
  return notes;
}

}  // namespace

std::string time_stamp() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text.data();
}

std::string curve_text(int dimension, const std::vector<CurveRow>& rows) {
  std::string text = curve_header(dimension) + "\n";
  for (const CurveRow& row : rows) text += curve_line(row) + "\n";
  return text;
}

void write_notes(Hdf5File& file, const CheckpointNotes& notes, ContentDigest& digest) {
  put_number(file, schema_path, checkpoint_schema, digest);
  put_number(file, dimension_path, notes.dimension, digest);
  CheckpointNotes::for_each_text(notes, [&](const char* name, const std::string& text) {
    put_text(file, std::string("/meta/") + name, text, digest);
  });
  put_text(file, curve_path, curve_text(notes.dimension, notes.history), digest);

  const CurveRow& last = notes.history.back();
  file.write_attribute("/", "step", last.step);
  file.write_attribute("/", "load", last.load_parameter);
  file.write_attribute("/", "created", notes.created);
  file.write_attribute("/", "reason", notes.reason);
}

void seal(Hdf5File& file, const ContentDigest& digest) {
  const std::int64_t value = digest.value();
  file.write<std::int64_t>(digest_path, std::span(&value, 1), {1});
}

Hdf5File open_checkpoint(const std::filesystem::path& path, CheckpointNotes& notes) {
  Hdf5File file = Hdf5File::open(path);
  require_schema(file);
  require_digest(file);
  notes = notes_of(file);
  return file;
}

}  // namespace wiring
