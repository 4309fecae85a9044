#include "limit/programme/parabola_cones.hpp"

#include <algorithm>

namespace limit::programme {

namespace {

// A place without strength must not have a scale of zero.
constexpr double least = 1e-6;

}  // namespace

void ParabolaCones::add(const problem::Envelope& envelope, const Parabola& parabola,
                        const CurvedPoint& point, double reserve) {
  Stress stress{point, parabola, reserve};
  stress.size = std::max(parabola.touching + parabola.shift, least);
  stress.point.variable = 3 * static_cast<Eigen::Index>(cones_.size());
  stresses_.push_back(stress);
  cones_.push_back(
      {envelope.apex() * (1.0 - 2.0 * reserve), 1.0 - reserve, std::max(parabola.touching, least)});
  // With half of the strength where the parabola touches all of the cones have room.
  starts_.emplace_back(-parabola.centre, 0.0, 0.0);
}

void ParabolaCones::add_others() {
  const auto add = [&](double scale, const Eigen::Vector3d& start) {
    const auto variable = 3 * static_cast<Eigen::Index>(cones_.size());
    cones_.push_back(half_line_cone(scale));
    starts_.push_back(start);
    return variable;
  };
  for (Stress& stress : stresses_) {
    const Parabola& parabola = stress.parabola;
    const double scale = cones_[static_cast<std::size_t>(stress.point.variable / 3)].scale;
    const double radius = parabola.touching / 2.0, whole = parabola.touching + parabola.shift;
    const double z = whole * whole / stress.size;
    stress.radius = add(scale, {-radius, 0.0, 0.0});
    stress.squares = add(
        stress.size, {-(stress.size + z) / 2.0, radius + parabola.shift, (z - stress.size) / 2.0});
  }
}

void ParabolaCones::equations(algebra::EquationBuilder& equations) const {
  for (const Stress& stress : stresses_) {
    const Parabola& parabola = stress.parabola;
    const Eigen::Index own = stress.point.variable, squares = stress.squares;
    for (const Eigen::Index i : {1, 2}) {
      equations.begin(0.0);
      equations.add(own + i, 1.0);
      equations.add(stress.radius + i, -1.0);
    }
    // The first variable of the radius' cone is -r; (z - S) / 2 is the last one of the squares'.
    equations.begin(parabola.shift + stress.reserve * parabola.touching);
    equations.add(squares + 1, 1.0);
    equations.add(stress.radius, 1.0 + stress.reserve);
    equations.begin(stress.size);
    equations.add(squares, -1.0);
    equations.add(squares + 2, -1.0);
    const double whole = parabola.touching + parabola.shift, slope = 2.0 * whole * parabola.sine;
    equations.begin((whole * whole - slope * parabola.centre) / stress.size);
    equations.add(squares, -1.0);
    equations.add(squares + 2, 1.0);
    equations.add(own, slope / stress.size);
  }
}

void ParabolaCones::tell(ConeProgram& program) const {
  for (const Stress& stress : stresses_) {
    program.curved.push_back(stress.point);
    program.twins.emplace_back(static_cast<std::size_t>(stress.point.variable / 3),
                               static_cast<std::size_t>(stress.radius / 3));
  }
}

}  // namespace limit::programme
