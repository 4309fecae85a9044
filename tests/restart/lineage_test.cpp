// Branches: whence a run comes is written in its checkpoints, and what it branches off from stays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <stdexcept>

#include "record/checkpoint_file.hpp"
#include "record/lineage.hpp"
#include "restart.hpp"

namespace restart {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

record::CheckpointNotes notes_in(const std::filesystem::path& checkpoint) {
  record::CheckpointNotes notes;
  (void)record::open_checkpoint(checkpoint, notes);
  return notes;
}

record::Ancestor ancestor_at(const std::filesystem::path& checkpoint,
                             std::vector<std::string> changed) {
  const record::CheckpointNotes notes = notes_in(checkpoint);
  return {checkpoint.string(), notes.history.back().step, notes.created,
          record::identity_of(notes.digest), std::move(changed)};
}

std::map<std::string, std::string> content_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> content;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) content[entry.path().string()] = bytes_of_file(entry.path());
  }
  return content;
}

TEST(Branch, NamesItsParentAndLeavesItUntouched) {
  const support::TemporaryFolder folder;
  const auto trunk = folder / "trunk", branch = folder / "branch", twig = folder / "twig";
  ASSERT_EQ(fpm_run_in(trunk, block).code, program::ExitCode::done);
  EXPECT_THAT(notes_in(last_checkpoint(trunk)).lineage, IsEmpty());
  const auto before = content_of(trunk);

  const auto fork = checkpoint_of(trunk, 2);
  ASSERT_EQ(fpm_run_in(branch, block,
                       {"--resume=" + fork.string(), "--set", "solver.tolerance=1e-4", "--set",
                        "output.checkpoints_every=2"})
                .code,
            program::ExitCode::done);
  const record::Ancestor parent =
      ancestor_at(fork, {"solver.tolerance: absent -> 0.0001", "output.checkpoints_every: 1 -> 2"});
  EXPECT_EQ(content_of(trunk), before);
  EXPECT_THAT(notes_in(checkpoint_of(branch, 4)).lineage, ElementsAre(parent));

  const auto second = checkpoint_of(branch, 4);
  const std::vector<std::string> on{"--resume=" + second.string(), "--set", "solver.tolerance=1e-4",
                                    "--set", "output.checkpoints_every=2"};
  ASSERT_EQ(fpm_run_in(twig, block, on).code, program::ExitCode::done);
  EXPECT_THAT(notes_in(last_checkpoint(twig)).lineage,
              ElementsAre(parent, ancestor_at(second, {})));
}

// Killed before its first own checkpoint, a branch would have to be branched off again.
TEST(Branch, GoesOnFromItsOwnStartThoughItsTrunkIsGone) {
  const support::TemporaryFolder folder;
  const auto trunk = folder / "trunk", branch = folder / "branch";
  const std::vector<std::string> rigid{"--set", "re_search.enabled=false"};
  ASSERT_EQ(fpm_run_in(trunk, footing, rigid).code, program::ExitCode::done);
  const auto fork = checkpoint_of(trunk, 6);
  const std::vector<std::string> kept{"--set", "output.checkpoints_kept=1000"};
  auto arguments = kept;
  arguments.push_back("--resume=" + fork.string());
  ASSERT_EQ(fpm_run_in(branch, footing, arguments).code, program::ExitCode::done);
  const auto end = last_checkpoint(branch), whole = folder / "whole.hdf";
  std::filesystem::copy_file(end, whole);
  const auto curve = curve_without_wall(branch);

  const auto start = checkpoint_of(branch, 6);
  EXPECT_EQ(notes_in(start).reason, "start of the branch");
  ASSERT_EQ(notes_in(start).lineage.size(), 1U);
  EXPECT_EQ(notes_in(start).lineage.front().checkpoint, fork.string());
  EXPECT_THAT(notes_in(start).lineage.front().changed,
              Contains("re_search.enabled: false -> true"));
  std::filesystem::remove_all(trunk);
  arguments = kept;
  arguments.push_back("--resume=" + start.string());
  ASSERT_EQ(fpm_run_in(branch, footing, arguments).code, program::ExitCode::done);
  EXPECT_THAT(differing_fields(end, whole), IsEmpty());
  EXPECT_EQ(curve_without_wall(branch), curve);
}

TEST(Branch, OverwritesNoOtherRun) {
  const support::TemporaryFolder folder;
  const auto trunk = folder / "trunk", other = folder / "other";
  ASSERT_EQ(fpm_run_in(trunk, block).code, program::ExitCode::done);
  ASSERT_EQ(fpm_run_in(other, block).code, program::ExitCode::done);
  const std::string curve = bytes_of_file(other / "curve.csv");
  const Outcome outcome =
      fpm_run_in(other, block, {"--resume=" + checkpoint_of(trunk, 2).string()});
  ASSERT_EQ(outcome.code, program::ExitCode::done) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("results of an earlier run are now in "));
  EXPECT_EQ(bytes_of_file(other / "previous-1" / "curve.csv"), curve);
}

TEST(Lineage, OfAnInterruptedRunCountsItsInterruptions) {
  const support::TemporaryFolder folder;
  const auto run = folder / "run";
  ASSERT_EQ(fpm_run_in(run, block, {"--max-wall", "0.000000001s"}).code,
            program::ExitCode::interrupted);
  const record::Ancestor parent = ancestor_at(checkpoint_of(run, 0), {});
  ASSERT_EQ(fpm_run_in(run, block, {"--resume"}).code, program::ExitCode::done);
  EXPECT_THAT(notes_in(last_checkpoint(run)).lineage, ElementsAre(parent));
}

TEST(Lineage, ReadsBackFromItsText) {
  const std::vector<record::Ancestor> ancestors{
      {"/a b/\"quoted\"/step-000010.hdf", 10, "2024-05-17T08:30:00Z", "00ff00ff00ff00ff", {}},
      {"C:\\back\\slash 'é'", 1234567890123, "", "", {"title: 'a' -> \"b\"", "x: 1 -> 2"}}};
  EXPECT_EQ(record::parse_lineage(record::lineage_text(ancestors)), ancestors);
  EXPECT_THAT(record::parse_lineage(record::lineage_text({})), IsEmpty());
  for (const char* broken : {"[[ancestor]]\nstep = 1", "ancestor = [", "[[ancestor]]\nstep = 'x'",
                             "ancestor = 3", "ancestor = [3]"}) {
    EXPECT_THROW((void)record::parse_lineage(broken), std::invalid_argument) << broken;
  }
}

}  // namespace
}  // namespace restart
