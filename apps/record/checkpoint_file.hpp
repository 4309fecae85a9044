#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "files/content_digest.hpp"
#include "files/hdf5_file.hpp"
#include "record/curve.hpp"
#include "record/lineage.hpp"

namespace record {

/// Layout of checkpoint files; raised when a reader of the former one would go wrong. Older ones
/// are read: 1 had no seal (see open_unsealed), and of the lineage only the parent's name; 1 and 2
/// had no reactions in the state; before 4 no load kept the initial stress at rest; before 7 there
/// was one stage; before 8 supports by penalty held at none, and opposite sides that hold the same
/// particles shared what these bear; before 9 no solve knew what the one before had learnt; before
/// 10 stages that try the ground had the control of displacements.
inline constexpr std::int64_t checkpoint_schema = 10;

/// What a checkpoint holds beside the mechanical state. It makes a checkpoint sufficient by itself:
/// a run goes on from it though the rest of its folder is lost.
struct CheckpointNotes {
  std::string title;
  std::string scene;              // every key of the scene in force, as TOML
  std::string materials;          // Boost archive of the material parameters
  std::string versions;           // of the program and its libraries
  std::string created;            // UTC, ISO 8601
  std::string reason;             // why it was written
  std::vector<Ancestor> lineage;  // the checkpoints the run went on from, oldest first
  int dimension = 2;
  std::vector<std::string> measures;  // columns of the curve beside those that every run has
  std::vector<CurveRow> history;      // the curve up to and including the checkpoint's step
  // Of the file rather than in it; known once it is opened.
  std::int64_t schema = checkpoint_schema;
  std::int64_t digest = 0;
  std::int64_t stage = 0;  // of the state, from 0
  double progress = 0.0;   // in it

  /// Calls visit(name, text) for each plain text, in the order of the file.
  template <class Self, class Visitor>
  static void for_each_text(Self& self, Visitor&& visit) {
    visit("title", self.title);
    visit("scene", self.scene);
    visit("materials", self.materials);
    visit("versions", self.versions);
    visit("created", self.created);
    visit("reason", self.reason);
  }
};

/// Writes /meta and /history, and as attributes of "/" what a look from outside wants.
void write_notes(files::Hdf5File& file, const CheckpointNotes& notes, files::ContentDigest& digest);

/// Writes the digest of everything; the last dataset.
void write_digest(files::Hdf5File& file, const files::ContentDigest& digest);

/// Whether a file is a checkpoint, sound or not, rather than a frame.
/// @throws FileError if it is neither.
[[nodiscard]] bool is_checkpoint(const std::filesystem::path& file);

/// Opens a checkpoint and reads all of it once: seal, schema, checksums, digest and notes are
/// sound, and notes and state are of one step.
/// @param[out] notes  what it holds beside the state
/// @throws FileError saying what is wrong with it.
[[nodiscard]] files::Hdf5File open_checkpoint(const std::filesystem::path& path,
                                              CheckpointNotes& notes);

/// The same of a file that has just got its seal, for which all of it was read.
[[nodiscard]] files::Hdf5File open_just_sealed(const std::filesystem::path& path,
                                               CheckpointNotes& notes);

}  // namespace record
