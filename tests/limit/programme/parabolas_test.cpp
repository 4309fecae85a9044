// Parabolas that stand for curved envelopes: where they touch, how far they are within, and where a
// programme first has them touch.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "limit/bracket/side.hpp"
#include "limit/programme/lower_bound.hpp"
#include "limit/programme/parabola_cones.hpp"
#include "limit/programme/parabolas.hpp"

namespace {

using namespace limit;
using problem::Envelope;

// What a parabola is below an envelope where the distance from the apex is a quarter off: for
// exponents up to 1 at most 0.22 %, measured.
constexpr double quarter_off = 0.004;

double radius_of(const programme::Parabola& parabola, double p) {
  const double whole = parabola.touching + parabola.shift;
  const double square = whole * whole + 2.0 * whole * parabola.sine * (p - parabola.centre);
  return std::sqrt(std::max(0.0, square)) - parabola.shift;
}

problem::Soil curved_soil(Envelope envelope, double factor) {
  problem::Soil soil;
  soil.envelope = envelope;
  soil.envelope.factor = factor;
  return soil;
}

// Power laws from the least exponent to one next to a straight line, and rock from rubble to
// intact.
std::vector<Envelope> envelopes() {
  std::vector<Envelope> all;
  for (const double exponent : {0.5, 0.7, 0.8, 0.95}) {
    all.push_back({Envelope::Kind::power_law, 500e3, 0.8, exponent, 0.2});
  }
  for (const double gsi : {10.0, 45.0, 100.0}) {
    all.push_back(problem::hoek_brown(20e6, 10.0, gsi, 0.2));
  }
  return all;
}

// The lower bound's parabola has the envelope's radius and slope in one place, and nowhere a larger
// radius, from the apex on.
TEST(Parabolas, TouchTheEnvelopeFromWithin) {
  const programme::Parabolas nothing_known;
  for (const Envelope& envelope : envelopes()) {
    for (const double factor : {1.0, 1.6}) {
      const problem::Soil soil = curved_soil(envelope, factor);
      const double apex = envelope.apex();
      for (double reach = 1e-6; reach < 1e5; reach *= 4.0) {
        const auto within = nothing_known.at(soil, {}, reach * apex - apex, problem::Bound::lower);
        const double centre = within.centre;
        // A hundredth of the reserve of the lower bound's cones; rounding beside an apex is less.
        const double most = 1e-8 * within.touching;
        EXPECT_NEAR(radius_of(within, centre), soil.envelope.radius_about(centre), most);
        for (double away = 1e-6; away < 1e3; away *= 1.1) {
          const double p = (centre + apex) * away - apex;
          const double exact = soil.envelope.radius_about(p);
          EXPECT_LE(radius_of(within, p), exact + most)
              << envelope.exponent << ' ' << factor << ' ' << reach << ' ' << away;
          // Where circles touch the apex itself their radii are on a line to it.
          const bool is_at_apex = exact > (p + apex) * (1.0 - 1e-9);
          if (is_at_apex || reach < 0.1 || away < 0.8 || away > 1.25) continue;
          EXPECT_GE(radius_of(within, p), exact * (1.0 - quarter_off)) << factor << ' ' << away;
        }
      }
    }
  }
}

// The upper bound's has its curvature, too.
TEST(Parabolas, TouchTheEnvelopeClosely) {
  const programme::Parabolas nothing_known;
  for (const Envelope& envelope : envelopes()) {
    for (const double factor : {1.0, 1.6}) {
      const problem::Soil soil = curved_soil(envelope, factor);
      const double apex = envelope.apex();
      for (const double centre : {0.2e6, 1e6, 8e6}) {
        const auto close = nothing_known.at(soil, {}, centre, problem::Bound::upper);
        for (double away = 0.8; away < 1.25; away *= 1.02) {
          const double p = (centre + apex) * away - apex;
          const double exact = soil.envelope.radius_about(p);
          // Of third order; 1.7e-4 at most, where the logarithm's cube is 0.011.
          constexpr double third_order = 5e-4;
          EXPECT_NEAR(radius_of(close, p), exact, third_order * exact);
        }
      }
    }
  }
}

// All cones have room where a solve begins, however little strength there is beside the unit.
TEST(Parabolas, BeginStrictlyWithinTheirCones) {
  const programme::Parabolas nothing_known;
  for (const Envelope& envelope : envelopes()) {
    for (const double reach : {1e-9, 1e-5, 1.0, 1e4}) {
      problem::Soil soil = curved_soil(envelope, 1.0);
      soil.envelope.stress = 1e-6;  // of a unit of 1
      const double apex = soil.envelope.apex();
      constexpr double reserve = 1e-6;
      std::vector<programme::YieldCone> cones;
      std::vector<Eigen::Vector3d> starts;
      programme::ParabolaCones curves(cones, starts);
      curves.add(soil.envelope,
                 nothing_known.at(soil, {}, reach * apex - apex, problem::Bound::lower), {},
                 reserve);
      curves.add_others();
      ASSERT_EQ(cones.size(), 3U);
      for (std::size_t k = 0; k < cones.size(); ++k) {
        const double room = cones[k].strength - cones[k].slope * starts[k][0];
        EXPECT_GT(room, std::hypot(starts[k][1], starts[k][2])) << envelope.exponent << reach << k;
      }
      // The radius is less than that of the parabola there.
      EXPECT_LT(-starts[1][0], soil.envelope.radius_about(-starts[0][0]) * (1.0 - 2.0 * reserve));
    }
  }
}

// A power law's ground of few triangles, one stress its apex' tension: lengths 1, on a smooth floor
// and between smooth walls but for its face, if it is to be free.
problem::Problem small_ground(int columns, int rows, bool has_face) {
  problem::Problem problem;
  const int across = columns + 1;
  for (int k = 0; k <= rows; ++k) {
    for (int i = 0; i <= columns; ++i) problem.mesh.nodes.emplace_back(i, k);
  }
  for (int k = 0; k < rows; ++k) {
    for (int i = 0; i < columns; ++i) {
      const int low = k * across + i, high = low + across;
      problem.mesh.triangles.push_back({{low, low + 1, high + 1}, 0});
      problem.mesh.triangles.push_back({{low, high + 1, high}, 0});
    }
  }
  for (int i = 0; i < columns; ++i) {
    const int above = rows * across + i;
    problem.mesh.boundary.push_back({i, i + 1, 1});
    const int on_top = i == 0 ? 2 : i == columns - 1 ? 3 : 0;
    problem.mesh.boundary.push_back({above + 1, above, on_top});
  }
  for (int k = 0; k < rows; ++k) {
    const int left = k * across, right = left + columns;
    problem.mesh.boundary.push_back({left + across, left, 1});
    problem.mesh.boundary.push_back({right, right + across, has_face ? 0 : 1});
  }
  problem.soils = {curved_soil({Envelope::Kind::power_law, 5.0, 0.8, 0.8, 0.2}, 1.0)};
  problem.soils[0].cohesion = 1.0;
  problem.soils[0].friction_angle = 0.5;
  problem.boundaries = {
      {"surface"}, {"wall", problem::Known::support}, {"left of the top"}, {"right of the top"}};
  return problem;
}

// Pressed by its own weight, which is guessed to be what a cut as high would bear.
problem::Problem small_pillar() {
  problem::Problem pillar = small_ground(2, 4, true);
  pillar.soils[0].live_unit_weight = 1.0;
  return pillar;
}

bracket::Bracket lower_alone(const problem::Problem& problem, const bracket::Means& means = {}) {
  bracket::Bracket found;
  bracket::Side side(problem, true, means);
  bracket::BracketOptions options;
  options.fall_back = false;
  side.attempt(found, options, {});
  return found;
}

// Parabolas that touch where pressures are guessed bear nothing at some lower one: faces need some
// that bear half the unconfined strength, whatever presses beside them.
TEST(Parabolas, LeaveAFreeFaceItsStressWhateverIsGuessedBesideIt) {
  const problem::Problem pillar = small_pillar();
  const double unconfined = pillar.soils[0].envelope.unconfined();
  const bracket::Bracket weight = lower_alone(pillar);
  ASSERT_TRUE(weight.lower);
  // Columns by themselves bear that at their feet, and linear stresses no more.
  EXPECT_NEAR(weight.lower_bound(), unconfined / 4.0, 0.01 * unconfined / 4.0);
  // A strip between walls, free ground, and five times the apex' tension heaped up beside.
  problem::Problem strip = small_ground(6, 3, false);
  strip.boundaries[2].live_normal_stress = -1.0;
  strip.boundaries[3].normal_stress = -5.0;
  const bracket::Bracket heap = lower_alone(strip);
  ASSERT_TRUE(heap.lower);
  EXPECT_GT(heap.lower_bound(), unconfined);
}

// At a face the weight above and what is heaped up elsewhere are no pressure.
TEST(Parabolas, AreGuessedAtAFaceAsItsTractionSays) {
  problem::Problem pillar = small_ground(2, 4, true);
  pillar.soils[0].unit_weight = 1.0;
  pillar.boundaries[1].normal_stress = -5.0;  // held, but a guess elsewhere counts it
  const double least = pillar.soils[0].envelope.unconfined() / 2.0;
  const programme::ConeProgram program = programme::lower_bound_program(pillar);
  ASSERT_EQ(program.curved.size(), 48U);
  for (const programme::CurvedPoint& point : program.curved) {
    // A tenth of the way from a corner to the middle of its triangle.
    const bool is_given = point.place.x() > 1.9 || point.place.y() > 3.9;
    const double guess = -program.start[point.variable] - least;
    if (is_given) {
      EXPECT_NEAR(guess, 0.0, 1e-9) << point.place.transpose();
    } else {
      EXPECT_NEAR(guess, 5.0 + 4.0 - std::round(point.place.y()), 1e-9) << point.place.transpose();
    }
  }
}

// A first programme that comes to nothing is asked once more, with the pressures of a free face.
TEST(Parabolas, AreGuessedAgainWhereAllFails) {
  const problem::Problem pillar = small_pillar();
  std::vector<double> guesses;  // the largest of each programme
  bracket::Means means;
  means.solve = [&](const programme::ConeProgram& program, const solver::SolverOptions& options) {
    double most = 0.0;
    for (const programme::CurvedPoint& point : program.curved) {
      most = std::max(most, -program.start[point.variable]);
    }
    guesses.push_back(most);
    if (guesses.size() > 1) return solver::solve(program, options);
    solver::ConeSolution none;
    none.variables = Eigen::VectorXd::Constant(program.start.size(), NAN);
    none.multipliers = Eigen::VectorXd::Constant(program.right_side.size(), NAN);
    return none;
  };
  const bracket::Bracket found = lower_alone(pillar, means);
  ASSERT_EQ(guesses.size(), 3U);
  const double least = pillar.soils[0].envelope.unconfined() / 2.0;
  EXPECT_GT(guesses[0], 1.1 * least);
  EXPECT_NEAR(guesses[1], least, 1e-9 * least);
  EXPECT_TRUE(found.lower);
}

}  // namespace
