#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "limit/mesh/mesh.hpp"
#include "limit/problem/problem.hpp"

namespace limit::programme {

/// A cone that is the tangent of a curved envelope, and where it touches.
struct Touch {
  Eigen::Index variable = 0;  // the first of its cone
  int region = 0;
  bool is_jump = false;         // a plane's normal stress is the pressure, else a circle's centre
  mesh::Point place{0.0, 0.0};  // a little within its triangle or side, where no other one is
  double pressure = 0.0;        // compression positive
};

/// Where tangents touched, and the stresses that were found with them: where they should next.
class Tangents {
 public:
  /// The stress found at the nearest place of the same soil and kind; none if there is none.
  [[nodiscard]] std::optional<double> pressure_near(int region, bool is_jump,
                                                    const mesh::Point& place) const;

  /// Learns the stresses of a program's solution.
  void take(const std::vector<Touch>& touches, const Eigen::VectorXd& variables);

  /// The share of its strength that each tangent of a stress field leaves unused: beside the place
  /// where it touches, a tangent is outside of its envelope.
  [[nodiscard]] double reserve() const { return reserve_; }
  /// To more of it, where stresses were found outside and nothing is there to draw them back.
  void draw_in();

 private:
  struct Known {
    mesh::Point place;
    double pressure;
  };
  std::map<std::pair<int, bool>, std::vector<Known>> known_;  // each by x
  double reserve_ = 0.0;
};

/// A tangent as a soil of its cohesion and friction, and the pressure under which it touches.
struct Tangent {
  problem::Soil soil;
  double pressure = 0.0;
};

/// The tangent of a soil's curved envelope under a pressure, or, where there is none, the nearest.
[[nodiscard]] Tangent touched(const problem::Soil& soil, bool is_jump, double pressure);

/// A tenth of the way from one place to another.
[[nodiscard]] mesh::Point towards(const mesh::Point& from, const mesh::Point& to);

}  // namespace limit::programme
