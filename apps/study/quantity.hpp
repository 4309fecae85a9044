#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scene {
struct Scene;
}

namespace study {

/// A table of numbers with a name over each column: a curve, or a reference.
struct Columns {
  std::vector<std::string> names;
  std::vector<std::vector<double>> values;  // of each name
};

/// Reads a table from CSV; lines that begin with # are comments.
/// @throws FileError naming file and line of what is no number.
[[nodiscard]] Columns read_columns(const std::filesystem::path& file);

/// The one number by which runs are judged.
struct Quantity {
  enum class Kind { last, largest, at };
  Kind kind = Kind::last;
  std::string text;       // as the user wrote it
  std::string column;     // of a curve
  std::string at_column;  // of Kind::at
  double at = 0.0;
  std::string field;          // displacement, stress or plastic_strain at a point, or ""
  std::vector<double> point;  // [m]
};

/// The quantity of a text: `COLUMN` (its last value), `max(COLUMN)`, `COLUMN@COLUMN=VALUE`, or
/// `FIELD@X,Y[,Z]` with displacement_x, stress_xx, plastic_strain and the like.
/// @throws UsageError saying which forms there are.
[[nodiscard]] Quantity parse_quantity(const std::string& text);

/// Holds a field at a point against a scene.
/// @throws UsageError if the body has no such direction, or the point is not in its box.
void check_quantity(const scene::Scene& scene, const Quantity& quantity);

/// The scene with what it must measure for the quantity to be in its curve.
[[nodiscard]] scene::Scene with_measure(const scene::Scene& scene, const Quantity& quantity);

/// The name among `names` that is meant by a column's name: itself; without its unit; pressure for
/// the mean pressure, d/B for settlement_over_B. "" if none is.
[[nodiscard]] std::string column_meant(const std::vector<std::string>& names,
                                       std::string_view wanted);

/// How many of the first unit of two columns' names one of the second is: 1000 of pressure_kPa and
/// pressure_Pa.
[[nodiscard]] double units_between(std::string_view from, std::string_view to);

/// The quantity's value in a table, or why it has none there.
struct Reading {
  std::optional<double> value;
  std::string obstacle;
  bool no_such_column = false;
};
[[nodiscard]] Reading value_in(const Columns& table, const Quantity& quantity);

}  // namespace study
