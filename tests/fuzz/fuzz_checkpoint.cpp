// The bytes of a checkpoint file, as a damaged disk may hand them out: read as a resumed run reads
// them, and as fpm-info asks what they are.
#include "files/file_seal.hpp"
#include "memory_file.hpp"
#include "model/build.hpp"
#include "model/checkpoint.hpp"
#include "model/state_file.hpp"
#include "scene/derived.hpp"
#include "scene/scene.hpp"

namespace {

template <int Dim>
void read_as_a_run_does(const files::Hdf5File& file, const scene::Scene& scene,
                        std::int64_t schema) {
  constexpr std::int64_t most_particles = 1000;  // a fuzzer has no time for more
  if (scene::particle_count(scene.geometry) > most_particles) return;
  const auto model = model::build_model<Dim>(scene);
  (void)model::read_state(file, model, schema);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::MemoryFile memory(data, size);
  const auto path = memory.path();
  // What has no seal is read by a child process, on which HDF5 may fall: no finding, and too slow.
  if (!files::has_seal(path)) return 0;
  try {
    if (!record::is_checkpoint(path)) return 0;
    record::CheckpointNotes notes;
    const files::Hdf5File file = record::open_checkpoint(path, notes);
    const scene::Scene scene = model::scene_of(path, notes);
    if (scene.geometry.dimension == 2) read_as_a_run_does<2>(file, scene, notes.schema);
    if (scene.geometry.dimension == 3) read_as_a_run_does<3>(file, scene, notes.schema);
  } catch (const files::FileError&) {
    // refused with its reason
  }
  return 0;
}
