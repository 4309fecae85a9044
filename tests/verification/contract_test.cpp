// What the libraries promise, kept by those who wire them: no allocation inside an evaluation,
// results that do not depend on the number of threads, and a re-search that changes neighbours
// alone.

#include <omp.h>
#include <Eigen/LU>

#include "bodies.hpp"
#include "libfpm/allocation_count.hpp"
#include "run.hpp"

namespace verification {
namespace {

template <class Call>
long allocations(Call&& call) {
  call();  // the first call may start the threads
  const long before = allocation_count();
  call();
  return allocation_count() - before;
}

template <int Dim>
void expect_no_allocation(const BodyOptions& body) {
  const TestScene scene = scene_of(body_scene(body));
  const auto model = model::build_model<Dim>(scene);
  auto state = model::initial_state(model);
  equilibrium::Equilibrium<Dim> equilibrium(model, state);
  const Eigen::VectorXd u = increment_field(
      model, state, [](const fpm::Vector<Dim>& x) { return bending<Dim>(x, 0.01); });
  Noise noise(1);
  const Eigen::VectorXd v = noise.vector(u.size(), 1e-3);
  Eigen::VectorXd r(u.size());
  equilibrium.begin_step(0.0);
  bool ok = true;
  EXPECT_EQ(allocations([&] { ok &= equilibrium(u, r) == jfnk::Evaluation::ok; }), 0);
  EXPECT_EQ(allocations([&] { ok &= equilibrium.linearise(u); }), 0);
  EXPECT_EQ(allocations([&] { equilibrium.apply_jacobian(v, r); }), 0);
  EXPECT_TRUE(ok);
}

TEST(Equilibrium, DoesNotAllocateInAnEvaluation) {
  for (const std::string control : {"none", "viscosity", "incremental", "mixed"}) {
    for (const std::string kinematics : {"finite_strain", "small_strain"}) {
      SCOPED_TRACE(control + " " + kinematics);
      BodyOptions body;
      body.control = control;
      body.kinematics = kinematics;
      expect_no_allocation<2>(body);
    }
  }
}
TEST(Equilibrium, DoesNotAllocateInAnEvaluationInSpace) {
  BodyOptions body;
  body.dimension = 3;
  body.control = "incremental";
  body.model = "mohr_coulomb";
  expect_no_allocation<3>(body);
}
TEST(Equilibrium, DoesNotAllocateInAnEvaluationWithBoundaryTerms) {
  BodyOptions body;
  body.extra =
      "[[support]]\nname=\"base\"\nside=\"bottom\"\ndirections=[\"x\",\"y\"]\n"
      "method=\"penalty\"\n[[traction]]\nname=\"water\"\nside=\"top\"\nvalue=[0.0,-1e3]\n"
      "follower=true\n[drive]\nkind=\"load\"\nscales=[\"traction\"]\n[programme]\nsteps=1\n";
  expect_no_allocation<2>(body);
}

const Settings coarse_footing = {"geometry.spacing=0.02"};

struct Outcome {
  Eigen::MatrixXd displacement, stress;
  std::vector<double> curve;
  std::vector<std::int64_t> evaluations;
};

Outcome five_steps(int threads) {
  const int before = omp_get_max_threads();
  omp_set_num_threads(threads);
  Run<2> run(shipped_scene("footing.toml", coarse_footing));
  Outcome outcome;
  for (int k = 0; k < 5; ++k) {
    const auto result = run.stepper.advance();
    outcome.curve.push_back(result.record.reaction);
    outcome.evaluations.push_back(result.record.evaluations);
  }
  outcome.displacement = run.state.displacement;
  outcome.stress = run.state.stress;
  omp_set_num_threads(before);
  return outcome;
}

TEST(Threads, DoNotChangeARunToTheLastBit) {
  const Outcome one = five_steps(1);
  for (const int threads : {2, 3, 7}) {
    const Outcome more = five_steps(threads);
    EXPECT_EQ(one.curve, more.curve) << threads;
    EXPECT_EQ(one.evaluations, more.evaluations) << threads;
    EXPECT_EQ(one.displacement, more.displacement) << threads;
    EXPECT_EQ(one.stress, more.stress) << threads;
  }
}

double current_volume(const Run<2>& run) {
  double volume = 0.0;
  for (Eigen::Index a = 0; a < run.model.size(); ++a) {
    const Eigen::Map<const Eigen::Matrix2d> f(run.state.deformation_gradient.col(a).data());
    volume += run.state.rows.reference_volume()[a] * f.determinant();
  }
  return volume;
}

// Two runs of the footing, alike until one re-searches at the end of a step.
TEST(Research, KeepsStressPositionsVolumeAndMomentum) {
  Settings early = coarse_footing;
  early.push_back("re_search.trigger=0.02");
  Settings never = coarse_footing;
  never.push_back("re_search.enabled=false");
  verification::Run<2> with(shipped_scene("footing.toml", early));
  verification::Run<2> without(shipped_scene("footing.toml", never));
  Eigen::Index rebuilt = 0;
  for (int step = 0; step < 20 && rebuilt == 0; ++step) {
    rebuilt = with.stepper.advance().record.re_searched_rows;
    (void)without.stepper.advance();
  }
  ASSERT_GT(rebuilt, 0);
  EXPECT_EQ(with.state.stress, without.state.stress);
  EXPECT_EQ(with.state.subpoint_deviator, without.state.subpoint_deviator);
  EXPECT_EQ(with.state.displacement, without.state.displacement);
  EXPECT_EQ(with.state.plastic_strain, without.state.plastic_strain);
  // One product and one sum per particle.
  const double round_off = 1e-15 * static_cast<double>(with.model.size());
  EXPECT_NEAR(current_volume(with) / current_volume(without), 1.0, round_off);

  // Internal forces on the new neighbours still sum to nothing: reactions carry the loads.
  equilibrium::Equilibrium<2> equilibrium(with.model, with.state);
  equilibrium.begin_step(with.state.programme.load);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(with.model.unknowns()), r(u.size());
  ASSERT_EQ(equilibrium(u, r), jfnk::Evaluation::ok);
  const Eigen::Index n = with.model.size();
  const Eigen::VectorXd internal = equilibrium.unmasked_residual() + equilibrium.external_load();
  // Vertical only: the mirror carries horizontal force.
  EXPECT_LT(std::abs(internal.tail(n).sum()), round_off * internal.tail(n).cwiseAbs().sum());
}

}  // namespace
}  // namespace verification
