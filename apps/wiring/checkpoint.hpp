#pragma once

#include <filesystem>
#include <span>

#include "wiring/checkpoint_file.hpp"
#include "wiring/model.hpp"
#include "wiring/state.hpp"
#include "wiring/vtkhdf.hpp"

namespace wiring {

/// The notes of a scene's checkpoints; reason, lineage, time and history remain to be set.
[[nodiscard]] CheckpointNotes notes_for(const Scene& scene);

/// Writes a checkpoint durably: the name holds either its old content or a whole new checkpoint
/// that has been read back once. ParaView opens it by `fields`.
/// @param deflate  compression, see Hdf5Layout
/// @throws std::logic_error if the state is not finite; FileError.
template <int Dim>
void write_checkpoint(const std::filesystem::path& path, const Model<Dim>& model, State<Dim>& state,
                      const CheckpointNotes& notes, std::span<const PointField> fields,
                      int deflate = 0, const SystemCalls& system = system_calls());

/// The scene a checkpoint was written with.
/// @throws FileError if the notes hold no such scene, or if the materials this program makes of it
/// are not those the checkpoint archived.
[[nodiscard]] Scene scene_of(const std::filesystem::path& path, const CheckpointNotes& notes);

/// Makes the load programme of a run under `former` that of `scene`: the load parameter of a driven
/// displacement is a fraction of its target, and other rules for the steps begin with their nominal
/// one. Where neither differs nothing changes.
/// @return false if the programme is already beyond the target of `scene`
[[nodiscard]] bool adapt_programme(const Scene& former, const Scene& scene,
                                   ProgrammeState& programme);

}  // namespace wiring
