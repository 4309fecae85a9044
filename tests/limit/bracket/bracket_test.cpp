#include "limit/bracket/bracket.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "limit/problem/case.hpp"
#include "limit/programme/lower_bound.hpp"
#include "limit/programme/upper_bound.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace limit;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double pi = std::numbers::pi;

problem::Strip weightless(double phi) {
  problem::Strip strip;
  strip.soil = {1.0, phi * degree, 0.0};
  return strip;
}

/// A strip in units of order one, on a fan in the default box.
problem::Problem on_fan(const problem::Strip& strip, int rays, int rings, double grading) {
  const problem::Box box = problem::box_of(strip);
  return problem::in_units(
      problem::strip_problem(strip, mesh::even_fan(box.width, box.depth, rays, rings, grading)),
      problem::units_of(strip));
}

// Small meshes.
bracket::Bracket small_bracket(const problem::Strip& strip, int attempts = 1) {
  bracket::BracketOptions options;
  options.gap = 1e-6;
  options.max_triangles = attempts > 1 ? 170 : 1;
  return bracket::bracket(on_fan(strip, 12, 5, 1.5), on_fan(strip, 10, 6, 2.0), options);
}

// Refined until both bounds are within a gap of each other: an exact value between them is within
// that of either, and a load, a strength or an area that is off by more is found.
void expect_inside(const problem::Strip& strip, double exact) {
  bracket::BracketOptions options;
  const problem::Case problem = problem::strip_case(strip, std::nullopt);
  const bracket::Bracket found = bracket::bracket(problem, options, {});
  ASSERT_TRUE(found.lower && found.upper);
  const double stress = problem.units.stress;
  EXPECT_LT(found.lower_bound() * stress, exact);
  EXPECT_GT(found.upper_bound() * stress, exact);
  EXPECT_TRUE(found.reached);
  EXPECT_LE(found.gap(), options.gap);
}

TEST(Bracket, HoldsPrandtlsPressureOnTrescaSoil) {
  expect_inside(weightless(0), 2.0 + pi);
}

TEST(Bracket, HoldsPrandtlsPressureOnFrictionalSoil) {
  expect_inside(weightless(20), 14.834712);
}

TEST(Bracket, HoldsThePressureOfAWeightySoilBySlipLines) {
  // Method of characteristics, smooth base: 48.752 kPa for gamma b = 3992.67 Pa.
  problem::Strip strip;
  strip.soil = {2.5e3, 20 * degree, 1850.0 * 9.81};
  strip.half_width = 0.22;
  strip.rough = false;
  expect_inside(strip, 48752.0);
}

TEST(Bracket, OfSoilWithASurchargeAlone) {
  // Without cohesion and weight the pressure is q N_q, N_q = 6.399 at 20 degrees.
  problem::Strip strip;
  strip.soil = {0.0, 20 * degree, 0.0};
  strip.surcharge = 100.0;
  const double nq = std::exp(pi * std::tan(strip.soil.friction_angle)) *
                    std::pow(std::tan(pi / 4 + strip.soil.friction_angle / 2), 2);
  expect_inside(strip, 100.0 * nq);
}

TEST(Bracket, DoesNotLoosenWhenRefined) {
  const bracket::Bracket coarse = small_bracket(weightless(10));
  const bracket::Bracket fine = small_bracket(weightless(10), 2);
  ASSERT_TRUE(coarse.lower && coarse.upper && fine.lower && fine.upper);
  EXPECT_GT(fine.attempts.size(), coarse.attempts.size());
  EXPECT_GE(fine.lower_bound(), coarse.lower_bound());
  EXPECT_LE(fine.upper_bound(), coarse.upper_bound());
  for (const bracket::Attempt& attempt : fine.attempts) {
    if (!attempt.certified) continue;
    if (attempt.is_lower) {
      EXPECT_GE(fine.lower->certificate.multiplier, *attempt.certified);
    } else {
      EXPECT_LE(fine.upper->certificate.multiplier, *attempt.certified);
    }
  }
}

TEST(Bracket, DoesNotDependOnTheUnits) {
  problem::Strip strip;
  strip.soil = {2.5e3, 20 * degree, 1850.0 * 9.81};
  strip.half_width = 0.22;
  problem::Strip in_kilo = strip;  // kPa and mm
  in_kilo.soil = {2.5, 20 * degree, 1.85 * 9.81e-3};
  in_kilo.half_width = 220.0;
  const bracket::Bracket a = small_bracket(strip), b = small_bracket(in_kilo);
  // Ipopt's tolerance, 1e-8, times the condition of the answer: the same to the digits printed.
  constexpr double digits = 1e-6;
  const double ratio = problem::units_of(in_kilo).stress / problem::units_of(strip).stress * 1e3;
  EXPECT_NEAR(b.lower_bound() * ratio / a.lower_bound(), 1.0, digits);
  EXPECT_NEAR(b.upper_bound() * ratio / a.upper_bound(), 1.0, digits);
}

// Both forms' tolerances, relative: 1e-5 (the duality gap) and 1e-4 (the last barrier's).
constexpr double both = 2e-4;

TEST(Solvers, AgreeOnBothPrograms) {
  for (const double phi : {0.0, 20.0}) {
    const problem::Problem problem = on_fan(weightless(phi), 8, 4, 1.5);
    for (const bool is_lower : {true, false}) {
      const programme::ConeProgram program = is_lower ? programme::lower_bound_program(problem)
                                                      : programme::upper_bound_program(problem);
      const solver::ConeSolution own = solver::solve(program, {});
      EXPECT_EQ(own.status, solver::SolverStatus::solved);
      solver::SolverOptions ipopt;
      ipopt.form = is_lower ? solver::ConeForm::inequality : solver::ConeForm::barrier;
      const solver::ConeSolution other = solver::solve(program, ipopt);
      EXPECT_EQ(other.status, solver::SolverStatus::solved);
      const double value = program.objective.dot(other.variables);
      EXPECT_NEAR(program.objective.dot(own.variables), value, both * value);
    }
  }
}

// The mean stress of such soil has hardly any curvature. N_c = (2 + pi) (1 + phi (2 + pi) / 2 +
// ...) grows by less than 3 phi at first.
TEST(Solvers, TakeHardlyAnyFrictionAsTheyTakeNone) {
  for (const bool is_lower : {true, false}) {
    const auto value = [&](double phi) {
      const problem::Problem problem = on_fan(weightless(phi), 12, 5, 1.5);
      const programme::ConeProgram program = is_lower ? programme::lower_bound_program(problem)
                                                      : programme::upper_bound_program(problem);
      const solver::ConeSolution found = solver::solve(program, {});
      EXPECT_EQ(found.status, solver::SolverStatus::solved) << phi << ": " << found.message;
      EXPECT_LT(found.iterations, 30) << phi;
      return program.objective.dot(found.variables);
    };
    const double clay = value(0.0);
    for (const double phi : {0.01, 0.1, 0.5, 1.0}) {
      EXPECT_GT(value(phi), clay) << phi;
      EXPECT_LT(value(phi), clay * (1.0 + 3.0 * phi * degree + both)) << phi;
    }
  }
}

// Forced: no solver can do its work in so few iterations.
TEST(Solvers, EndAtTheLimitOfIterationsAndSayWhere) {
  const problem::Strip strip = weightless(20);
  const problem::Problem problem = problem::in_units(
      problem::strip_problem(strip, mesh::even_fan(4.0, 2.0, 8, 4, 1.5)), problem::units_of(strip));
  const programme::ConeProgram program = programme::lower_bound_program(problem);
  for (const solver::ConeForm form :
       {solver::ConeForm::cones, solver::ConeForm::inequality, solver::ConeForm::barrier}) {
    solver::SolverOptions options;
    options.form = form;
    options.max_iterations = 3;
    const solver::ConeSolution cut_short = solver::solve(program, options);
    EXPECT_EQ(cut_short.status, solver::SolverStatus::capped);
    EXPECT_EQ(cut_short.message, "iteration limit");
    EXPECT_LE(cut_short.iterations, 3);
  }
}

/// Works in another folder as long as it lives.
class CurrentFolder {
 public:
  explicit CurrentFolder(const std::filesystem::path& folder)
      : before_(std::filesystem::current_path()) {
    std::filesystem::current_path(folder);
  }
  CurrentFolder(const CurrentFolder&) = delete;
  CurrentFolder& operator=(const CurrentFolder&) = delete;
  ~CurrentFolder() {
    std::error_code ignored;
    std::filesystem::current_path(before_, ignored);
  }

 private:
  std::filesystem::path before_;
};

// Ipopt by itself reads `ipopt.opt` where it is started: these options would end it at once, or,
// unknown, have it refuse to begin.
TEST(Solvers, TakeNoOptionsFromTheCurrentFolder) {
  const programme::ConeProgram program =
      programme::lower_bound_program(on_fan(weightless(20), 8, 4, 1.5));
  solver::SolverOptions options;
  options.form = solver::ConeForm::inequality;
  for (const char* poison : {"max_iter 0\n", "no_such_option 1\n"}) {
    const support::TemporaryFolder folder;
    std::ofstream(folder / "ipopt.opt") << poison;
    const CurrentFolder within(folder.path());
    const solver::ConeSolution found = solver::solve(program, options);
    EXPECT_EQ(found.status, solver::SolverStatus::solved) << poison;
    EXPECT_GT(found.iterations, 5) << poison;
  }
}

TEST(Bracket, FallsBackToTheOtherSolverAndSaysWhatFailed) {
  const problem::Problem problem = on_fan(weightless(20), 8, 4, 2.0);
  bracket::BracketOptions options;
  options.max_triangles = 1;
  options.engine = bracket::Engine::ipopt;
  options.max_iterations = 25;  // enough for the cones, far from enough for the barrier's stages
  const bracket::Bracket found = bracket::bracket(problem, problem, options);
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_EQ(found.upper->attempt.form, solver::ConeForm::cones);
  EXPECT_EQ(found.upper->attempt.status, solver::SolverStatus::solved);
  const auto failed = std::find_if(
      found.attempts.begin(), found.attempts.end(), [](const bracket::Attempt& attempt) {
        return !attempt.is_lower && attempt.form == solver::ConeForm::barrier;
      });
  ASSERT_NE(failed, found.attempts.end());
  EXPECT_EQ(failed->status, solver::SolverStatus::capped);
  EXPECT_EQ(failed->message, "iteration limit");
}

TEST(Bracket, WithoutAnySolutionHasNoBoundThatIsWrong) {
  const problem::Strip strip = weightless(20);
  const problem::Problem problem = problem::in_units(
      problem::strip_problem(strip, mesh::even_fan(4.0, 2.0, 8, 4, 2.0)), problem::units_of(strip));
  for (const bracket::Engine engine : {bracket::Engine::interior_point, bracket::Engine::ipopt}) {
    bracket::BracketOptions options;
    options.max_triangles = 1;
    options.max_iterations = 2;
    options.engine = engine;
    const bracket::Bracket found = bracket::bracket(problem, problem, options);
    EXPECT_FALSE(found.reached);
    EXPECT_EQ(found.attempts.size(), 6U);  // four forms of the lower bound, two of the upper
    for (const bracket::Attempt& attempt : found.attempts)
      EXPECT_NE(attempt.status, solver::SolverStatus::solved);
    const double stress = problem::units_of(strip).stress;
    if (found.lower) {
      EXPECT_LT(found.lower_bound() * stress, 14.834712);
    }
    if (found.upper) {
      EXPECT_GT(found.upper_bound() * stress, 14.834712);
    }
  }
}

TEST(LowerCertificate, DrawsAFieldBeyondYieldInwards) {
  const problem::Problem problem = on_fan(weightless(20), 8, 3, 1.5);
  const programme::ConeProgram program = programme::lower_bound_program(problem);
  const solver::ConeSolution solution = solver::solve(program, {});
  problem::StressField field = programme::stress_field(problem, solution.variables);
  const double multiplier = solution.variables[solution.variables.size() - 1];
  const certificate::LowerCertificate honest =
      certificate::certify_lower(problem, field, multiplier);
  EXPECT_TRUE(honest.holds);
  // Twice the optimum is in equilibrium with twice the load, and beyond yield.
  for (auto& stress : field) stress *= 2.0;
  const certificate::LowerCertificate greedy =
      certificate::certify_lower(problem, field, 2.0 * multiplier);
  EXPECT_TRUE(greedy.holds);
  EXPECT_GT(greedy.yield_excess, 0.0);
  EXPECT_LT(greedy.kept, 1.0);
  // The field proposed was this close to the optimum: the solver's gap and the strength unused.
  constexpr double close = 1e-5 + 2e-6;
  EXPECT_LE(greedy.multiplier, honest.multiplier * (1.0 + close));
}

TEST(LowerCertificate, RestoresEquilibriumThatIsLost) {
  const problem::Strip strip = weightless(0);
  const problem::Problem problem =
      problem::strip_problem(strip, mesh::even_fan(3.0, 1.5, 8, 3, 1.5));
  const problem::StressField nothing(problem.mesh.triangles.size(), Eigen::Matrix3d::Zero());
  const certificate::LowerCertificate found = certificate::certify_lower(problem, nothing, 1.0);
  // A multiplier of 1 = c is well below collapse: the nearest equilibrium may or may not be
  // admissible, but drawn towards rest it must be, and in equilibrium.
  EXPECT_TRUE(found.holds);
  EXPECT_LT(found.residual, 1e-12);
  EXPECT_LE(found.multiplier, 1.0);
}

// Nothing in this collapse pulls at the base: the same bounds but for twice the solver's gap.
TEST(Bracket, OfACentricLoadDoesNotNeedTensionAtTheBase) {
  for (const double phi : {0.0, 20.0}) {
    problem::Strip strip = weightless(phi);
    const bracket::Bracket bonded = small_bracket(strip);
    strip.tension = false;
    const bracket::Bracket lifting = small_bracket(strip);
    ASSERT_TRUE(bonded.lower && bonded.upper && lifting.lower && lifting.upper);
    constexpr double close = 2e-5;
    EXPECT_NEAR(lifting.lower_bound() / bonded.lower_bound(), 1.0, close);
    EXPECT_NEAR(lifting.upper_bound() / bonded.upper_bound(), 1.0, close);
  }
}

TEST(LowerCertificate, RefusesTensionUnderAFootingThatMayLiftOff) {
  problem::Strip strip = weightless(0);
  strip.surcharge = 1.0;
  problem::Problem problem = on_fan(strip, 8, 3, 1.5);
  // Ground at rest under the surcharge, and under as much suction.
  const problem::StressField rest(problem.mesh.triangles.size(),
                                  Eigen::Vector3d(-1.0, -1.0, 0.0).replicate<1, 3>());
  problem::StressField pulled = rest;
  for (auto& stress : pulled) stress *= -1.0;
  for (const bool may_open : {false, true}) {
    problem.boundaries[0].may_open = may_open;
    problem.boundaries[1].normal_stress = -1.0;
    EXPECT_TRUE(certificate::certify_lower(problem, rest, 1.0).holds);
    problem.boundaries[1].normal_stress = 1.0;
    const certificate::LowerCertificate found = certificate::certify_lower(problem, pulled, -1.0);
    EXPECT_EQ(found.holds, !may_open);
    EXPECT_NEAR(found.yield_excess, may_open ? 1.0 : -1.0, 1e-12);
  }
}

// Nothing moves but the footing, which slides by one and rises: over a base of length one, the
// power of a traction that yields is c cot(phi) times the rise, or c times the slip, if the base
// bears no tension; no mechanism if it rises by less than tan(phi) times the slip.
TEST(UpperCertificate, ABaseThatMayOpenDissipatesItsSlipAlone) {
  for (const double phi : {0.0, 20.0}) {
    for (const bool rough : {true, false}) {
      problem::Strip strip = weightless(phi);
      strip.rough = rough;
      problem::Problem problem = problem::strip_problem(strip, mesh::even_fan(3.0, 1.5, 8, 3, 1.5));
      problem.footing.may_move = {true, true, false};
      problem.footing.live_load = {1.0, 0.0, 0.0};
      problem::VelocityField field;
      field.triangles.assign(problem.mesh.triangles.size(), Eigen::Matrix<double, 2, 6>::Zero());
      field.footing = {1.0, 0.5, 0.0};  // 0.5 > tan(20)
      problem.boundaries[0].may_open = true;
      const certificate::UpperCertificate opening =
          certificate::certify_upper(problem, field, field);
      EXPECT_TRUE(opening.holds);
      EXPECT_NEAR(opening.dissipation, rough ? 1.0 : 0.0, 1e-12);
      problem.boundaries[0].may_open = false;
      const certificate::UpperCertificate bonded =
          certificate::certify_upper(problem, field, field);
      if (phi > 0.0) {
        EXPECT_TRUE(bonded.holds);
        EXPECT_NEAR(bonded.dissipation, 0.5 / std::tan(phi * degree), 1e-12);
      }
      problem.boundaries[0].may_open = true;
      problem::VelocityField sinking = field;
      sinking.footing = {1.0, rough ? std::tan(phi * degree) - 0.1 : -0.1, 0.0};
      EXPECT_FALSE(certificate::certify_upper(problem, sinking, sinking).holds);
      const certificate::UpperCertificate repaired =
          certificate::certify_upper(problem, sinking, field);
      EXPECT_TRUE(repaired.holds);
      EXPECT_NEAR(repaired.violation, 0.1, 1e-12);
      EXPECT_LT(repaired.kept, 1.0);
    }
  }
}

TEST(UpperCertificate, RepairsAFieldThatContracts) {
  const problem::Strip strip = weightless(20);
  const problem::Problem problem = on_fan(strip, 8, 4, 2.0);
  solver::SolverOptions options;
  options.form = solver::ConeForm::barrier;
  const solver::ConeSolution solution =
      solver::solve(programme::upper_bound_program(problem), options);
  problem::VelocityField field = programme::velocity_field(problem, solution.multipliers);
  const problem::VelocityField inner =
      programme::velocity_field(problem, solution.interior_multipliers);
  const certificate::UpperCertificate honest = certificate::certify_upper(problem, field, inner);
  EXPECT_TRUE(honest.holds);
  EXPECT_EQ(honest.kept, 1.0);
  // Some thousandths of a velocity, everywhere, in turn.
  for (std::size_t t = 0; t < field.triangles.size(); ++t) {
    field.triangles[t].col(static_cast<Eigen::Index>(t % 6)).array() += 1e-3;
  }
  const certificate::UpperCertificate repaired = certificate::certify_upper(problem, field, inner);
  EXPECT_GT(repaired.violation, 0.0);
  if (repaired.holds) {
    EXPECT_LT(repaired.kept, 1.0);
    EXPECT_GE(repaired.multiplier * problem::units_of(strip).stress, 14.834712);
  }
}

}  // namespace
