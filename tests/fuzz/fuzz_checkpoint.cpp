// The bytes of a checkpoint file, as a damaged disk may hand them out: read as a resumed run reads
// them, and as fpm-info asks what they are.
#include "memory_file.hpp"
#include "wiring/checkpoint.hpp"
#include "wiring/file_seal.hpp"
#include "wiring/scene_derived.hpp"
#include "wiring/state_file.hpp"

namespace {

template <int Dim>
void read_as_a_run_does(const wiring::Hdf5File& file, const wiring::Scene& scene) {
  constexpr std::int64_t most_particles = 1000;  // a fuzzer has no time for more
  if (wiring::particle_count(scene.geometry) > most_particles) return;
  const auto model = wiring::build_model<Dim>(scene);
  (void)wiring::read_state(file, model);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::MemoryFile memory(data, size);
  const auto path = memory.path();
  // What has no seal is read by a child process, on which HDF5 may fall: no finding, and too slow.
  if (!wiring::has_seal(path)) return 0;
  try {
    if (!wiring::is_checkpoint(path)) return 0;
    wiring::CheckpointNotes notes;
    const wiring::Hdf5File file = wiring::open_checkpoint(path, notes);
    const wiring::Scene scene = wiring::scene_of(path, notes);
    if (scene.geometry.dimension == 2) read_as_a_run_does<2>(file, scene);
    if (scene.geometry.dimension == 3) read_as_a_run_does<3>(file, scene);
  } catch (const wiring::FileError&) {
    // refused with its reason
  }
  return 0;
}
