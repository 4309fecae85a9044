#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "model/memory.hpp"
#include "record/curve.hpp"
#include "record/run_folder.hpp"

namespace scene {
struct Scene;
}

namespace model {
template <int Dim>
struct Model;
}

namespace run {

/// Particles, ghosts, memory and steps of a run that is not made, for --check.
/// @param parts  of the memory of a long run, the state's first
std::string check_report(const scene::Scene& scene, std::size_t particles, std::size_t ghosts,
                         const std::vector<model::MemoryPart>& parts);

/// The memory and the planned steps of a run in one line, for its picture.
std::string size_note(const scene::Scene& scene, const std::vector<model::MemoryPart>& parts);

/// One line for each face between two materials that is none, as a tip or a thin layer takes it
/// with it.
template <int Dim>
std::vector<std::string> joined_notes(const scene::Scene& scene, const model::Model<Dim>& model);

/// That K0 is not what the ground has at rest, if it is not by far.
template <int Dim>
std::vector<std::string> lateral_notes(const scene::Scene& scene, const model::Model<Dim>& model);

/// One line for each side on which water stands that the scene's pore pressures have there: how
/// high, and what it presses with. Of the stage at hand.
template <int Dim>
std::vector<std::string> water_notes(const scene::Scene& scene, const model::Model<Dim>& model);

/// That loads which grow were borne to the end by ground that yields, under a control that is weak
/// for the sake of a collapse; "" for any other run. Of the whole scene.
std::string control_note(const scene::Scene& scene, const record::CurveRow& last);

/// What a run came to, and where its files are.
/// @param measures  columns of the curve that the scene asks for
std::string end_report(const scene::Scene& scene, const std::vector<std::string>& measures,
                       const std::vector<record::CurveRow>& history, double elapsed,
                       const record::RunFolder& folder, const std::filesystem::path& checkpoint);

}  // namespace run
