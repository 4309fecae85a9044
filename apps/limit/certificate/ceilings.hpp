#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "limit/certificate/stress_layout.hpp"
#include "limit/problem/bare_corners.hpp"
#include "limit/problem/problem.hpp"

namespace limit::certificate {

/// Where soil without tension bears along a free face alone, or nothing, by the place of its
/// stress.
[[nodiscard]] std::map<Eigen::Index, problem::BareCorner> bare_points(
    const problem::Problem& problem, const StressLayout& layout);

/// What no stress may exceed: yield in each triangle's corner, tension where it is cut off (along
/// the face alone where nothing else is borne), none where a footing may lift off.
struct Ceiling {
  enum class Kind { yield, tension, along, contact };
  Eigen::Index point = 0;
  Kind kind = Kind::yield;
  double cohesive = 0.0, sine = 0.0;         // c cos(phi), linear as the stress between points is
  double tension = 0.0;                      // the soil's
  mesh::Point normal{0.0, 0.0};              // of a contact, of a face
  bool is_loose = false;                     // of a yield: of soil without cohesion
  const problem::Envelope* curve = nullptr;  // of a yield that is not c and phi's
};

[[nodiscard]] std::vector<Ceiling> ceilings_of(const problem::Problem& problem);

/// Radius of Mohr's circle less the one that yields, over a stress that cannot vanish; or tension,
/// of the larger principal stress less the soil's.
[[nodiscard]] double excess(const Ceiling& ceiling, const Eigen::VectorXd& field);

/// How far a stress that is outside has to be drawn towards one that is strictly within.
[[nodiscard]] double share_of_rest(const Ceiling& ceiling, const Eigen::VectorXd& field,
                                   const Eigen::VectorXd& rest);

}  // namespace limit::certificate
