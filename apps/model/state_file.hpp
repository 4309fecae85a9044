#pragma once

#include "files/content_digest.hpp"
#include "files/hdf5_file.hpp"
#include "model/model.hpp"
#include "model/state.hpp"
#include "record/checkpoint_file.hpp"

namespace model {

/// Writes every primary field of a state below /state, each with its unit, one row per particle:
/// all that State, Rows and ProgrammeState list, so that none can be forgotten. (The state is not
/// changed; its visitors are not const.)
/// @param digest  takes in what is written
/// @throws std::logic_error naming the field that is not finite: such a state must not be kept.
template <int Dim>
void write_state(files::Hdf5File& file, State<Dim>& state, files::ContentDigest& digest);

/// Reads what write_state wrote, into the layout of the model.
/// @param schema  of the checkpoint; what an older one lacks is taken from elsewhere in the file
/// @throws FileError naming the dataset that is missing, of another size, not finite or
/// contradicted by another.
template <int Dim>
State<Dim> read_state(const files::Hdf5File& file, const Model<Dim>& model,
                      std::int64_t schema = record::checkpoint_schema);

/// Memory of the primary fields [bytes]; a checkpoint's bulk is as large.
template <int Dim>
std::size_t bytes_of(State<Dim>& state);

}  // namespace model
