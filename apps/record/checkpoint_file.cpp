#include "record/checkpoint_file.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>

#include "files/file_seal.hpp"
#include "files/unsealed_file.hpp"
#include "record/checkpoint_name.hpp"

namespace record {

namespace {

const std::string schema_path = "/meta/schema";
const std::string dimension_path = "/meta/dimension";
const std::string lineage_path = "/meta/lineage";
const std::string parent_path = "/meta/parent";  // of schema 1
const std::string curve_path = "/history/curve";
const std::string step_path = "/state/programme/step";
const std::string stage_path = "/state/programme/stage";
const std::string progress_path = "/state/programme/progress";
const std::string digest_path = "/digest";
constexpr std::int64_t schema_of_stages = 7;
const std::array<std::string, 3> digested_groups{"/meta", "/history", "/state"};

void put_number(files::Hdf5File& file, const std::string& path, std::int64_t number,
                files::ContentDigest& digest) {
  file.write<std::int64_t>(path, std::span(&number, 1), {1});
  digest.add(path, std::as_bytes(std::span(&number, 1)));
}

void put_text(files::Hdf5File& file, const std::string& path, const std::string& text,
              files::ContentDigest& digest) {
  file.write_text(path, text);
  digest.add(path, std::as_bytes(std::span(text)));
}

std::int64_t number_at(const files::Hdf5File& file, const std::string& path) {
  std::int64_t number = 0;
  file.read<std::int64_t>(path, std::span(&number, 1), {1});
  return number;
}

/// Reads the curve, and what it measures.
void read_history(const files::Hdf5File& file, CheckpointNotes& notes) {
  const std::string text = file.read_text(curve_path);
  try {
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = text.find('\n', at);
      const std::string_view line = std::string_view(text).substr(at, end - at);
      if (at > 0) {
        notes.history.push_back(parse_curve_line(line, notes.measures.size()));
      } else if (const auto columns = parse_curve_header(line)) {
        notes.measures = columns->measures;
      } else {
        throw std::invalid_argument("does not begin with the header of a curve");
      }
      at = end == std::string::npos ? text.size() : end + 1;
    }
  } catch (const std::invalid_argument& failure) {
    throw files::FileError(file.file(), curve_path + ": " + failure.what());
  }
}

files::FileError unknown_schema(const std::filesystem::path& file, std::int64_t schema,
                                const std::string& writer) {
  return {file, fmt::format("has checkpoint schema {} (written by {}); this program reads schemas "
                            "1 to {}",
                            schema, writer, checkpoint_schema)};
}

bool begins_as_hdf5(const std::filesystem::path& file) {
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  std::ifstream stream(file, std::ios::binary);
  std::string text(signature.size(), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  return text == signature;
}

/// Holds the seal against the file, before HDF5 sees a byte of it. The first schema had none.
files::Hdf5File open_behind_seal(const std::filesystem::path& path) {
  std::error_code failure;
  if (!std::filesystem::exists(path, failure))
    throw files::FileError(path, "there is no such file");
  const auto seal = files::read_seal(path);
  if (seal) {
    files::require_unbroken(path, *seal);
    if (seal->schema > checkpoint_schema) throw unknown_schema(path, seal->schema, seal->writer);
    return files::Hdf5File::open(path);
  }
  if (!begins_as_hdf5(path)) {
    throw files::FileError(path, "is no checkpoint of this program, or its beginning is lost");
  }
  return files::open_unsealed(path);
}

std::int64_t known_schema_of(const files::Hdf5File& file) {
  if (!file.has(schema_path))
    throw files::FileError(file.file(), "is no checkpoint of this program");
  const std::int64_t schema = number_at(file, schema_path);
  if (schema < 1 || schema > checkpoint_schema) {
    throw unknown_schema(file.file(), schema, file.read_text("/meta/versions"));
  }
  if (schema > 1 && !files::read_seal(file.file()))
    throw files::FileError(file.file(), "has lost its seal");
  return schema;
}

std::int64_t sound_digest_of(const files::Hdf5File& file) {
  if (!file.has(digest_path)) throw files::FileError(file.file(), "is not complete");
  files::ContentDigest digest;
  for (const std::string& group : digested_groups) files::add_group(digest, file, group);
  if (digest.value() != number_at(file, digest_path)) {
    throw files::FileError(file.file(), "its datasets are not those it was written with");
  }
  return digest.value();
}

std::vector<Ancestor> lineage_of(const files::Hdf5File& file, std::int64_t schema) {
  try {
    if (schema > 1) return parse_lineage(file.read_text(lineage_path));
  } catch (const std::invalid_argument& failure) {
    throw files::FileError(file.file(), lineage_path + ": " + failure.what());
  }
  const std::string parent = file.read_text(parent_path);
  if (parent.empty()) return {};
  return {Ancestor{parent, step_of(parent).value_or(0), "", "", {}}};
}

CheckpointNotes notes_of(const files::Hdf5File& file) {
  CheckpointNotes notes;
  notes.schema = known_schema_of(file);
  notes.digest = sound_digest_of(file);
  CheckpointNotes::for_each_text(notes, [&](const char* name, std::string& text) {
    text = file.read_text(std::string("/meta/") + name);
  });
  notes.lineage = lineage_of(file, notes.schema);
  notes.dimension = static_cast<int>(number_at(file, dimension_path));
  read_history(file, notes);
  if (notes.schema >= schema_of_stages) {
    notes.stage = number_at(file, stage_path);
    file.read<double>(progress_path, std::span(&notes.progress, 1), {1});
  }
  const std::int64_t step = number_at(file, step_path);
  if (notes.history.empty() || notes.history.back().step != step) {
    throw files::FileError(file.file(),
                           fmt::format("its history does not end at its step {}", step));
  }
  return notes;
}

}  // namespace

void write_notes(files::Hdf5File& file, const CheckpointNotes& notes,
                 files::ContentDigest& digest) {
  put_number(file, schema_path, checkpoint_schema, digest);
  put_number(file, dimension_path, notes.dimension, digest);
  CheckpointNotes::for_each_text(notes, [&](const char* name, const std::string& text) {
    put_text(file, std::string("/meta/") + name, text, digest);
  });
  put_text(file, lineage_path, lineage_text(notes.lineage), digest);
  put_text(file, curve_path, curve_text({notes.dimension, notes.measures}, notes.history), digest);

  const CurveRow& last = notes.history.back();
  file.write_attribute("/", "step", last.step);
  file.write_attribute("/", "load", last.load_parameter);
  file.write_attribute("/", "created", notes.created);
  file.write_attribute("/", "reason", notes.reason);
}

void write_digest(files::Hdf5File& file, const files::ContentDigest& digest) {
  const std::int64_t value = digest.value();
  file.write<std::int64_t>(digest_path, std::span(&value, 1), {1});
}

bool is_checkpoint(const std::filesystem::path& file) {
  if (files::has_seal(file) || step_of(file)) return true;
  return files::open_unsealed(file).has(schema_path);  // one of the first schema under another name
}

files::Hdf5File open_checkpoint(const std::filesystem::path& path, CheckpointNotes& notes) {
  files::Hdf5File file = open_behind_seal(path);
  notes = notes_of(file);
  return file;
}

files::Hdf5File open_just_sealed(const std::filesystem::path& path, CheckpointNotes& notes) {
  files::Hdf5File file = files::Hdf5File::open(path);
  notes = notes_of(file);
  return file;
}

}  // namespace record
