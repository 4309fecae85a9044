#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace record {

/// A checkpoint from which a run went on, be it in the same folder or as a branch in another.
struct Ancestor {
  std::string checkpoint;  // its absolute path at that time
  std::int64_t step = 0;
  std::string created;               // UTC, ISO 8601
  std::string identity;              // of its content, see identity_of; "" where unknown
  std::vector<std::string> changed;  // what the run that went on changed, `key: before -> after`
  bool operator==(const Ancestor&) const = default;
};

/// A lineage as TOML, oldest ancestor first.
[[nodiscard]] std::string lineage_text(const std::vector<Ancestor>& ancestors);

/// The lineage of a text.
/// @throws std::invalid_argument saying what is wrong with it.
[[nodiscard]] std::vector<Ancestor> parse_lineage(std::string_view text);

/// A digest as text, by which a checkpoint is known again though it was moved or renamed.
[[nodiscard]] std::string identity_of(std::int64_t digest);

}  // namespace record
