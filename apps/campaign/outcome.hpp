#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace campaign {

/// What a run cost, over all the processes it was made in.
struct Cost {
  double wall = 0.0;            // [s]
  double cpu = 0.0;             // [s]
  std::int64_t peak_bytes = 0;  // of the largest of them
  bool complete = true;         // false: a process was killed before its cost could be noted
  bool operator==(const Cost&) const = default;
};

/// What is kept of a run beside its output, in a file of its folder.
struct Outcome {
  std::string digest;            // of scene and program, see digest_of
  std::optional<int> exit_code;  // absent: it has not ended yet
  bool at_work = false;          // a process was started whose end nobody has noted
  Cost cost;
  bool operator==(const Outcome&) const = default;

  /// Whether it need not run again: done, or with certainty not to be done.
  [[nodiscard]] bool finished() const;
};

/// A digest of what decides a run: the scene, every key of it, and the program, every byte of it.
/// @throws FileError if the program cannot be read.
[[nodiscard]] std::string digest_of(const std::string& scene, const std::filesystem::path& program);

/// @throws FileError if it cannot be written.
void write_outcome(const std::filesystem::path& file, const Outcome& outcome);
/// What a file says; nothing if there is none, it is damaged, or of another digest.
[[nodiscard]] std::optional<Outcome> read_outcome(const std::filesystem::path& file,
                                                  const std::string& digest);

}  // namespace campaign
