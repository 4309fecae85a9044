#pragma once

#include <string>
#include <vector>

#include "constitutive/material.hpp"
#include "material/path.hpp"

namespace material {

using Strain = constitutive::StrainVector<3>;
using Stress = constitutive::StressVector<3>;
using State = constitutive::PointState<3>;

/// A point of the path.
struct Point {
  std::size_t stage = 0;
  int step = 0;  // of the stage; 0 is its beginning
  Strain strain = Strain::Zero();
  State state;
  bool plastic = false;
  bool apex = false;
  double tangent_error = 0.0;  // see tangent_error; not a number where it has no meaning
};

/// The path as far as the material could follow it.
struct Course {
  std::vector<Point> points;
  std::string obstacle;  // why it ends before its end, or ""
};

/// Follows a path. A step whose stresses are not found is cut in halves; the strains of what is
/// given as stress are the least that reach it.
[[nodiscard]] Course follow(const constitutive::Material& material, const Path& path);

/// Largest difference of a tangent d(stress)/d(strain) from central differences of the update, over
/// Young's modulus; not a number where the one-sided ones differ: the step ends on a corner.
[[nodiscard]] double tangent_error(const constitutive::Material& material, const State& begin,
                                   const Strain& increment,
                                   const constitutive::TangentMatrix<3>& tangent);

}  // namespace material
