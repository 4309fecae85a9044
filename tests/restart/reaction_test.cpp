// Reactions belong to the state: what is written right after a resume has them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files/hdf5_file.hpp"
#include "model/build.hpp"
#include "model/checkpoint.hpp"
#include "model/state_file.hpp"
#include "restart.hpp"
#include "scene/scene.hpp"

namespace restart {
namespace {

std::vector<double> shown_reactions(const std::filesystem::path& file) {
  return files::Hdf5File::open(file).read_all<double>("/VTKHDF/PointData/reaction");
}

class Reactions : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(fpm_run_in(whole_, footing).code, program::ExitCode::done);
    shown_ = shown_reactions(checkpoint_of(whole_, 10));
    ASSERT_TRUE(std::ranges::any_of(shown_, [](double force) { return force != 0.0; }));
  }

  support::TemporaryFolder folder_;
  std::filesystem::path whole_ = folder_ / "whole", run_ = folder_ / "run";
  std::string from_10_ = "--resume=" + checkpoint_of(whole_, 10).string();
  std::vector<double> shown_;  // of step 10
};

TEST_F(Reactions, OfACheckpointSumUpToTheReactionOfItsCurve) {
  const auto by_particles = folder_ / "direct";
  ASSERT_EQ(fpm_run_in(by_particles, footing,
                       {"--set", "support.0.method=direct", "--set", "support.1.method=direct",
                        "--set", "drive.method=direct"})
                .code,
            program::ExitCode::done);
  record::CheckpointNotes notes;
  const auto path = checkpoint_of(by_particles, 10);
  const files::Hdf5File file = record::open_checkpoint(path, notes);
  const auto model = model::build_model<2>(model::scene_of(path, notes));
  const auto state = model::read_state(file, model, notes.schema);
  const Eigen::Map<const Eigen::VectorXd> reaction(state.reaction.data(), state.reaction.size());
  EXPECT_DOUBLE_EQ(model.measure.dot(reaction), notes.history.back().reaction);
  for (Eigen::Index k = 0; k < reaction.size(); ++k) {
    if (model.prescribed[static_cast<std::size_t>(k)] != 0) continue;
    EXPECT_EQ(reaction[k], 0.0) << "what is left of the residual is no reaction";
  }
}

TEST_F(Reactions, AreInTheCheckpointWithWhichABranchBegins) {
  ASSERT_EQ(fpm_run_in(run_, footing, {from_10_, "--max-wall", "0.000000001s"}).code,
            program::ExitCode::interrupted);
  EXPECT_EQ(shown_reactions(checkpoint_of(run_, 10)), shown_);
  EXPECT_THAT(differing_fields(checkpoint_of(whole_, 10), checkpoint_of(run_, 10)),
              ::testing::IsEmpty());
}

// Goes on with ten evaluations for ten digits: no step converges before the frame is written.
TEST_F(Reactions, AreInTheFrameAndTheFailureOfARunThatGetsNowhere) {
  ASSERT_EQ(fpm_run_in(run_, footing,
                       {from_10_, "--set", "output.frames_every=1", "--set",
                        "solver.tolerance=1e-10", "--set", "solver.max_evaluations_per_step=10",
                        "--set", "programme.minimum_increment_ratio=1.0"})
                .code,
            program::ExitCode::not_converged);
  EXPECT_EQ(shown_reactions(run_ / "frames" / "frame-000010.hdf"), shown_);
  EXPECT_EQ(shown_reactions(run_ / "failure.hdf"), shown_);
}

// Schemas 1 and 2 had them only for ParaView.
TEST_F(Reactions, OfAnOlderSchemaAreThoseThatParaViewIsShown) {
  record::CheckpointNotes notes;
  const auto path = checkpoint_of(whole_, 10);
  const files::Hdf5File file = record::open_checkpoint(path, notes);
  const auto model = model::build_model<2>(model::scene_of(path, notes));
  const auto state = model::read_state(file, model, notes.schema);
  EXPECT_EQ(model::read_state(file, model, 2).reaction, state.reaction);
}

}  // namespace
}  // namespace restart
