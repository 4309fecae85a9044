#pragma once

#include <Eigen/Core>
#include <vector>

namespace shape {

using Point = Eigen::Vector2d;
using SpacePoint = Eigen::Vector3d;
using Ring = std::vector<Point>;  ///< corners of a polygon, either way around, not closed

}  // namespace shape
