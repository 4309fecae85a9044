// Checkpoints of every schema there ever was are read, and newer ones refused by name.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <utility>

#include "files/file_seal.hpp"
#include "files/hdf5_file.hpp"
#include "model/build.hpp"
#include "model/checkpoint.hpp"
#include "model/state_file.hpp"
#include "record/curve_file.hpp"
#include "restart.hpp"
#include "run/start.hpp"
#include "scene/changes.hpp"
#include "scene/derived.hpp"
#include "scene/grading.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace restart {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// A checkpoint of step 6 of 10 of a footing of 24 particles, written when the schema was new, with
// what its curve then said of the last steps.
std::filesystem::path stored(std::int64_t schema) {
  return std::filesystem::path(FPM_STORED_CHECKPOINTS) /
         ("schema-" + std::to_string(schema) + ".hdf");
}
double pressure_of_step_6(std::int64_t schema) {
  if (schema >= 10) return 32046.75229041103;                   // solves have changed since
  if (schema >= 9) return 32019.051110891956;                   // solves learn from each other
  if (schema >= 8) return 32095.307708028427;                   // rounding has changed since
  if (schema >= 4) return 32095.30770858148;                    // ground at rest is kept by a load
  return schema < 3 ? 31345.504602432295 : 31345.504602432302;  // rounding has changed since
}
double pressure_of_step_10(std::int64_t schema) {
  return schema >= 4 ? 46097.2 : 44915.2;
}

class Schema : public ::testing::TestWithParam<std::int64_t> {};

TEST_P(Schema, IsReadWithItsNotesAndItsState) {
  record::CheckpointNotes notes;
  const files::Hdf5File file = record::open_checkpoint(stored(GetParam()), notes);
  EXPECT_EQ(notes.schema, GetParam());
  EXPECT_EQ(notes.title, "small footing");
  EXPECT_EQ(notes.history.size(), 7U);
  EXPECT_EQ(notes.history.back().mean_pressure, pressure_of_step_6(GetParam()));
  const scene::Scene scene = model::scene_of(stored(GetParam()), notes);
  const model::Model<2> model = model::build_model<2>(scene);
  const model::State<2> state = model::read_state(file, model, GetParam());
  EXPECT_EQ(state.programme.step, 6);
  EXPECT_EQ(state.plastic_strain.maxCoeff(), notes.history.back().max_plastic_strain);
  // The older ones show ParaView displacements only, so that their reactions are lost.
  const Eigen::Map<const Eigen::VectorXd> reaction(state.reaction.data(), state.reaction.size());
  EXPECT_DOUBLE_EQ(model.measure.dot(reaction),
                   GetParam() < 3 ? 0.0 : notes.history.back().reaction);
}

// Not bit by bit: the numerics have gone on since. The solver's tolerance is 1e-3 of the residual;
// a percent of the pressure is ten times what it leaves open in a step.
TEST_P(Schema, IsResumedToItsEnd) {
  record::CheckpointNotes notes;
  (void)record::open_checkpoint(stored(GetParam()), notes);
  const support::TemporaryFolder folder;
  const Outcome outcome =
      fpm_run_in(folder / "run", notes.scene, {"--resume=" + stored(GetParam()).string()});
  ASSERT_EQ(outcome.code, program::ExitCode::done) << outcome.err;
  const auto rows = record::read_curve(folder / "run" / "curve.csv");
  EXPECT_EQ(rows.back().load_parameter, 1.0);
  const double pressure = pressure_of_step_10(GetParam());
  EXPECT_NEAR(rows.back().mean_pressure, pressure, 0.01 * pressure);
}

// No method meant direct then; it is what the run goes on with.
TEST_P(Schema, IsResumedByASceneThatNamesNoMethod) {
  record::CheckpointNotes notes;
  (void)record::open_checkpoint(stored(GetParam()), notes);
  std::string text;
  std::istringstream lines(notes.scene);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("method = \"direct\"")) text += line + '\n';
  }
  ASSERT_NE(text, notes.scene);
  const support::TemporaryFolder folder;
  const Outcome outcome =
      fpm_run_in(folder / "run", text, {"--resume=" + stored(GetParam()).string()});
  ASSERT_EQ(outcome.code, program::ExitCode::done) << outcome.err;
  record::CheckpointNotes last;
  (void)record::open_checkpoint(last_checkpoint(folder / "run"), last);
  EXPECT_THAT(last.scene, Not(HasSubstr("method = \"auto\"")));
  const double pressure = pressure_of_step_10(GetParam());
  EXPECT_NEAR(last.history.back().mean_pressure, pressure, 0.01 * pressure);
}

INSTANTIATE_TEST_SUITE_P(Versions, Schema,
                         ::testing::Range<std::int64_t>(1, record::checkpoint_schema + 1),
                         [](const auto& info) { return std::to_string(info.param); });

// Under a load that grows the control was as strong as under a plate.
TEST(SchemaOfThePast, OfLoadsHasItsControl) {
  const auto reading = scene::parse_scene(
      "[geometry]\nmin = [0.0, 0.0]\nmax = [1.0, 1.0]\nspacing = 0.25\n"
      "[[material]]\nname = \"soil\"\nmodel = \"drucker_prager\"\nyoungs_modulus = 1e6\n"
      "poissons_ratio = 0.3\ncohesion = 1e3\nfriction_angle = 20.0\ndilation_angle = 0.0\ndensity "
      "= 2e3\n"
      "[[support]]\nname = \"base\"\nside = \"bottom\"\ndirections = [\"x\", \"y\"]\n"
      "[gravity]\nacceleration = [0.0, -10.0]\n[drive]\nkind = \"load\"\nscales = "
      "[\"gravity\"]\n[programme]\nsteps = 4\n",
      "s.toml");
  ASSERT_TRUE(reading.scene) << reading.errors.front().text();
  EXPECT_EQ(scene::resolve_control(*reading.scene), scene::HourglassControl::incremental);
  EXPECT_EQ(scene::resolve_stiffness_ratio(*reading.scene), 0.001);
  record::CheckpointNotes notes = model::notes_for(*reading.scene);
  for (const std::int64_t schema : {5, 6, 7}) {
    notes.schema = schema;
    const scene::Scene before = model::scene_of("stored.hdf", notes);
    scene::Scene resumed = *reading.scene;
    scene::keep_methods(before, resumed);
    const bool is_old = schema == 5;
    EXPECT_EQ(scene::resolve_control(resumed),
              is_old ? scene::HourglassControl::mixed : scene::HourglassControl::incremental);
    EXPECT_EQ(scene::resolve_stiffness_ratio(resumed), is_old ? 0.01 : 0.001);
  }
}

// Where stages try the ground the control was that of displacements.
TEST(SchemaOfThePast, OfStagesHasItsControl) {
  const auto reading = scene::parse_scene(
      "[geometry]\nmin = [0.0, 0.0]\nmax = [1.0, 1.0]\nspacing = 0.25\n"
      "[[material]]\nname = \"soil\"\nmodel = \"von_mises\"\nyoungs_modulus = 1e6\n"
      "poissons_ratio = 0.3\ncohesion = 1e3\ndensity = 2e3\n"
      "[[support]]\nname = \"base\"\nside = \"bottom\"\ndirections = [\"x\", \"y\"]\n"
      "[gravity]\nacceleration = [0.0, -10.0]\n[initial_stress]\nkind = \"gravity\"\n"
      "[[stage]]\nname = \"shake\"\nkh = 0.1\nsteps = 4\n",
      "s.toml");
  ASSERT_TRUE(reading.scene) << reading.errors.front().text();
  const auto resumed = [&](std::int64_t schema, scene::HourglassControl control) {
    scene::Scene begun = *reading.scene;
    begun.hourglass.control = control;
    record::CheckpointNotes notes = model::notes_for(begun);
    notes.schema = schema;
    scene::Scene goes_on = begun;
    scene::keep_methods(model::scene_of("stored.hdf", notes), goes_on);
    return std::pair(scene::resolve_control(goes_on), scene::resolve_stiffness_ratio(goes_on));
  };
  using enum scene::HourglassControl;
  EXPECT_EQ(resumed(9, automatic), std::pair(mixed, 0.01));
  EXPECT_EQ(resumed(10, automatic), std::pair(incremental, 0.01));
  EXPECT_EQ(resumed(9, incremental), std::pair(incremental, 0.1));
  EXPECT_EQ(resumed(10, incremental), std::pair(incremental, 0.01));
}

// Walls that a drive moves bore nothing at first.
TEST(SchemaOfThePast, OfAWallIsWarnedOf) {
  const auto note = [](std::int64_t schema, const std::string& side,
                       const std::vector<record::CurveRow>& history = {}) {
    const auto reading = scene::parse_scene(
        "[geometry]\nmin = [0.0, 0.0]\nmax = [1.0, 1.0]\nspacing = 0.25\n"
        "[[material]]\nname = \"soil\"\nmodel = \"elastic\"\nyoungs_modulus = 1e6\n"
        "poissons_ratio = 0.3\nunit_weight = 20e3\n"
        "[[support]]\nname = \"base\"\nside = \"bottom\"\ndirections = [\"y\"]\n"
        "[initial_stress]\nkind = \"geostatic\"\n"
        "[drive]\nkind = \"displacement\"\nlateral = \"free\"\ntarget = 0.01\nwidth = 1.0\n" +
            side,
        "s.toml");
    EXPECT_TRUE(reading.scene) << reading.errors.front().text();
    return reading.scene ? run::note_on_wall(schema, *reading.scene, history) : "";
  };
  const std::string wall = "side = \"left\"\ndirection = [-1, 0]\n";
  EXPECT_THAT(note(8, wall), HasSubstr("its reaction jumps"));
  EXPECT_EQ(note(3, wall), "");
  EXPECT_EQ(note(9, wall), "");
  // By its particles it is moved only since.
  std::vector<record::CurveRow> history(1);
  EXPECT_EQ(note(9, wall, history), "");
  const std::string by_particles = wall + "method = \"direct\"\n";
  EXPECT_THAT(note(9, by_particles, history), HasSubstr("its reaction jumps"));
  history.front().reaction = 10e3;
  EXPECT_EQ(note(9, by_particles, history), "");
  EXPECT_EQ(note(8, "side = \"top\"\ndirection = [0, -1]\n"), "");
}

// Files of before say 0.125 where the scene says nothing; a scene may say what the rule comes to.
TEST(SchemaOfThePast, OfGradedBodiesHasItsGrowth) {
  const auto before = scene::parse_scene(
      "[geometry]\nmin = [0.0, 0.0]\nmax = [1.0, 1.0]\nspacing = 0.01\n"
      "[grading]\nenabled = true\n[[refine]]\nat = [0.5, 0.5]\n"
      "[[material]]\nname = \"soil\"\nmodel = \"elastic\"\nyoungs_modulus = 1e6\n"
      "poissons_ratio = 0.3\ndensity = 2e3\n"
      "[[support]]\nname = \"base\"\nside = \"bottom\"\ndirections = [\"x\", \"y\"]\n"
      "[drive]\nside = \"top\"\ntarget = 0.01\n[programme]\nsteps = 4\n",
      "s.toml");
  ASSERT_TRUE(before.scene) << before.errors.front().text();
  ASSERT_LT(scene::resolve_growth(*before.scene), 0.125);
  const auto resumed = [&](std::optional<double> stored, std::optional<double> told) {
    scene::Scene former = *before.scene, now = *before.scene;
    former.grading.growth = stored;
    now.grading.growth = told;
    scene::keep_methods(former, now);
    return scene::scene_changes(former, now, 0).empty();
  };
  EXPECT_TRUE(resumed(0.125, std::nullopt));
  EXPECT_TRUE(resumed(std::nullopt, std::nullopt));
  EXPECT_TRUE(resumed(std::nullopt, scene::resolve_growth(*before.scene)));
  EXPECT_FALSE(resumed(0.125, 0.25));
  EXPECT_FALSE(resumed(std::nullopt, 0.125));
}

const std::string of_the_future = "has checkpoint schema " +
                                  std::to_string(record::checkpoint_schema + 1) +
                                  " (written by fpm-run 9.8.7)";

TEST(SchemaOfTheFuture, IsRefusedByName) {
  const support::TemporaryFolder folder;
  const auto run = folder / "run", file = folder / "newer.hdf";
  ASSERT_EQ(fpm_run_in(run, block, {"--max-wall", "0.000000001s"}).code,
            program::ExitCode::interrupted);
  std::filesystem::copy_file(checkpoint_of(run, 0), file);
  files::write_seal(file, record::checkpoint_schema + 1, "fpm-run 9.8.7");
  const Outcome outcome = fpm_run_in(run, block, {"--resume=" + file.string()});
  EXPECT_EQ(outcome.code, program::ExitCode::checkpoint_unusable);
  EXPECT_THAT(outcome.err, HasSubstr(of_the_future + "; this program reads schemas 1 to " +
                                     std::to_string(record::checkpoint_schema)));
}

// What is in the file counts, though its seal were of an older program.
TEST(SchemaOfTheFuture, IsRefusedByNameBehindASealToo) {
  const support::TemporaryFolder folder;
  const auto file = folder / "newer.hdf";
  {
    files::Hdf5File newer = files::Hdf5File::create(file, {.user_block = files::seal_size});
    const std::int64_t schema = record::checkpoint_schema + 1;
    newer.write<std::int64_t>("/meta/schema", std::span(&schema, 1), {1});
    newer.write_text("/meta/versions", "fpm-run 9.8.7");
    newer.close();
  }
  files::write_seal(file, record::checkpoint_schema, "fpm-run 0.1.0");
  record::CheckpointNotes notes;
  try {
    (void)record::open_checkpoint(file, notes);
    FAIL() << "opened";
  } catch (const files::FileError& failure) {
    EXPECT_THAT(failure.reason(), HasSubstr(of_the_future));
  }
}

TEST(FileSeal, IsTextThatReadsBack) {
  const support::TemporaryFolder folder;
  const auto file = folder / "sealed";
  std::string content(3 * files::seal_size + 7, 'x');
  std::ofstream(file, std::ios::binary) << content;
  files::write_seal(file, 2, "fpm-run 1.2.3,\nfpm 4.5.6");
  EXPECT_THAT(bytes_of_file(file),
              ::testing::StartsWith("fpm checkpoint\nschema 2\nwriter fpm-run 1.2.3, fpm 4.5.6\n"
                                    "bytes 1031\nsum "));
  EXPECT_EQ(std::filesystem::file_size(file), content.size());
  const auto seal = files::read_seal(file);
  ASSERT_TRUE(seal);
  EXPECT_EQ(seal->schema, 2);
  EXPECT_EQ(seal->bytes, 2 * files::seal_size + 7);
  EXPECT_NO_THROW(files::require_unbroken(file, *seal));
}

TEST(FileSeal, IsBrokenByAnyByteThatChanges) {
  const support::TemporaryFolder folder;
  const auto file = folder / "sealed";
  std::ofstream(file, std::ios::binary) << std::string(2 * files::seal_size, 'x');
  files::write_seal(file, 2, "fpm-run 1.2.3");
  const std::string sound = bytes_of_file(file);
  for (std::size_t at = 0; at < sound.size(); ++at) {
    std::string bytes = sound;
    bytes[at] ^= '\x01';
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
    bool held = false;
    try {
      const auto seal = files::read_seal(file);
      if (seal && seal->schema == 2) {
        files::require_unbroken(file, *seal);
        held = true;
      }
    } catch (const files::FileError&) {
    }
    EXPECT_FALSE(held) << "byte " << at;
  }
}

}  // namespace
}  // namespace restart
