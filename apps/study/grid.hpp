#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace study {

/// A key of the scene and the values that it takes, as the user wrote them. The last counts as the
/// finest.
struct Vary {
  std::string key;
  std::vector<std::string> values;
  std::vector<double> numbers;  // the values, if all of them are positive numbers; else empty
};

/// The key and values of `KEY=V1,V2,...`; commas within brackets and quotes belong to a value.
/// @throws UsageError naming what is missing, or a value that is there twice.
[[nodiscard]] Vary parse_vary(const std::string& text);

/// Which value of each Vary a run has.
using Combination = std::vector<std::size_t>;

/// Every combination, the last key running fastest.
[[nodiscard]] std::vector<Combination> all_combinations(const std::vector<Vary>& varied);

/// `KEY=VALUE` of each key.
[[nodiscard]] std::vector<std::string> settings_of(const std::vector<Vary>& varied,
                                                   const Combination& combination);

/// The combination in words, by the last part of each key: `spacing=0.02 tolerance=1e-3`.
[[nodiscard]] std::string words_for(const std::vector<Vary>& varied,
                                    const Combination& combination);

/// The combinations, by their numbers, that differ in one key only, for each choice of the others.
[[nodiscard]] std::vector<std::vector<std::size_t>> series_along(
    const std::vector<Vary>& varied, const std::vector<Combination>& all, std::size_t key);

}  // namespace study
