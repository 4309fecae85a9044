#pragma once

#include <Eigen/Core>
#include <vector>

#include "limit/algebra/equation_builder.hpp"
#include "limit/programme/parabolas.hpp"
#include "limit/programme/yield_cones.hpp"

namespace limit::programme {

/// The cones of the stresses in soil of curved envelopes. (p, d, t) is in the cone of no more
/// tension than the apex bears; (d, t) again in the cone of a radius r, |(d, t)| <= r; and the
/// parabola, w = r + shift and w^2 <= S z with z linear in p, is the cone |(w, (z - S) / 2)| <=
/// (z + S) / 2, of any size S.
class ParabolaCones {
 public:
  /// Further cones go to the end of these, which must outlive this.
  ParabolaCones(std::vector<YieldCone>& cones, std::vector<Eigen::Vector3d>& starts)
      : cones_(cones), starts_(starts) {}

  /// The cone of (p, d, t), the last one of all.
  void add(const problem::Envelope& envelope, const Parabola& parabola, const CurvedPoint& point,
           double reserve);
  /// Those of the radii and parabolas, once all stresses have theirs.
  void add_others();
  void equations(algebra::EquationBuilder& equations) const;
  void tell(ConeProgram& program) const;

 private:
  struct Stress {
    CurvedPoint point;
    Parabola parabola;
    double reserve = 0.0;
    double size = 0.0;                     // S
    Eigen::Index radius = 0, squares = 0;  // first variables of their cones
  };
  std::vector<YieldCone>& cones_;
  std::vector<Eigen::Vector3d>& starts_;
  std::vector<Stress> stresses_;
};

}  // namespace limit::programme
