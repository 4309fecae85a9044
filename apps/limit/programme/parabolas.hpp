#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "limit/mesh/mesh.hpp"
#include "limit/problem/local_soil.hpp"
#include "limit/problem/problem.hpp"
#include "limit/programme/cone_program.hpp"

namespace limit::programme {

/// A bound on the radius of Mohr's circle in its centre p, tension positive: (radius + shift)^2 <=
/// (touching + shift)^2 - 2 (touching + shift) sine (p + centre), that of a curved envelope at the
/// pressure `centre`, and of its slope there.
struct Parabola {
  double shift = 0.0, centre = 0.0, touching = 0.0, sine = 0.0;
};

/// Where in the envelopes the stresses of a solution lay: what stands for them the next time is
/// true there, and less so away from there.
class Parabolas {
 public:
  /// Of a soil at a place. The lower bound's lies within the envelope, the upper bound's is as
  /// close as a parabola can be. Neither touches where slopes are beyond 80 degrees, nor closer to
  /// the apex than differences of pressures tell.
  /// @param guess  the pressure there, if none is known, compression positive
  [[nodiscard]] Parabola at(const problem::Soil& soil, const CurvedPoint& point, double guess,
                            problem::Bound bound) const;

  /// Learns the stresses of a program's solution.
  void take(const std::vector<CurvedPoint>& points, const Eigen::VectorXd& variables);

  /// From now on guesses are those of a free face, everywhere: farther down they are worth less,
  /// but no parabola ends above what a stress may be.
  void guess_least() { guesses_least_ = true; }
  [[nodiscard]] bool guesses_least() const { return guesses_least_; }

 private:
  struct Known {
    mesh::Point place;
    double pressure;
  };
  [[nodiscard]] std::optional<double> pressure_near(const CurvedPoint& point) const;

  std::map<std::pair<int, bool>, std::vector<Known>> known_;  // of a region's kind, each by x
  bool guesses_least_ = false;
};

/// The shift with which the square of an envelope's radius is as near to straight at u as can be,
/// d(R sin(phi)) / -d(sin(phi)).
[[nodiscard]] double straightening_shift(const problem::Envelope& envelope, double u);

/// A shift with which the parabola that touches at u is nowhere beyond the envelope, down to the
/// apex: at most 1 % below the largest one.
[[nodiscard]] double shift_within(const problem::Envelope& envelope, double u);

/// A tenth of the way from one place to another.
[[nodiscard]] mesh::Point towards(const mesh::Point& from, const mesh::Point& to);

}  // namespace limit::programme
