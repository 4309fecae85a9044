#pragma once

#include <string>

#include "material/element_test.hpp"
#include "material/path.hpp"

namespace material {

/// A line per point, units in the names of the columns.
[[nodiscard]] std::string csv_text(const Course& course);
/// Deviatoric stress sqrt(3 J2) over deviatoric strain, a curve per stage.
[[nodiscard]] std::string shear_picture(const Path& path, const Course& course);
/// Volume strain over deviatoric strain, likewise.
[[nodiscard]] std::string volume_picture(const Path& path, const Course& course);
/// How each stage ended, and how the tangent stood up to differences.
[[nodiscard]] std::string summary(const Path& path, const Course& course);

}  // namespace material
