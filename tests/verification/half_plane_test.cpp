// Strip load on an elastic half-plane. The body is a box cut out of the half-plane; its cut faces
// carry the exact stresses as tractions, piece by piece, so that the box has no truncation error.

#include <numbers>

#include "measure.hpp"

namespace verification {
namespace {

struct PlaneStress {
  double xx, zz, xz;  // over the pressure q, compression positive, z down
};

// Uniform pressure on |x| < 1 of the surface z = 0 (Boussinesq-Flamant, superposed).
PlaneStress strip_load(double x, double z) {
  const double a = std::atan2(x + 1.0, z), b = std::atan2(x - 1.0, z);
  const double turn = 0.5 * (std::sin(2.0 * a) - std::sin(2.0 * b));
  return {(a - b - turn) / std::numbers::pi, (a - b + turn) / std::numbers::pi,
          (std::cos(2.0 * b) - std::cos(2.0 * a)) / (2.0 * std::numbers::pi)};
}

TEST(StripLoad, ClosedFormIsTheReference) {
  constexpr double digits = 1e-10;  // of the file
  for (const auto& row : reference_table("strip_load_half_plane.csv")) {
    const PlaneStress s = strip_load(row[0], row[1]);
    EXPECT_NEAR(s.xx, row[2], digits);
    EXPECT_NEAR(s.zz, row[3], digits);
    EXPECT_NEAR(s.xz, row[4], digits);
  }
}

constexpr double box = 6.0;       // half width and depth over the strip's half width
constexpr double pressure = 1e3;  // [Pa]

std::string traction(const std::string& name, const std::string& side, double from, double to,
                     double tx, double ty) {
  std::ostringstream text;
  text.precision(15);
  text << "[[traction]]\nname=\"" << name << "\"\nside=\"" << side << "\"\nrange_min=" << from
       << "\nrange_max=" << to << "\nvalue=[" << tx << ", " << ty << "]\n";
  return text.str();
}

// Tractions of the exact field on the cut faces, constant over half a spacing each.
std::string half_plane_scene(double spacing) {
  std::ostringstream text;
  text << "[geometry]\ndimension=2\nmin=[0.0, " << -box << "]\nmax=[" << box
       << ", 0.0]\nspacing=" << spacing
       << "\nlayout=\"cell\"\n[approximation]\nkinematics=\"small_strain\"\n"
          "[[material]]\nname=\"soil\"\nmodel=\"elastic\"\nyoungs_modulus=1e6\n"
          "poissons_ratio=0.3\n[[symmetry]]\naxis=\"x\"\nposition=0.0\n"
          "[[support]]\nname=\"foot\"\nat=[0.0, "
       << -box
       << "]\ndirections=[\"y\"]\n"
          "[drive]\nkind=\"load\"\nscales=[\"traction\"]\n[programme]\nsteps=1\n"
          "[solver]\ntolerance=1e-5\nmax_evaluations_per_step=4000\n"
       << traction("strip", "top", 0.0, 1.0, 0.0, -pressure);
  const double piece = 0.5 * spacing;
  const int pieces = static_cast<int>(std::lround(box / piece));
  for (int k = 0; k < pieces; ++k) {
    const double from = k * piece, to = (k + 1) * piece;
    const PlaneStress base = strip_load(0.5 * (from + to), box);
    text << traction("base " + std::to_string(k), "bottom", from, to, -pressure * base.xz,
                     pressure * base.zz);
    const PlaneStress side = strip_load(box, 0.5 * (from + to));
    text << traction("side " + std::to_string(k), "right", -to, -from, -pressure * side.xx,
                     pressure * side.xz);
  }
  return text.str();
}

struct Errors {
  double near = 0.0;  // largest stress error over q at the reference's points 0.5 deep and deeper
  double far = 0.0;   // likewise, 2 deep and deeper
  double foot = 0.0;  // force on the one support over the strip's
};

Errors errors_at(double spacing) {
  Run<2> run(scene_of(half_plane_scene(spacing)));
  run.complete();
  Errors errors;
  for (const auto& row : reference_table("strip_load_half_plane.csv")) {
    if (row[1] < 0.5 || row[1] > 0.9 * box || row[0] > 0.9 * box) continue;
    fpm::Field<2> point(1, 2);
    point << row[0], -row[1];
    const auto op = probe(run, point);
    const auto stress = [&](int i) {
      return op.scalar_value(0, run.state.stress.row(i).transpose()) / pressure;
    };
    double worst = std::max(std::abs(-stress(0) - row[2]), std::abs(-stress(1) - row[3]));
    // A scalar value continues evenly through the mirror; shear is odd there.
    if (row[0] > 0.0) worst = std::max(worst, std::abs(stress(3) - row[4]));
    errors.near = std::max(errors.near, worst);
    if (row[1] >= 2.0) errors.far = std::max(errors.far, worst);
  }
  const Eigen::Index foot = run.nearest(fpm::Vector<2>(0.0, -box));
  errors.foot = std::abs(run.state.reaction(foot, 1)) / pressure;
  return errors;
}

// Half a strip deep the stresses vary over a length of 0.5: an error of second order with a
// constant of one is (dx / 0.5)^2; two strips deep it is (dx / 2)^2.
double near_tolerance(double spacing) {
  return std::pow(spacing / 0.5, 2);
}
double far_tolerance(double spacing) {
  return std::pow(spacing / 2.0, 2);
}
// The exact tractions balance up to the midpoint rule on pieces of dx / 2, whose error is
// (dx / 2)^2 / 24 times the change of the stresses' slope along a cut face, below 0.1 q.
double foot_tolerance(double spacing) {
  return 0.1 * std::pow(0.5 * spacing, 2) / 24.0;
}
constexpr double order_tolerance = 0.5;  // of two, at the resolution of a quarter of the strip

TEST(StripLoad, StressesConvergeToClosedFormAtSecondOrder) {
  std::vector<double> near, far;
  for (const double spacing : {0.25, 0.125}) {
    const Errors errors = errors_at(spacing);
    std::ostringstream at;
    at << "_at_" << spacing;
    report("near_error" + at.str(), errors.near);
    report("far_error" + at.str(), errors.far);
    report("foot" + at.str(), errors.foot);
    EXPECT_LT(errors.near, near_tolerance(spacing));
    EXPECT_LT(errors.far, far_tolerance(spacing));
    EXPECT_LT(errors.foot, foot_tolerance(spacing));
    near.push_back(errors.near);
    far.push_back(errors.far);
  }
  EXPECT_GT(convergence_order(near[0], near[1], 2.0), 2.0 - order_tolerance);
  EXPECT_GT(convergence_order(far[0], far[1], 2.0), 2.0 - order_tolerance);
}

}  // namespace
}  // namespace verification
