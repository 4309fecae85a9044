#pragma once

#include "equilibrium/lanes.hpp"

namespace equilibrium {

/// Where the entries of the tangents of all particles lie: those of the particles of a register
/// side by side, so that applying them reads memory in order. In single precision: what a Newton
/// step loses by that is a ten-millionth of it, and reading them is what an action waits for.
template <int Size>
struct TangentLayout {
  static constexpr int group = 8;  // particles side by side: the widest lanes

  static Eigen::Index total(Eigen::Index particles) {
    return (particles + group - 1) / group * group * Size;
  }
  static Eigen::Index at(Eigen::Index particle, int entry) {
    const Eigen::Index lane = particle % group;
    return (particle - lane) * Size + Eigen::Index{entry} * group + lane;
  }
  static void put(float* tangents, Eigen::Index particle, const double* entries) {
    for (int k = 0; k < Size; ++k) store(tangents + at(particle, k), entries[k]);
  }
  template <int Width>
  static void put(float* tangents, Eigen::Index particle, const Lanes<Width>* entries) {
    if (particle % group + Width <= group) {
      for (int k = 0; k < Size; ++k) store(tangents + at(particle, k), entries[k]);
      return;
    }
    for (int k = 0; k < Size; ++k) {
      for (int lane = 0; lane < Width; ++lane) {
        store(tangents + at(particle + lane, k), entries[k][lane]);
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
