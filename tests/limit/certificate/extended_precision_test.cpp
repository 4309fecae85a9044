// The bounds of small problems proved again in 50 digits: nothing of limit's assembly and
// certificates is used but their fields.
#include <gmock/gmock.h>

#include <numbers>
#include <set>
#include <utility>

#include "limit/bracket/bracket.hpp"
#include "limit/certificate/exact_equations.hpp"
#include "limit/problem/strip.hpp"

namespace {

using namespace limit;
using namespace exact_equations;

// A strip's half, and all of it, with the left half mirrored.
problem::Problem half_strip(const problem::Soil& soil, double surcharge, bool rough,
                            const problem::Box& box = {4.0, 2.0}) {
  problem::Strip strip;
  strip.soil = soil;
  strip.surcharge = surcharge;
  strip.rough = rough;
  return problem::strip_problem(strip, mesh::even_fan(box.width, box.depth, 9, 4, 1.5));
}

problem::Problem whole_strip(const problem::Soil& soil, bool rough) {
  problem::Problem problem = half_strip(soil, 0.0, rough);
  mesh::Mesh& mesh = problem.mesh;
  const std::vector<mesh::Triangle> triangles = mesh.triangles;
  std::vector<mesh::BoundaryEdge> outline;
  std::vector<int> mirrored;
  const std::size_t nodes = mesh.nodes.size();
  for (std::size_t i = 0; i < nodes; ++i) {
    const mesh::Point at = mesh.nodes[i];
    mirrored.push_back(static_cast<int>(at.x() == 0.0 ? i : mesh.nodes.size()));
    if (at.x() != 0.0) mesh.nodes.emplace_back(-at.x(), at.y());
  }
  const auto image = [&](int i) { return mirrored[static_cast<std::size_t>(i)]; };
  for (const mesh::Triangle& t : triangles) {
    mesh.triangles.push_back({{image(t.nodes[2]), image(t.nodes[1]), image(t.nodes[0])}, t.region});
  }
  for (const mesh::BoundaryEdge& edge : mesh.boundary) {
    if (edge.boundary == static_cast<int>(mesh::FanBoundary::axis)) continue;
    outline.push_back(edge);
    outline.push_back({image(edge.second), image(edge.first), edge.boundary});
  }
  mesh.boundary = outline;
  problem.footing.may_move = {true, true, true};
  return problem;
}

problem::Problem tresca_strip() {
  return half_strip({1.0, 0.0, 1.0}, 0.0, true);
}
problem::Problem rough_strip() {
  return half_strip({1.0, std::numbers::pi / 9, 2.0}, 0.0, true);
}
problem::Problem smooth_strip() {
  return half_strip({1.0, std::numbers::pi / 6, 0.0}, 0.5, false);
}
// In a box whose corner is cut.
problem::Problem steep_strip() {
  return half_strip({1.0, std::numbers::pi / 3.6, 0.5}, 0.2, true, {12.0, 4.0});
}
problem::Problem flexible_strip() {
  problem::Problem problem = half_strip({1.0, std::numbers::pi / 18, 0.0}, 0.0, false);
  problem.boundaries[0] = {"base", problem::Known::traction, problem::Known::traction};
  problem.boundaries[0].live_normal_stress = -1.0;
  problem.footing.may_move = {false, false, false};
  return problem;
}
// Inclined and eccentric; the moment is about a centre that is not the origin.
problem::Problem inclined_strip() {
  problem::Problem problem = whole_strip({1.0, 0.0, 0.0}, true);
  problem.footing.centre = {0.25, 0.5};
  const double horizontal = 0.3, vertical = -2.0, at = 0.2;  // through (at, 0)
  problem.footing.live_load = {horizontal, vertical, (at - 0.25) * vertical + 0.5 * horizontal};
  return problem;
}
// A bank of frictional soil whose weight grows, and a shear on a part of its crest; the surcharge
// does not.
problem::Problem growing_weight() {
  problem::Problem problem = half_strip({1.0, std::numbers::pi / 9, 0.2}, 0.0, false);
  problem.soils[0].live_unit_weight = 1.0;
  // The axis becomes the free face.
  for (const mesh::FanBoundary free :
       {mesh::FanBoundary::base, mesh::FanBoundary::surface, mesh::FanBoundary::axis}) {
    problem::Boundary& boundary = problem.boundaries[static_cast<std::size_t>(free)];
    boundary = {boundary.name};
  }
  problem.boundaries[0].normal_stress = -0.1;
  problem.boundaries[1].normal_stress = -0.1;
  problem.boundaries[1].live_shear_stress = 0.1;
  problem.footing = {};
  return problem;
}

// 0.4 beside the middle of a base of width 2; the footing may lift off.
problem::Problem lifting(const problem::Soil& soil, bool rough) {
  problem::Problem problem = whole_strip(soil, rough);
  problem.boundaries[0].may_open = true;
  problem.footing.live_load = {0.0, -2.0, -0.8};
  return problem;
}
problem::Problem lifting_tresca() {
  return lifting({1.0, 0.0, 0.0}, true);
}
problem::Problem lifting_rough() {
  return lifting({1.0, std::numbers::pi / 9, 0.0}, true);
}
problem::Problem lifting_smooth() {
  return lifting({1.0, std::numbers::pi / 18, 0.5}, false);
}

// Sand under its own weight, at whose surface nothing presses.
problem::Problem loose_strip() {
  return half_strip({0.0, std::numbers::pi / 6, 1.0}, 0.0, true);
}

// First components of the stresses of corners at the free surface where soil without cohesion has
// none: they are nothing, and there no less would yield.
std::set<std::size_t> bare_corners(const problem::Problem& problem,
                                   const std::vector<Real>& stress) {
  std::set<std::size_t> bare;
  if (problem.soils[0].cohesion > 0.0) return bare;
  for (std::size_t at = 0; at < stress.size(); at += 3) {
    const auto& nodes = problem.mesh.triangles[at / 9].nodes;
    const mesh::Point& place = problem.mesh.nodes[static_cast<std::size_t>(nodes[at % 9 / 3])];
    if (place.y() != 0.0 || place.x() < 1.0) continue;
    bare.insert(at);
    for (std::size_t i = at; i < at + 3; ++i) EXPECT_LT(abs(stress[i]), 1e-12);
  }
  return bare;
}

struct CaseOf {
  const char* name;
  problem::Problem (*problem)();
};

class ExtendedPrecision : public ::testing::TestWithParam<CaseOf> {
 protected:
  static bracket::Bracket solved() {
    bracket::BracketOptions options;
    options.max_triangles = 1;
    return bracket::bracket(GetParam().problem(), GetParam().problem(), options);
  }
};

TEST_P(ExtendedPrecision, AStressFieldBalancesTheLowerBoundNowhereBeyondYield) {
  const bracket::Bracket found = solved();
  ASSERT_TRUE(found.lower);
  problem::Problem problem = GetParam().problem();
  problem.mesh = found.lower->mesh;
  std::vector<Real> stress;
  for (const auto& corners : found.lower->certificate.field) {
    for (const double component : corners.reshaped()) stress.emplace_back(component);
  }
  const Real bound(found.lower_bound());
  std::vector<Row> rows = equilibrium(problem, bound);
  const Strength soil = strength_of(problem);
  const std::set<std::size_t> bare = bare_corners(problem, stress);
  EXPECT_EQ(bare.empty(), soil.cohesion > 0);
  for (const std::size_t at : bare) {
    for (std::size_t i = at; i < at + 3; ++i) rows.push_back({{{i, Real(1)}}, Real(0)});
  }
  ASSERT_LT(satisfy_exactly(std::move(rows), stress), exact);
  for (std::size_t at = 0; at < stress.size(); at += 3) {
    if (bare.contains(at)) continue;
    const Real mean = (stress[at] + stress[at + 1]) / 2, half = (stress[at] - stress[at + 1]) / 2;
    const Real strength = soil.cohesion * soil.cosine - mean * soil.sine;
    ASSERT_GE(strength, 0);
    ASSERT_LE(half * half + stress[at + 2] * stress[at + 2], strength * strength);
  }
  for (const Row& contact : contacts(problem)) ASSERT_LE(value(contact, stress), 0);
}

TEST_P(ExtendedPrecision, AMechanismFailsUnderTheUpperBound) {
  const bracket::Bracket found = solved();
  ASSERT_TRUE(found.upper);
  problem::Problem problem = GetParam().problem();
  problem.mesh = found.upper->mesh;
  std::vector<Real> velocity;
  for (const auto& triangle : found.upper->certificate.field.triangles) {
    for (const double component : triangle.reshaped()) velocity.emplace_back(component);
  }
  for (const double motion : found.upper->certificate.field.footing) velocity.emplace_back(motion);
  const std::vector<Flow> points = flows(problem);
  const Strength soil = strength_of(problem);
  if (soil.sine == 0) {
    std::vector<Row> still;
    for (const Flow& flow : points) {
      if (!flow.opens) still.push_back(flow.dilation);
    }
    ASSERT_LT(satisfy_exactly(still, velocity), exact);
  }
  Real dissipation = 0;
  for (const Flow& flow : points) {
    const Real dilation = value(flow.dilation, velocity);
    const Real first = value(flow.shear[0], velocity), second = value(flow.shear[1], velocity);
    const Real shear = sqrt(first * first + second * second);
    if (soil.sine > 0 || flow.opens) {
      ASSERT_GE(dilation, flow.ratio * shear);
    }
    if (soil.sine > 0 && !flow.opens) {
      dissipation += flow.weight * soil.cohesion * soil.cosine / soil.sine * dilation;
    } else {
      dissipation += flow.weight * soil.cohesion * shear;
    }
  }
  const Power loads = power_of_loads(problem, velocity);
  ASSERT_GT(loads.live, 0);
  EXPECT_LE((dissipation - loads.dead) / loads.live, Real(found.upper_bound()));
}

INSTANTIATE_TEST_SUITE_P(
    Problems, ExtendedPrecision,
    ::testing::Values(CaseOf{"tresca", tresca_strip}, CaseOf{"rough", rough_strip},
                      CaseOf{"smooth", smooth_strip}, CaseOf{"steep", steep_strip},
                      CaseOf{"flexible", flexible_strip}, CaseOf{"inclined", inclined_strip},
                      CaseOf{"growing_weight", growing_weight}, CaseOf{"loose", loose_strip}),
    [](const auto& info) { return std::string(info.param.name); });

INSTANTIATE_TEST_SUITE_P(LiftingOff, ExtendedPrecision,
                         ::testing::Values(CaseOf{"tresca", lifting_tresca},
                                           CaseOf{"rough", lifting_rough},
                                           CaseOf{"smooth", lifting_smooth}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
