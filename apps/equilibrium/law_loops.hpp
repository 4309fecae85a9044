#pragma once

#include <vector>

#include "constitutive/material.hpp"
#include "equilibrium/arrays.hpp"
#include "fpm/moment_operator.hpp"
#include "model/material_index.hpp"
#include "model/state.hpp"

namespace equilibrium {

/// What the loops over particles work on.
template <int Dim>
struct LoopData {
  const fpm::MomentOperator<Dim>& op;
  const std::vector<constitutive::Material>& laws;
  const std::vector<model::LawIndex>& law_of;  // of each particle
  model::State<Dim>& state;                    // changed by `commit` alone
  const StepArrays<Dim>& step;
  EvaluationArrays<Dim>& evaluation;
  TangentArrays& tangents;
};

/// Whether a loop could evaluate every particle.
struct [[nodiscard]] LoopOutcome {
  fpm::Index failed = -1;  // the lowest index of a particle that could not be evaluated, or -1
  bool ok() const { return failed < 0; }
};

/// The loops over particles of one local law (kinematics and integration), chosen once per run.
template <int Dim>
struct LawLoops {
  LoopOutcome (*respond)(const LoopData<Dim>&);    // field -> generalised stresses
  LoopOutcome (*linearise)(const LoopData<Dim>&);  // field -> tangents
  void (*apply)(const LoopData<Dim>&);             // field, tangents -> changes of the stresses
  LoopOutcome (*commit)(const LoopData<Dim>&);     // field -> end-of-step state
};

template <int Dim, bool Finite>
struct PlainLaw;
template <int Dim, bool Finite>
struct MixedLaw;

/// The loops of a law; instantiated law by law in instances/.
template <int Dim, class Law>
LawLoops<Dim> law_loops();

}  // namespace equilibrium
