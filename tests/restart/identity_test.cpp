// A resumed run is the uninterrupted one, bit for bit, in every field and in the curve.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "files/hdf5_file.hpp"
#include "record/checkpoint_file.hpp"
#include "record/curve_file.hpp"
#include "restart.hpp"

namespace restart {
namespace {

using ::testing::IsEmpty;

// Spares the disk the checkpoints that a test does not look at.
const std::string at_end_only = "output.checkpoints_every=0";

struct Case {
  std::string name;
  const std::string* scene;
  std::vector<std::string> settings;
  int steps_at_least = 0;
  bool researches = false;
  bool cuts = false;

  friend void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

  std::vector<std::string> arguments(std::vector<std::string> more = {}) const {
    for (const std::string& setting : settings) {
      more.emplace_back("--set");
      more.push_back(setting);
    }
    return more;
  }
};

const std::vector<Case> cases{
    {"mixed", &footing, {}, 20, true},
    {"mixed_with_cuts",
     &footing,
     {"programme.steps=6", "solver.max_evaluations_per_step=10"},
     7,
     true,
     true},
    {"mixed_small_strain",
     &footing,
     {"approximation.kinematics=small_strain", "re_search.enabled=false"},
     20},
    {"incremental", &footing, {"hourglass.control=incremental"}, 20, true},
    {"viscosity", &footing, {"hourglass.control=viscosity"}, 20, true},
    {"mohr_coulomb", &footing, {"material.0.model=mohr_coulomb"}, 20, true},
    {"newton_krylov", &footing, {"solver.method=newton_krylov"}, 20, true},
    {"consistency", &footing, {"approximation.consistency=on"}, 20, true},
    {"direct",
     &footing,
     {"support.0.method=direct", "support.1.method=direct", "drive.method=direct"},
     20,
     true},
    {"graded",
     &footing,
     {"grading.enabled=true", "grading.growth=0.5", "grading.coarsest=0.5"},
     20,
     true},
    {"tied", &layered, {}, 20, true},
    {"tied_and_sliding",
     &layered,
     {"approximation.kinematics=small_strain", "re_search.enabled=false",
      "material.0.friction_angle=0", "material.0.dilation_angle=0"},
     20},
    {"contact",
     &layered,
     {"interface.0.kind=contact", "interface.0.friction_angle=15", "drive.method=contact",
      "drive.friction_angle=10"},
     20},
    {"loaded_plate", &loaded_plate, {"re_search.enabled=false"}, 20},
    {"mixed_mohr_coulomb",
     &footing,
     {"material.0.model=mohr_coulomb", "hourglass.control=mixed"},
     20,
     true},
    {"cutouts", &tunnel, {}, 8},
    {"regions", &layered_slope, {}, 20, true},
    {"graded_prisms",
     &layered_slope,
     {"geometry.dimension=3", "geometry.depth=[0, 1]", "programme.steps=6",
      "material.0.model=mohr_coulomb", "material.1.model=mohr_coulomb"},
     6,
     true},
    {"water",
     &layered_slope,
     {"water.table=[[0, 1.7], [2, 1.5], [4, 1.2]]", "material.0.saturated_unit_weight=19e3"},
     20},
    {"varying_with_tension_cutoff",
     &footing,
     {"material.0.cohesion={ at = [0, 0], value = 2e3, gradient = [0, -500] }",
      "material.0.youngs_modulus={ at = [0, 0], value = 1e6, gradient = [0, -5e5] }",
      "material.0.tension_cutoff=500"},
     20},
    {"softening",
     &footing,
     {"material.0.residual_strain=0.1", "material.0.residual_cohesion=500"},
     20,
     true},
    {"modified_cam_clay",
     &footing,
     {"material.0.model=modified_cam_clay", "material.0.compression_index=0.1",
      "material.0.swelling_index=0.02", "material.0.critical_stress_ratio=1.0",
      "material.0.overconsolidation_ratio=2", "gravity.acceleration=[0, -9.81]",
      "initial_stress.kind=geostatic", "initial_stress.K0=0.7", "drive.target=0.02"},
     8},
    {"graded_cutouts", &tunnel, {"geometry.spacing=0.125", "grading.enabled=true"}, 8},
    {"triangles", &triangles, {}, 20, true},
    {"tetrahedra", &tetrahedra, {}, 6},
    {"stages", &staged, {}, 20, true},
    // Elastic, in small strain: steps are solved by conjugate gradients.
    {"linear_stages",
     &staged,
     {"approximation.kinematics=small_strain", "re_search.enabled=false",
      "material.0.model=elastic"},
     20},
    {"linear_regions",
     &layered_slope,
     {"approximation.kinematics=small_strain", "re_search.enabled=false",
      "material.0.model=elastic", "material.1.model=elastic"},
     20},
    {"stages_of_a_load", &staged_load, {"re_search.enabled=false"}, 20},
    {"block_3d", &block, {}, 6},
    {"mixed_block_3d",
     &block,
     {"material.0.model=von_mises", "material.0.cohesion=5e3", "hourglass.control=mixed"},
     6},
};

class Resume : public ::testing::TestWithParam<Case> {};

TEST_P(Resume, IsBitIdenticalToTheUninterruptedRunFromEveryCheckpoint) {
  const Case& c = GetParam();
  const support::TemporaryFolder folder;
  const auto whole = folder / "whole";
  ASSERT_EQ(fpm_run_in(whole, *c.scene, c.arguments()).code, program::ExitCode::done);
  const auto curve = curve_without_wall(whole);
  const int steps = static_cast<int>(curve.size()) - 2;  // header and row 0
  ASSERT_GE(steps, c.steps_at_least);

  for (const int step : {1, steps / 2, steps - 1}) {
    if (c.researches && step < steps - 1) {
      ASSERT_GT(column_sum_after(whole, "researched_rows", step), 0.0);
    }
    if (c.cuts && step < steps / 2) {
      ASSERT_GT(column_sum_after(whole, "cuts", step), 0.0);
    }
    const auto resumed = folder / ("from " + std::to_string(step));
    const auto outcome = fpm_run_in(
        resumed, *c.scene,
        c.arguments({"--resume=" + checkpoint_of(whole, step).string(), "--set", at_end_only}));
    ASSERT_EQ(outcome.code, program::ExitCode::done) << outcome.err;
    EXPECT_THAT(differing_fields(last_checkpoint(whole), last_checkpoint(resumed)), IsEmpty())
        << "resumed from step " << step;
    EXPECT_EQ(curve_without_wall(resumed), curve) << "resumed from step " << step;
  }
}

TEST_P(Resume, OfAResumedRunIsBitIdenticalToo) {
  const Case& c = GetParam();
  const support::TemporaryFolder folder;
  const auto whole = folder / "whole", second = folder / "second", third = folder / "third";
  ASSERT_EQ(fpm_run_in(whole, *c.scene, c.arguments()).code, program::ExitCode::done);
  ASSERT_EQ(
      fpm_run_in(second, *c.scene, c.arguments({"--resume=" + checkpoint_of(whole, 1).string()}))
          .code,
      program::ExitCode::done);
  ASSERT_EQ(fpm_run_in(third, *c.scene,
                       c.arguments(
                           {"--resume=" + checkpoint_of(second, 3).string(), "--set", at_end_only}))
                .code,
            program::ExitCode::done);
  EXPECT_THAT(differing_fields(last_checkpoint(whole), last_checkpoint(third)), IsEmpty());
  EXPECT_EQ(curve_without_wall(third), curve_without_wall(whole));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Resume, ::testing::ValuesIn(cases),
                         [](const auto& info) { return info.param.name; });

// The cases above would go on alike, too, if there were none.
TEST(Checkpoint, HoldsWhatTheStepHasLearntOfTheTangentUntilRowsAreRebuilt) {
  const support::TemporaryFolder folder;
  ASSERT_EQ(fpm_run_in(folder / "run", footing,
                       {"--set", "re_search.enabled=false", "--set", "programme.steps=40", "--set",
                        "drive.target=0.05"})
                .code,
            program::ExitCode::done);
  record::CheckpointNotes notes;
  const auto file = record::open_checkpoint(checkpoint_of(folder / "run", 20), notes);
  EXPECT_EQ(file.info("/state/secants/step").shape, file.info("/state/secants/change").shape);
  EXPECT_GT(file.info("/state/secants/step").shape.front(), 0U);
  ASSERT_EQ(fpm_run_in(folder / "searched", footing).code, program::ExitCode::done);
  const auto searched = folder / "searched";
  ASSERT_GT(column_sum_after(searched, "researched_rows", 0), 0.0);
  const auto rows = record::read_curve(searched / "curve.csv");
  const auto found =
      std::ranges::find_if(rows, [](const auto& row) { return row.re_searched_rows > 0; });
  const auto after =
      record::open_checkpoint(checkpoint_of(searched, static_cast<int>(found->step)), notes);
  EXPECT_FALSE(after.has("/state/secants/step"));
}

TEST(Threads, ChangeNoBitOfARunNorOfItsResumption) {
  for (const std::string* scene : {&footing, &block}) {
    const support::TemporaryFolder folder;
    const auto one = folder / "one", two = folder / "two", mixed = folder / "mixed";
    ASSERT_EQ(fpm_run_in(one, *scene, {"--threads", "1"}).code, program::ExitCode::done);
    ASSERT_EQ(fpm_run_in(two, *scene, {"--threads", "2"}).code, program::ExitCode::done);
    const std::string from = "--resume=" + checkpoint_of(two, 3).string();
    ASSERT_EQ(fpm_run_in(mixed, *scene, {"--threads", "1", from}).code, program::ExitCode::done);
    EXPECT_THAT(differing_fields(last_checkpoint(one), last_checkpoint(two)), IsEmpty());
    EXPECT_THAT(differing_fields(last_checkpoint(one), last_checkpoint(mixed)), IsEmpty());
    EXPECT_EQ(curve_without_wall(one), curve_without_wall(two));
    EXPECT_EQ(curve_without_wall(one), curve_without_wall(mixed));
  }
}

}  // namespace
}  // namespace restart
