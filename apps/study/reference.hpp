#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "study/quantity.hpp"
#include "study/results.hpp"

namespace scene {
struct Scene;
}

namespace study {

/// Where a reference is to come from.
struct ReferenceWish {
  enum class Kind { number, file, richardson, limit };
  Kind kind = Kind::richardson;
  Reference reference;  // of number and file
  std::string key;      // of richardson: along which; "" for the first that can
};

/// The wish of a text: a number, `richardson`, `richardson:KEY`, `limit`, or a CSV file that has
/// the quantity, such as a curve.
/// @throws UsageError if it is none of these.
[[nodiscard]] ReferenceWish parse_reference(const std::string& text, const Quantity& quantity);

/// The middle of the collapse load's bracket by fpm-limit; computed once per scene.
/// @param folder  where it is kept
/// @throws UsageError if there is no bracket.
[[nodiscard]] Reference limit_reference(const scene::Scene& scene,
                                        const std::filesystem::path& folder,
                                        const std::filesystem::path& program);

}  // namespace study
