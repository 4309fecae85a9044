#include "limit/problem/rigid_corners.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limit/bracket/bracket.hpp"
#include "limit/problem/strip.hpp"
#include "limit/programme/upper_bound.hpp"

namespace {

using namespace limit;

constexpr double degree = std::numbers::pi / 180.0;
// Of angles and areas that are sums of some terms of order one to ten.
constexpr double rounding = 1e-12;

double area(const mesh::Mesh& mesh) {
  double twice = 0.0;
  for (const mesh::Triangle& triangle : mesh.triangles) twice += mesh::twice_area(mesh, triangle);
  return twice / 2.0;
}

// A strip on weightless soil, in a box a little larger than Prandtl's mechanism.
problem::Problem strip_in_default_box(double phi) {
  problem::Strip strip;
  strip.soil = {1.0, phi * degree, 0.0};
  strip.rough = false;
  const problem::Box box = problem::box_of(strip);
  return problem::in_units(
      problem::strip_problem(strip, mesh::even_fan(box.width, box.depth, 20, 6, 1.25)),
      problem::units_of(strip));
}

// Soil that fills a rigid wedge up to a free side.
problem::Problem wedge(double phi, double opening) {
  problem::Problem problem;
  problem.mesh.nodes = {{0, 0}, {1, 0}, {std::cos(opening * degree), std::sin(opening * degree)}};
  problem.mesh.triangles = {{{0, 1, 2}, 0}};
  problem.mesh.boundary = {{0, 1, 0}, {1, 2, 1}, {2, 0, 0}};
  problem.soils = {{1.0, phi * degree, 0.0}};
  problem.boundaries = {{"rigid", problem::Known::support, problem::Known::support}, {"free"}};
  return problem;
}

// Between neighbouring sides of an outline, where both are rough supports; the body is convex there
// or straight.
double narrowest_rigid_corner(const problem::Problem& problem) {
  double narrowest = 180.0 * degree;
  for (const mesh::BoundaryEdge& in : problem.mesh.boundary) {
    for (const mesh::BoundaryEdge& out : problem.mesh.boundary) {
      const auto is_rigid = [&](const mesh::BoundaryEdge& edge) {
        const problem::Boundary& on = problem.boundaries[static_cast<std::size_t>(edge.boundary)];
        return on.normal == problem::Known::support && on.tangential == problem::Known::support;
      };
      if (in.second != out.first || !is_rigid(in) || !is_rigid(out)) continue;
      const auto at = [&](int i) { return problem.mesh.nodes[static_cast<std::size_t>(i)]; };
      const mesh::Point back = at(in.first) - at(in.second), forth = at(out.second) - at(out.first);
      narrowest = std::min(narrowest, std::acos(back.dot(forth) / (back.norm() * forth.norm())));
    }
  }
  return narrowest;
}

TEST(RigidCorners, OfABoxStayBelowFortyDegrees) {
  for (const double phi : {0.0, 20.0, 40.0}) {
    const problem::Problem before = strip_in_default_box(phi);
    const problem::Problem after = problem::with_rigid_corners_cut(before);
    EXPECT_EQ(after.mesh.triangles.size(), before.mesh.triangles.size());
    EXPECT_EQ(after.mesh.nodes.size(), before.mesh.nodes.size());
  }
}

// At the axis, without friction, soil can leave a right angle; at the wall it cannot.
TEST(RigidCorners, OfABoxAreCutFromFortyFiveDegreesOn) {
  for (const double phi : {45.0, 50.0}) {
    const problem::Problem before = strip_in_default_box(phi);
    const problem::Problem after = problem::with_rigid_corners_cut(before);
    EXPECT_NO_THROW((void)mesh::edges_of(after.mesh));
    EXPECT_GT(narrowest_rigid_corner(after), 2.0 * phi * degree);
    const double tip = area(before.mesh) - area(after.mesh);
    EXPECT_GT(tip, 0.0);
    EXPECT_LT(tip, 0.05 * area(before.mesh));
    const problem::Box box = problem::box_of({.soil = {1.0, phi * degree, 0.0}});
    const mesh::Point corner(box.width, -box.depth);
    for (const mesh::Triangle& triangle : after.mesh.triangles) {
      for (const int node : triangle.nodes) {
        EXPECT_NE(after.mesh.nodes[static_cast<std::size_t>(node)], corner);
      }
    }
    const problem::Problem again = problem::with_rigid_corners_cut(after);
    EXPECT_EQ(again.mesh.triangles.size(), after.mesh.triangles.size());
  }
}

TEST(RigidCorners, OfAWedgeAreCutUntilAllAreWide) {
  struct Wedge {
    double phi, opening;
  };
  for (const auto& [phi, opening] : {Wedge{20.0, 38.0}, {50.0, 20.0}, {60.0, 90.0}, {80.0, 60.0}}) {
    const problem::Problem after = problem::with_rigid_corners_cut(wedge(phi, opening));
    EXPECT_NO_THROW((void)mesh::edges_of(after.mesh));
    EXPECT_GT(narrowest_rigid_corner(after), 2.0 * phi * degree) << phi;
    EXPECT_LT(area(after.mesh), area(wedge(phi, opening).mesh));
    // The free side is whole.
    const auto at = [&](int i) { return after.mesh.nodes[static_cast<std::size_t>(i)]; };
    double free = 0.0;
    for (const mesh::BoundaryEdge& edge : after.mesh.boundary) {
      if (edge.boundary == 1) free += (at(edge.second) - at(edge.first)).norm();
    }
    EXPECT_NEAR(free, 2.0 * std::sin(opening / 2.0 * degree), rounding);
  }
  EXPECT_EQ(problem::with_rigid_corners_cut(wedge(20.0, 50.0)).mesh.triangles.size(), 1U);
}

certificate::UpperCertificate certified(const problem::Problem& problem,
                                        const solver::ConeSolution& found) {
  return certificate::certify_upper(problem, programme::velocity_field(problem, found.multipliers),
                                    programme::velocity_field(problem, found.interior_multipliers));
}

// By trying: of all directions, does one part from both sides of a wedge by more than the friction
// angle?
bool some_direction_leaves(double phi, double opening) {
  const double tangent = std::tan(phi * degree);
  const mesh::Point along(std::cos(opening * degree), std::sin(opening * degree));
  const auto parts = [&](const mesh::Point& velocity, const mesh::Point& side,
                         const mesh::Point& inwards) {
    return velocity.dot(inwards) > tangent * std::abs(velocity.dot(side));
  };
  for (double angle = 0.0; angle < 360.0; angle += 0.25) {
    const mesh::Point velocity(std::cos(angle * degree), std::sin(angle * degree));
    if (parts(velocity, {1, 0}, {0, 1}) && parts(velocity, along, {along.y(), -along.x()})) {
      return true;
    }
  }
  return false;
}

TEST(RigidCorners, AreCutWhereNoVelocityLeavesBothSides) {
  constexpr double room = 5.0;  // cut although some do
  for (const double phi : {10.0, 20.0, 35.0, 45.0, 50.0}) {
    for (double opening = 5.0; opening < 150.0; opening += 7.0) {
      const bool is_cut =
          problem::with_rigid_corners_cut(wedge(phi, opening)).mesh.triangles.size() > 1;
      const auto where = testing::Message() << phi << " degrees, opening " << opening;
      EXPECT_TRUE(is_cut || some_direction_leaves(phi, opening)) << where;
      EXPECT_FALSE(is_cut && some_direction_leaves(phi, opening - room)) << where;
    }
  }
}

// The least multiplier is Prandtl's.
TEST(RigidCorners, LeaveAStrictlyAdmissibleVelocityWhenCut) {
  for (const double phi : {45.0, 50.0}) {
    const problem::Problem cut = problem::with_rigid_corners_cut(strip_in_default_box(phi));
    const solver::ConeSolution found = solver::solve(programme::upper_bound_program(cut), {});
    ASSERT_EQ(found.status, solver::SolverStatus::solved) << phi;
    const certificate::UpperCertificate certificate = certified(cut, found);
    EXPECT_TRUE(certificate.holds) << phi;
    const double tangent = std::tan(phi * degree);
    const double bearing =
        std::exp(std::numbers::pi * tangent) * std::pow(std::tan((45.0 + phi / 2.0) * degree), 2);
    EXPECT_GT(certificate.multiplier * std::cos(phi * degree), (bearing - 1.0) / tangent) << phi;
  }
}

// Below 45 degrees both have a solution, and as the tip is far from where the soil flows, the same
// one but for what the smaller triangles by the cut are worth: less than all that is lost to the
// mesh, which is a tenth and more.
TEST(RigidCorners, HardlyChangeTheBoundWhenCut) {
  const problem::Problem whole = strip_in_default_box(44.0),
                         cut = problem::with_rigid_corners_cut(whole);
  ASSERT_GT(cut.mesh.triangles.size(), whole.mesh.triangles.size());
  const certificate::UpperCertificate before =
      certified(whole, solver::solve(programme::upper_bound_program(whole), {}));
  const certificate::UpperCertificate after =
      certified(cut, solver::solve(programme::upper_bound_program(cut), {}));
  ASSERT_TRUE(before.holds && after.holds);
  EXPECT_NEAR(after.multiplier / before.multiplier, 1.0, 0.1);
}

}  // namespace
