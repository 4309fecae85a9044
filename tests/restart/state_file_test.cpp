// State and file: all fields, both ways.
#include <gtest/gtest.h>

#include <limits>

#include "model/build.hpp"
#include "model/checkpoint.hpp"
#include "model/state_file.hpp"
#include "restart.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace restart {
namespace {

struct Plane {
  scene::Scene scene = *scene::parse_scene(footing, "footing").scene;
  model::Model<2> model = model::build_model<2>(scene);
  model::State<2> state = model::initial_state(model);
  record::CheckpointNotes notes = model::notes_for(scene);

  Plane() { notes.history.resize(1); }
};

TEST(StateFile, GivesBackEveryNumberItWasGiven) {
  const support::TemporaryFolder folder;
  Plane plane;
  double value = 0.0;
  // Every number another one, so that no two fields or components can be exchanged unseen.
  plane.state.for_each_particle_field([&](const char*, const char*, auto& field) {
    for (Eigen::Index k = 0; k < field.size(); ++k) field.data()[k] = value += 1.0 / 3.0;
  });
  plane.state.for_each_secant_field([&](const char*, const char*, auto& field) {
    field.resize(plane.model.unknowns(), 3);
    for (Eigen::Index k = 0; k < field.size(); ++k) {
      field.data()[k] = static_cast<float>(value += 1.0 / 3.0);
    }
  });
  plane.state.programme.for_each_field([&](const char*, const char*, auto& number) {
    number = static_cast<std::remove_reference_t<decltype(number)>>(value += 1.0);
  });
  plane.notes.history.back().step = plane.state.programme.step;
  const auto path = folder / "step-000001.hdf";
  model::write_checkpoint(path, plane.model, plane.state, plane.notes, {});

  record::CheckpointNotes notes;
  const files::Hdf5File file = record::open_checkpoint(path, notes);
  model::State<2> read = model::read_state(file, plane.model);
  const auto again = folder / "step-000002.hdf";
  model::write_checkpoint(again, plane.model, read, plane.notes, {});
  EXPECT_TRUE(differing_fields(path, again).empty());
  EXPECT_EQ(read.displacement, plane.state.displacement);
  EXPECT_EQ(read.stress, plane.state.stress);
  EXPECT_EQ(read.released, plane.state.released);
  EXPECT_EQ(read.secant_step, plane.state.secant_step);
  EXPECT_EQ(read.secant_change, plane.state.secant_change);
  EXPECT_EQ(read.programme.external_work, plane.state.programme.external_work);
  EXPECT_EQ(notes.scene, plane.notes.scene);
  EXPECT_EQ(model::scene_of(path, notes), plane.scene);
}

TEST(StateFile, IsNotWrittenOfAStateThatIsNotFinite) {
  const support::TemporaryFolder folder;
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Plane plane;
    plane.state.stress(1, 17) = bad;
    EXPECT_THROW(model::write_checkpoint(folder / "step-000001.hdf", plane.model, plane.state,
                                         plane.notes, {}),
                 std::logic_error);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    Plane other;
    other.state.secant_step.setOnes(other.model.unknowns(), 1);
    other.state.secant_step(3, 0) = static_cast<float>(bad);
    EXPECT_THROW(model::write_checkpoint(folder / "step-000001.hdf", other.model, other.state,
                                         other.notes, {}),
                 std::logic_error);
  }
}

TEST(StateFile, IsRefusedByTheSecantPairsThatDoNotFit) {
  const auto reason = [](auto&& spoil) {
    const support::TemporaryFolder folder;
    Plane plane;
    plane.state.secant_step.setOnes(plane.model.unknowns(), 3);
    plane.state.secant_change.setOnes(plane.model.unknowns(), 3);
    spoil(plane.state);
    const auto path = folder / "step-000000.hdf";
    model::write_checkpoint(path, plane.model, plane.state, plane.notes, {});
    record::CheckpointNotes notes;
    const files::Hdf5File file = record::open_checkpoint(path, notes);
    try {
      (void)model::read_state(file, plane.model);
    } catch (const files::FileError& failure) {
      return failure.reason();
    }
    return std::string("none");
  };
  EXPECT_EQ(reason([](model::State<2>&) {}), "none");
  EXPECT_EQ(reason([](model::State<2>& state) { state.secant_change.setOnes(7, 3); }),
            "/state/secants/change is not of at most 100 pairs of 192 unknowns each");
  EXPECT_EQ(reason([](model::State<2>& state) {
              state.secant_step.setOnes(192, 101);
              state.secant_change.setOnes(192, 101);
            }),
            "/state/secants/step is not of at most 100 pairs of 192 unknowns each");
  EXPECT_EQ(reason([](model::State<2>& state) { state.secant_change.resize(0, 0); }),
            "/state/secants/ holds steps without changes");
}

TEST(StateFile, OfAnotherModelIsRefusedByTheDatasetThatDoesNotFit) {
  const support::TemporaryFolder folder;
  Plane plane;
  const auto path = folder / "step-000000.hdf";
  model::write_checkpoint(path, plane.model, plane.state, plane.notes, {});
  scene::Scene finer = plane.scene;
  finer.geometry.spacing = 0.125;
  const model::Model<2> other = model::build_model<2>(finer);
  record::CheckpointNotes notes;
  const files::Hdf5File file = record::open_checkpoint(path, notes);
  try {
    (void)model::read_state(file, other);
    FAIL() << "read into a model of another size";
  } catch (const files::FileError& failure) {
    EXPECT_NE(failure.reason().find("/state/particles/displacement has the shape 96 x 2"),
              std::string::npos)
        << failure.reason();
  }
}

TEST(StateFile, HoldsAsManyBytesAsItSays) {
  const support::TemporaryFolder folder;
  Plane plane;
  const auto path = folder / "step-000000.hdf";
  model::write_checkpoint(path, plane.model, plane.state, plane.notes, {});
  EXPECT_GT(std::filesystem::file_size(path), model::bytes_of(plane.state));
}

TEST(Programme, OfAnUnchangedSceneIsNotTouched) {
  const scene::Scene scene = *scene::parse_scene(footing, "footing").scene;
  model::ProgrammeState programme{
      .step = 3, .load = 0.1, .next_increment = 0.05, .last_increment = 0.04};
  EXPECT_TRUE(model::adapt_programme(scene, scene, programme));
  EXPECT_EQ(programme.load, 0.1);
  EXPECT_EQ(programme.next_increment, 0.05);
  EXPECT_EQ(programme.last_increment, 0.04);
}

TEST(Programme, OfATargetTwiceAsFarHasHalfTheLoadAndTheSameSteps) {
  const scene::Scene scene = *scene::parse_scene(footing, "footing").scene;
  scene::Scene further = scene;
  further.drive.target = 2.0 * scene.drive.target;
  model::ProgrammeState programme{.load = 0.5, .next_increment = 0.25, .last_increment = 0.125};
  EXPECT_TRUE(model::adapt_programme(scene, further, programme));
  EXPECT_EQ(programme.load, 0.25);
  EXPECT_EQ(programme.next_increment, 0.125);
  EXPECT_EQ(programme.last_increment, 0.0625);
}

TEST(Programme, UnderOtherRulesBeginsWithTheNominalStep) {
  const scene::Scene scene = *scene::parse_scene(footing, "footing").scene;
  scene::Scene other = scene;
  other.programme.steps = 40;
  model::ProgrammeState programme{.load = 0.5, .next_increment = 0.25, .easy_steps = 3};
  EXPECT_TRUE(model::adapt_programme(scene, other, programme));
  EXPECT_EQ(programme.next_increment, 0.0);
  EXPECT_EQ(programme.easy_steps, 0);
}

}  // namespace
}  // namespace restart
