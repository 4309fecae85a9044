#pragma once

#include <array>

#include "jfnk/residual.hpp"

// The noise of F from a table of differences (ECNoise: Moré & Wild 2011).
namespace jfnk::detail {

/// Equally spaced points on a line, and random projections of F at each.
inline constexpr int noise_points = 7;
inline constexpr int noise_projections = 4;
using NoiseSamples = std::array<std::array<double, noise_points>, noise_projections>;

/// +1 or -1, the same in every run; `stream` chooses among sequences.
[[nodiscard]] double random_sign(Eigen::Index i, int stream);

/// A unit vector of random signs.
void random_direction(int stream, const InnerProductRef& product, Vector& direction);

/// Projections of r on random signs, which turn ||noise|| into the deviation of a number.
/// @param signs  overwritten
void project_sample(const Vector& r, int point, const InnerProductRef& product, Vector& signs,
                    NoiseSamples& samples);

enum class NoiseVerdict { found, step_too_small, step_too_large };

/// The level at which three orders of differences agree to a factor of four while signs change.
/// @param[out] noise  its norm, if it was found
[[nodiscard]] NoiseVerdict judge_noise(NoiseSamples table, double& noise);

}  // namespace jfnk::detail
