#include "wiring/checkpoint.hpp"

#include <fmt/format.h>

#include <boost/archive/text_iarchive.hpp>
#include <boost/archive/text_oarchive.hpp>
#include <boost/serialization/vector.hpp>
#include <sstream>

#include "constitutive/serialization.hpp"
#include "wiring/durable_file.hpp"
#include "wiring/file_seal.hpp"
#include "wiring/particle_fields.hpp"
#include "wiring/scene_print.hpp"
#include "wiring/scene_reader.hpp"
#include "wiring/state_file.hpp"
#include "wiring/version.hpp"

namespace wiring {

namespace {

// The load parameter of a state that stands at a new target, computed by a division.
constexpr double load_round_off = 1e-12;

std::vector<constitutive::MaterialParameters> parameters_of(const Scene& scene) {
  std::vector<constitutive::MaterialParameters> all;
  for (const Material& material : scene.material) all.push_back(material_parameters(material));
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
    throw FileError(path, fmt::format("/meta/materials cannot be read: {}", failure.what()));
  }
  return parameters;
}

}  // namespace

CheckpointNotes notes_for(const Scene& scene) {
  CheckpointNotes notes;
  notes.title = scene.title;
  notes.scene = effective_toml(scene);
  notes.materials = archived(parameters_of(scene));
  notes.versions = fmt::format("fpm-run {}, {}", version, library_versions);
  notes.dimension = scene.geometry.dimension;
  return notes;
}

template <int Dim>
void write_checkpoint(const std::filesystem::path& path, const Model<Dim>& model, State<Dim>& state,
                      const CheckpointNotes& notes, std::span<const PointField> fields, int deflate,
                      const SystemCalls& system) {
  const auto fill = [&](const std::filesystem::path& temporary) {
    const Hdf5Layout layout{.deflate = deflate, .user_block = seal_size};
    Hdf5File file = Hdf5File::create(temporary, layout, system);
    ContentDigest digest;
    write_notes(file, notes, digest);
    write_state(file, state, digest);
    write_vtkhdf(file, current_points(model, state), fields);
    write_digest(file, digest);
    file.close();
    write_seal(temporary, checkpoint_schema, notes.versions, system);
    CheckpointNotes read_back;
    (void)open_just_sealed(temporary, read_back);
    if (read_back.digest != digest.value()) {
      throw FileError(temporary, "does not read back as it was written");
    }
  };
  write_durably(path, fill, system);
}

Scene scene_of(const std::filesystem::path& path, const CheckpointNotes& notes) {
  SceneReading reading = parse_scene(notes.scene, path.string() + ":/meta/scene");
  if (!reading.scene) {
    const std::string first = reading.errors.empty() ? "" : reading.errors.front().text();
    throw FileError(path, "/meta/scene is no scene of this program: " + first);
  }
  if (restored(path, notes.materials) != parameters_of(*reading.scene)) {
    throw FileError(path, "/meta/materials are not the materials of /meta/scene");
  }
  return std::move(*reading.scene);
}

bool adapt_programme(const Scene& former, const Scene& scene, ProgrammeState& programme) {
  if (former.programme != scene.programme) {
    programme.next_increment = 0.0;  // the nominal one
    programme.easy_steps = 0;
  }
  const bool displaced = scene.drive.kind == DriveKind::displacement;
  if (!displaced || former.drive.target == scene.drive.target) return true;
  const double ratio = former.drive.target / scene.drive.target;
  programme.load *= ratio;
  programme.next_increment *= ratio;
  programme.last_increment *= ratio;
  if (programme.load > 1.0 + load_round_off) return false;
  if (programme.load > 1.0 - load_round_off) programme.load = 1.0;
  return true;
}

template void write_checkpoint<2>(const std::filesystem::path&, const Model<2>&, State<2>&,
                                  const CheckpointNotes&, std::span<const PointField>, int,
                                  const SystemCalls&);
template void write_checkpoint<3>(const std::filesystem::path&, const Model<3>&, State<3>&,
                                  const CheckpointNotes&, std::span<const PointField>, int,
                                  const SystemCalls&);

}  // namespace wiring
