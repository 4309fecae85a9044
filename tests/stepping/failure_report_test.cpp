#include "stepping/failure_report.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "scene/scene.hpp"
#include "small_footing.hpp"
#include "stepping/corrected_load.hpp"

namespace stepping {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// A step that was given up for a reason, as the stepper leaves it.
StepResult given_up(jfnk::Status status, StepOutcome outcome = StepOutcome::minimum_increment) {
  StepResult result;
  result.outcome = outcome;
  result.status = status;
  result.reason = "the solver's words";
  return result;
}

std::string report_of(const SmallFooting& run, const StepResult& result) {
  return failure_report(run.scene, run.model, run.state, result);
}

TEST(FailureReport, SaysWhatEndedTheRunAndInWhichWords) {
  SmallFooting run;
  run.state.programme.load = 0.25;
  EXPECT_THAT(report_of(run, given_up(jfnk::Status::stagnated)),
              ::testing::StartsWith(
                  "no convergence at the smallest increment after load 0.25: the solver's words."));
  StepResult result = given_up(jfnk::Status::stagnated, StepOutcome::hopeless);
  result.attempts = 128;
  result.patience_mark = 0.125;
  EXPECT_THAT(report_of(run, result),
              ::testing::StartsWith(
                  "no hope after load 0.25: 128 attempts at a step since load 0.125 have not "
                  "gained one nominal step (programme.patience): the solver's words."));
}

TEST(FailureReport, NamesWhatLimitsEachKindOfFailure) {
  const SmallFooting run;
  const std::vector<std::pair<jfnk::Status, std::string>> limits{
      {jfnk::Status::evaluation_limit, "the evaluations of a step"},
      {jfnk::Status::line_search_failed, "the line search: no length of the Newton step"},
      {jfnk::Status::krylov_stalled, "the Krylov solver: it finds no direction"},
      {jfnk::Status::linearisation_failed, "the stress update: it has no tangent"},
      {jfnk::Status::out_of_domain_at_start, "the predictor: it cannot be evaluated"},
      {jfnk::Status::max_iterations, "the nonlinear iteration: the residual falls too slowly"},
      {jfnk::Status::stagnated, "the nonlinear iteration: the residual falls too slowly"}};
  for (const auto& [status, words] : limits) {
    EXPECT_THAT(report_of(run, given_up(status)), HasSubstr("\n  limits: " + words));
  }
}

// Whatever the solver says of it: the fold is why.
TEST(FailureReport, OfAFoldedParticleNamesItAndItsPlace) {
  const SmallFooting run;
  for (const auto status : {jfnk::Status::line_search_failed, jfnk::Status::evaluation_limit}) {
    StepResult result = given_up(status);
    result.folded_particle = 5;
    const std::string report = report_of(run, result);
    EXPECT_THAT(report, HasSubstr("limits: a folded particle: the neighbourhood of particle 5 "
                                  "turns inside out"));
    // The lattice is numbered along x first or y first; its cells are 0.25 m wide either way.
    const Eigen::RowVector2d x = run.model.particles.position.row(5);
    EXPECT_THAT(report, HasSubstr(fmt::format("folded: particle 5, now at ({:.6g}, {:.6g}) m", x[0],
                                              x[1])));
  }
}

TEST(FailureReport, OfAPlateWithoutBalanceSaysSo) {
  const SmallFooting run;
  StepResult result = given_up(jfnk::Status::line_search_failed);
  result.unbalanced_plate = true;
  EXPECT_THAT(report_of(run, result),
              HasSubstr("limits: the plate: no motion of it is in balance with its load"));
}

TEST(FailureReport, SaysThatTheBodyGivesWayWhereItsTangentShowsIt) {
  const SmallFooting run;
  StepResult result = given_up(jfnk::Status::krylov_stalled);
  for (const auto trouble : {jfnk::Trouble::singular, jfnk::Trouble::flat}) {
    result.trouble = trouble;
    EXPECT_THAT(report_of(run, result), HasSubstr("limits: the tangent: the body, or a part of "
                                                  "it, gives way without resistance"));
  }
}

TEST(FailureReport, PutsWhatIsLikelyBeforeItsAdvice) {
  const SmallFooting run({"material.0.poissons_ratio=0.4999", "solver.preconditioner=two_level"});
  const std::string report = report_of(run, given_up(jfnk::Status::krylov_stalled));
  EXPECT_THAT(report, HasSubstr("\n  likely: material.0.poissons_ratio = 0.4999: next to 0.5"));
  EXPECT_THAT(report, HasSubstr("\n  advice: if that is not it, resume with"));
}

TEST(FailureReport, NamesTheThreeParticlesThatHoldMostOfTheResidual) {
  SmallFooting run;
  const Eigen::Index n = run.model.size();
  StepResult result = given_up(jfnk::Status::stagnated);
  result.residual = Eigen::VectorXd::Zero(2 * n);
  // Squares 64, 25, 9 and 2, together 100.
  result.residual[7] = 8.0;
  result.residual[n + 11] = 5.0;
  result.residual[40] = -3.0;
  result.residual[12] = result.residual[n + 12] = 1.0;
  run.state.displacement(7, 1) = 0.5;
  run.state.plastic_strain[7] = 0.25;
  run.state.plastic_strain_at_search[7] = 0.125;
  run.state.plastic_increment[7] = 1e-3;
  const std::string report = report_of(run, result);
  EXPECT_THAT(report,
              HasSubstr(fmt::format(
                  "64 % of the residual (squared): particle 7, now at ({:.6g}, {:.6g}) m "
                  "(yields, plastic strain 0.25, 0.125 of it since its last search, volume "
                  "ratio 1)",
                  run.model.particles.position(7, 0), run.model.particles.position(7, 1) + 0.5)));
  EXPECT_THAT(report, HasSubstr("25 % of the residual (squared): particle 11,"));
  EXPECT_THAT(report, HasSubstr("9 % of the residual (squared): particle 40,"));
  EXPECT_THAT(report, HasSubstr("(does not yield, plastic strain 0, 0 of it"));
  EXPECT_THAT(report, Not(HasSubstr("particle 12,")));
}

TEST(FailureReport, NamesNoParticleIfNoneHoldsAnyOfTheResidual) {
  const SmallFooting run;
  StepResult result = given_up(jfnk::Status::stagnated);
  result.residual = Eigen::VectorXd::Zero(run.model.unknowns());
  EXPECT_THAT(report_of(run, result), Not(HasSubstr("particle")));
}

TEST(FailureReport, SaysOfAnElasticBodyOfSmallStrainsNothingOfYieldNorVolume) {
  SmallFooting run({"material.0.model=elastic", "approximation.kinematics=small_strain"});
  StepResult result = given_up(jfnk::Status::stagnated);
  result.residual = Eigen::VectorXd::Ones(run.model.unknowns());
  EXPECT_THAT(report_of(run, result), Not(HasSubstr("yield")));
  EXPECT_THAT(report_of(run, result), Not(HasSubstr("volume")));
}

// Each advice comes before those below it.
TEST(FailureReport, AdvisesReSearchWhereNeighbourhoodsAreStrained) {
  SmallFooting run({"re_search.trigger=0.1"});
  run.state.plastic_strain[3] = 0.11;
  const auto result = given_up(jfnk::Status::evaluation_limit);
  EXPECT_THAT(report_of(run, result),
              HasSubstr("advice: neighbourhoods are strained beyond re_search.trigger: resume with "
                        "--set re_search.enabled=true"));
  run.state.plastic_strain_at_search[3] = 0.05;
  EXPECT_THAT(report_of(run, result), Not(HasSubstr("re_search")));
}

TEST(FailureReport, AdvisesAnEarlierReSearchWhereItIsOnAndAParticleFolds) {
  const SmallFooting run({"re_search.enabled=true", "re_search.trigger=0.1"});
  auto result = given_up(jfnk::Status::evaluation_limit);
  EXPECT_THAT(report_of(run, result), Not(HasSubstr("re_search")));
  result.folded_particle = 0;
  EXPECT_THAT(report_of(run, result),
              HasSubstr("advice: search anew earlier: resume with --set re_search.trigger=0.05."));
}

TEST(FailureReport, AdvisesFourTimesTheEvaluationsWhereTheyEnd) {
  const SmallFooting run({"solver.max_evaluations_per_step=50"});
  EXPECT_THAT(report_of(run, given_up(jfnk::Status::evaluation_limit)),
              HasSubstr("advice: resume with --set solver.max_evaluations_per_step=200."));
}

TEST(FailureReport, AdvisesALoadDriveToDriveADisplacement) {
  const SmallFooting run;
  scene::Scene loaded = run.scene;
  loaded.drive.kind = scene::DriveKind::load;
  EXPECT_THAT(failure_report(loaded, run.model, run.state, given_up(jfnk::Status::stagnated)),
              HasSubstr("advice: the load may be beyond what the body carries: drive a "
                        "displacement instead."));
}

TEST(FailureReport, SaysWhatALoadIsWithoutControlAndToleranceIfItKnows) {
  SmallFooting run;
  run.state.programme.load = 0.5;
  scene::Scene loaded = run.scene;
  loaded.drive.kind = scene::DriveKind::load;
  StepResult result = given_up(jfnk::Status::stagnated);
  const auto says = [&](const scene::Scene& scene) {
    return failure_report(scene, run.model, run.state, result);
  };
  EXPECT_THAT(says(loaded), Not(HasSubstr("energy-corrected")));
  result.corrected_load = 0.49;
  EXPECT_THAT(says(loaded), HasSubstr("energy-corrected: 0.49 of the load, without 2 % that the "
                                      "hourglass control bears"));
  EXPECT_THAT(says(run.scene), Not(HasSubstr("energy-corrected")));
  // Of a load that stays while strength is divided nothing grows.
  loaded.course.reduction_end = 2.0;
  EXPECT_THAT(says(loaded), Not(HasSubstr("energy-corrected")));
  loaded.course.reduction_end = loaded.course.reduction_begin;
  loaded.course.load_end = loaded.course.load_begin;
  EXPECT_THAT(says(loaded), Not(HasSubstr("energy-corrected")));
}

// What control and unbalanced forces do on a step's motion, over what a load of one does on it.
TEST(CorrectedLoad, TakesOffWhatIsNotBorneByTheSoil) {
  equilibrium::StepForces forces;
  forces.growing_work = 20.0;
  forces.hourglass_work = 0.3;
  forces.unbalanced_work = 0.1;
  EXPECT_NEAR(corrected_load(0.8, forces).value(), 0.78, 1e-15);
  EXPECT_FALSE(corrected_load(0.0, forces));  // nothing has grown yet
  forces.growing_work = -1.0;                 // what gives way lifts it
  EXPECT_FALSE(corrected_load(0.8, forces));
}

TEST(FailureReport, AdvisesConstantLoadsOnWhatYieldsToGrow) {
  const SmallFooting run;
  scene::Scene still = run.scene;
  still.drive.kind = scene::DriveKind::none;
  EXPECT_THAT(failure_report(still, run.model, run.state, given_up(jfnk::Status::stagnated)),
              HasSubstr("advice: the loads may be beyond what the body carries: let them grow, "
                        "drive.kind = \"load\"."));
}

TEST(FailureReport, AdvisesTheHopelessALooserTolerance) {
  const SmallFooting run({"solver.tolerance=1e-4"});
  EXPECT_THAT(report_of(run, given_up(jfnk::Status::stagnated, StepOutcome::hopeless)),
              HasSubstr("resume with --set solver.tolerance=0.0003."));
}

TEST(FailureReport, AdvisesSmallerIncrementsOtherwise) {
  const SmallFooting run({"programme.minimum_increment_ratio=0.5"});
  EXPECT_THAT(report_of(run, given_up(jfnk::Status::stagnated)),
              HasSubstr("advice: resume with --set programme.minimum_increment_ratio=0.0078."));
}

TEST(FailureFields, AreTheResidualAndTheAttemptParticleByParticle) {
  const SmallFooting run;
  const Eigen::Index n = run.model.size();
  StepResult result = given_up(jfnk::Status::stagnated);
  result.residual = Eigen::VectorXd::LinSpaced(2 * n, 1.0, static_cast<double>(2 * n));
  const auto fields = failure_fields(run.model, result);
  ASSERT_EQ(fields.size(), 2U);
  EXPECT_EQ(fields[0].name, "residual");
  EXPECT_EQ(fields[0].unit, "N/m");
  const auto at = static_cast<std::size_t>(3 * 4);  // of particle 4
  EXPECT_EQ(fields[0].values[at], 5.0);
  EXPECT_EQ(fields[0].values[at + 1], static_cast<double>(n) + 5.0);
  EXPECT_EQ(fields[0].values[at + 2], 0.0);
  EXPECT_EQ(fields[1].name, "attempt");
  EXPECT_THAT(fields[1].values, ::testing::Each(0.0)) << "it could not be evaluated";
}

}  // namespace
}  // namespace stepping
