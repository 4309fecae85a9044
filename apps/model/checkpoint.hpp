#pragma once

#include <filesystem>
#include <span>

#include "files/vtkhdf.hpp"
#include "model/model.hpp"
#include "model/state.hpp"
#include "record/checkpoint_file.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// The notes of a scene's checkpoints; versions, reason, lineage, time and history remain to be
/// set.
[[nodiscard]] record::CheckpointNotes notes_for(const scene::Scene& scene);

/// Writes a checkpoint durably: the name holds either its old content or a whole new checkpoint
/// that has been read back once. ParaView opens it by `fields`.
/// @param deflate  compression, see Hdf5Layout
/// @throws std::logic_error if the state is not finite; FileError.
template <int Dim>
void write_checkpoint(const std::filesystem::path& path, const Model<Dim>& model, State<Dim>& state,
                      const record::CheckpointNotes& notes,
                      std::span<const files::PointField> fields, int deflate = 0,
                      const files::SystemCalls& system = files::system_calls());

/// The scene a checkpoint was written with.
/// @throws FileError if the notes hold no such scene, or if the materials this program makes of it
/// are not those the checkpoint archived.
[[nodiscard]] scene::Scene scene_of(const std::filesystem::path& path,
                                    const record::CheckpointNotes& notes);

/// Makes the load programme of a run under `former` that of `scene`: the load parameter of a driven
/// displacement is a fraction of its target, and other rules for the steps begin with their nominal
/// one. Where neither differs nothing changes.
/// @return false if the programme is already beyond the target of `scene`
[[nodiscard]] bool adapt_programme(const scene::Scene& former, const scene::Scene& scene,
                                   ProgrammeState& programme);

}  // namespace model
