#pragma once

#include "prepared.hpp"

namespace benchmarks {

/// Bytes per particle that each kernel must move between memory and processor.
///
/// The model: every array is read once and written once per pass over the particles, as if a cache
/// kept whatever one pass uses again (neighbours' values, the buffers of a block) and nothing from
/// pass to pass; a written line is not fetched first. STREAM counts its triad alike (24 bytes per
/// element), so bytes over time compare with it directly. Ghosts, vectors over the grid of the
/// preconditioner and tables of constant size are left out. A body that fits a cache moves less.
struct Traffic {
  double gather = 0.0;          // forward layout, field
  double scatter = 0.0;         // transposed layout, stresses, the two fields of pairs, force
  double residual = 0.0;        // both, the particles' state, and the passes over vectors
  double linearise = 0.0;       // gather, state, tangents written
  double action = 0.0;          // both, tangents read, and the passes over vectors
  double preconditioner = 0.0;  // blocks once, interpolation and factor twice, vectors
};

/// The traffic of a prepared body.
template <int Dim>
Traffic traffic_of(const Prepared<Dim>& p) {
  constexpr double number = sizeof(double);
  constexpr double single = sizeof(float);  // of tangents
  constexpr double field = Dim * number;    // one vector over the unknowns
  constexpr double tensor = Dim * Dim * number;
  constexpr double flags = Dim;  // of prescribed unknowns
  const auto n = static_cast<double>(p.model.size());
  const auto& op = p.equilibrium.moment_operator();
  const auto& layout = p.model.layout;
  const bool pairs = p.model.channels.pair;
  const double stress = op.stress_count() * number;

  // The operator's memory is its forward layout, the transposed one of the same entries, and the
  // moments of the pairs' weights.
  const double pair_moments = pairs ? field + tensor : 0.0;
  const double one_layout = 0.5 * (static_cast<double>(op.bytes()) / n - pair_moments);

  // What a particle knows at the beginning of a step.
  constexpr int second = fpm::SecondGradient<Dim>::SizeAtCompileTime;
  double state = (constitutive::stress_size<Dim> + 1) * number + 1.0;  // stress, volume, material
  if (layout.finite) state += tensor;
  if (layout.plastic) state += 2.0 * number;
  if (layout.subpoints) state += (second + model::State<Dim>::subpoint_rows) * number;
  // What its row knows of its pairs: stiffness, moments, memory, position, gradient; own force out.
  double pair_row = pairs ? number + pair_moments + (field + tensor) + field + tensor + field : 0.0;
  if (layout.incremental) pair_row += number;

  const double strain = Dim * Dim + (layout.subpoints ? second : 0);
  const double tangent = strain * strain * single;
  const double rotation = layout.incremental ? Dim * Dim * Dim * Dim * single : 0.0;
  const double released = layout.incremental ? p.state.released.mean() : 0.0;

  Traffic t;
  t.gather = one_layout + field;
  t.scatter = one_layout + stress + (pairs ? 2.0 * field : 0.0) + field;
  const double extend = 2.0 * field;
  const double assemble = (pairs ? 3.0 : 2.0) * field;
  // After assembly: less external load (3), its norm (1), masking into the residual (2).
  t.residual =
      extend + t.gather + state + pair_row + stress + t.scatter + assemble + 6.0 * field + flags;
  t.linearise = extend + 2.0 * field + t.gather + state + tangent + rotation;
  t.action = extend + t.gather + tangent + released * rotation + pair_row + stress + t.scatter +
             assemble + flags;
  // Vectors: blocks (2), restriction (1), prolongation (2).
  t.preconditioner =
      2.0 * static_cast<double>(p.preconditioner.bytes()) / n - tensor + 5.0 * field + 2.0 * flags;
  return t;
}

}  // namespace benchmarks
