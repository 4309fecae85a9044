#include "model/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/archive/text_iarchive.hpp>
#include <boost/archive/text_oarchive.hpp>
#include <boost/serialization/vector.hpp>
#include <sstream>

#include "constitutive/serialization.hpp"
#include "files/durable_file.hpp"
#include "files/file_seal.hpp"
#include "model/build.hpp"
#include "model/particle_fields.hpp"
#include "model/state_file.hpp"
#include "scene/course.hpp"
#include "scene/derived.hpp"
#include "scene/drives.hpp"
#include "scene/element_body.hpp"
#include "scene/ground.hpp"
#include "scene/print.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "scene/stages.hpp"

namespace model {

namespace {

// The load parameter of a state that stands at a new target, computed by a division.
constexpr double load_round_off = 1e-12;

// Before this schema materials were one body, `auto` meant the correction for jitter alone, and a
// side was held by the particles next to it unless the scene said otherwise.
constexpr std::int64_t schema_of_bodies = 5;

void hold_directly(scene::Scene& scene) {
  for (scene::Support& support : scene.support) {
    if (support.method == scene::SupportMethod::automatic) {
      support.method = scene::SupportMethod::direct;
    }
  }
  if (scene.drive.method == scene::DriveMethod::automatic) {
    scene.drive.method = scene::DriveMethod::direct;
  }
}

// Before this schema a load that grows had the controls of a displacement.
constexpr std::int64_t schema_of_load_control = 6;

void control_as_if_driven(scene::Scene& scene) {
  if (scene.drive.kind != scene::DriveKind::load) return;
  scene::Scene driven = scene;
  driven.drive.kind = scene::DriveKind::displacement;
  scene.hourglass.control = scene::resolve_control(driven);
  if (scene.hourglass.control == scene::HourglassControl::incremental) {
    scene.hourglass.stiffness_ratio = scene::resolve_stiffness_ratio(driven);
  }
}

// Before this schema stages that try the ground had the controls of a displacement, and ground was
// settled with those of the run.
constexpr std::int64_t schema_of_stage_control = 10;

void control_as_if_untried(scene::Scene& scene) {
  if (std::ranges::none_of(scene.material, scene::yields)) return;
  scene::Scene untried = scene;
  for (scene::Stage& stage : untried.stage) {
    scene::Stage other;
    other.reduction = stage.reduction;
    other.drive = stage.drive;
    stage = other;
  }
  scene.hourglass.control = scene::resolve_control(untried);
  const bool is_alone = scene.hourglass.control == scene::HourglassControl::incremental;
  if (is_alone && scene::tries_ground(scene)) {
    scene.hourglass.stiffness_ratio = scene::resolve_stiffness_ratio(untried);
  }
}

// Before this schema the footings that are now tied were contacts by name.
constexpr std::int64_t schema_of_ties = 8;

void tie_footing(scene::Scene& scene) {
  const auto footing = scene::footing_of(scene);
  scene::Drive* drive = scene::drive_of_footing(scene);
  if (!footing || drive == nullptr || drive->method != scene::DriveMethod::contact) return;
  const scene::OutlineSide& side = scene.side[*footing];
  const bool had_images = !scene::is_solid(scene) && !scene::comes_later(scene, *drive);
  if (!had_images && side.base == scene::Base::rough && side.tension) {
    drive->method = scene::DriveMethod::tied;
  }
}

void keep_one_body(scene::Scene& scene) {
  if (scene.material.size() > 1) scene.approximation.interfaces = scene::InterfaceKind::through;
  if (scene.approximation.consistency == scene::Switch::automatic &&
      scene::resolve_consistency(scene) && scene.geometry.jitter == 0.0) {
    scene.approximation.consistency = scene::Switch::off;
  }
}

std::vector<constitutive::MaterialParameters> parameters_of(const scene::Scene& scene) {
  std::vector<constitutive::MaterialParameters> all;
  for (const scene::Material& material : scene.material)
    all.push_back(scene::parameters_of(material));
  return all;
}

std::string archived(const std::vector<constitutive::MaterialParameters>& parameters) {
  std::ostringstream text;
  boost::archive::text_oarchive archive(text);
  archive << parameters;
  return text.str();
}

std::vector<constitutive::MaterialParameters> restored(const std::filesystem::path& path,
                                                       const std::string& text) {
  std::vector<constitutive::MaterialParameters> parameters;
  try {
    std::istringstream stream(text);
    boost::archive::text_iarchive archive(stream);
    archive >> parameters;
  } catch (const std::exception& failure) {  // Boost's, or what its containers throw
    throw files::FileError(path, fmt::format("/meta/materials cannot be read: {}", failure.what()));
  }
  return parameters;
}

}  // namespace

record::CheckpointNotes notes_for(const scene::Scene& scene) {
  record::CheckpointNotes notes;
  notes.title = scene.title;
  notes.scene = scene::effective_toml(scene);
  notes.materials = archived(parameters_of(scene));
  notes.dimension = scene.geometry.dimension;
  return notes;
}

template <int Dim>
void write_checkpoint(const std::filesystem::path& path, const Model<Dim>& model, State<Dim>& state,
                      const record::CheckpointNotes& notes,
                      std::span<const files::PointField> fields, int deflate,
                      const files::SystemCalls& system) {
  const auto fill = [&](const std::filesystem::path& temporary) {
    const files::Hdf5Layout layout{.deflate = deflate, .user_block = files::seal_size};
    files::Hdf5File file = files::Hdf5File::create(temporary, layout, system);
    files::ContentDigest digest;
    record::write_notes(file, notes, digest);
    write_state(file, state, digest);
    files::write_vtkhdf(file, current_points(model, state), fields);
    record::write_digest(file, digest);
    file.close();
    files::write_seal(temporary, record::checkpoint_schema, notes.versions, system);
    record::CheckpointNotes read_back;
    (void)record::open_just_sealed(temporary, read_back);
    if (read_back.digest != digest.value()) {
      throw files::FileError(temporary, "does not read back as it was written");
    }
  };
  write_durably(path, fill, system);
}

scene::Scene scene_of(const std::filesystem::path& path, const record::CheckpointNotes& notes) {
  const scene::SceneReading reading =
      scene::parse_scene(notes.scene, path.string() + ":/meta/scene");
  if (!reading.scene) {
    const std::string first = reading.errors.empty() ? "" : reading.errors.front().text();
    throw files::FileError(path, "/meta/scene is no scene of this program: " + first);
  }
  scene::Scene scene = *reading.scene;
  if (notes.schema < schema_of_bodies) {
    hold_directly(scene);
    keep_one_body(scene);
  }
  if (notes.schema < schema_of_load_control) control_as_if_driven(scene);
  if (notes.schema < schema_of_stage_control) control_as_if_untried(scene);
  if (notes.schema < schema_of_ties) tie_footing(scene);
  if (restored(path, notes.materials) != parameters_of(scene)) {
    throw files::FileError(path, "/meta/materials are not the materials of /meta/scene");
  }
  return scene;
}

bool adapt_programme(const scene::Scene& former, const scene::Scene& scene,
                     ProgrammeState& programme) {
  if (former.programme != scene.programme) {
    programme.next_increment = 0.0;  // the nominal one
    programme.easy_steps = 0;
  }
  // Of the drive in force.
  const auto stage = static_cast<std::size_t>(programme.stage);
  const scene::Drive now = scene::scene_of_stage(scene, stage).drive;
  const scene::Drive then = scene::scene_of_stage(former, stage).drive;
  if (now.kind != scene::DriveKind::displacement || then.target == now.target) return true;
  const double ratio = then.target / now.target;
  programme.load *= ratio;
  if (!scene.stage.empty()) return true;  // their progress is of the way of each
  programme.next_increment *= ratio;
  programme.last_increment *= ratio;
  if (programme.load > 1.0 + load_round_off) return false;
  if (programme.load > 1.0 - load_round_off) programme.load = 1.0;
  programme.progress = programme.load;
  return true;
}

template void write_checkpoint<2>(const std::filesystem::path&, const Model<2>&, State<2>&,
                                  const record::CheckpointNotes&,
                                  std::span<const files::PointField>, int,
                                  const files::SystemCalls&);
template void write_checkpoint<3>(const std::filesystem::path&, const Model<3>&, State<3>&,
                                  const record::CheckpointNotes&,
                                  std::span<const files::PointField>, int,
                                  const files::SystemCalls&);

}  // namespace model
