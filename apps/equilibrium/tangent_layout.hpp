#pragma once

#include "equilibrium/lanes.hpp"

namespace equilibrium {

/// Where the entries of the tangents of all particles lie: those of the particles of a register
/// side by side, so that applying them reads memory in order.
template <int Size>
struct TangentLayout {
  static Eigen::Index total(Eigen::Index particles) {
    return (particles + lane_count - 1) / lane_count * lane_count * Size;
  }
  static Eigen::Index at(Eigen::Index particle, int entry) {
    const Eigen::Index lane = particle % lane_count;
    return (particle - lane) * Size + Eigen::Index{entry} * lane_count + lane;
  }
  static void put(double* tangents, Eigen::Index particle, const double* entries) {
    for (int k = 0; k < Size; ++k) tangents[at(particle, k)] = entries[k];
  }
  static void put(double* tangents, Eigen::Index particle, const Lanes* entries) {
    for (int k = 0; k < Size; ++k) {
      for (int lane = 0; lane < lane_count; ++lane) {
        tangents[at(particle + lane, k)] = entries[k][lane];
      }
    }
  }
};

/// Layouts of d(P, T) / d(gradient, second gradient) and of dQ / d(gradient).
template <int Size>
using StressTangents = TangentLayout<Size * Size>;
template <int Dim>
using RotationTangents = TangentLayout<Dim * Dim * Dim * Dim>;

}  // namespace equilibrium
