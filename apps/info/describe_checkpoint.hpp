#pragma once

#include <string>

#include "record/checkpoint_file.hpp"

namespace info {

/// What a checkpoint is, when, why and by which versions it was written, from which others it
/// comes, and what a run that goes on from it may change.
[[nodiscard]] std::string describe_checkpoint(const record::CheckpointNotes& notes);

/// One line: step, load, when and why.
[[nodiscard]] std::string checkpoint_line(const record::CheckpointNotes& notes);

}  // namespace info
