#pragma once

#include <filesystem>

#include "limit/bracket/bracket.hpp"

namespace limit {

/// Writes the stress field of a lower bound for ParaView (VTKHDF, triangles with points of their
/// own): stress [Pa], principal stresses and the direction of the larger one, utilisation (Mohr's
/// radius over the one that yields).
/// @throws files::FileError
void write_fields(const std::filesystem::path& file, const problem::Case& problem,
                  const bracket::Bound<certificate::LowerCertificate>& bound);

/// Writes the velocity field of an upper bound (quadratic triangles with points of their own):
/// velocity over that of the footing, dissipation per area [Pa/m per unit velocity] in the cells,
/// half of the jumps around a triangle included.
void write_fields(const std::filesystem::path& file, const problem::Case& problem,
                  const bracket::Bound<certificate::UpperCertificate>& bound);

/// Draws the mechanism of an upper bound as an SVG: the mesh carried on by the velocities, dark
/// where much is dissipated.
void write_mechanism(const std::filesystem::path& file, const problem::Case& problem,
                     const bracket::Bound<certificate::UpperCertificate>& bound);

}  // namespace limit
