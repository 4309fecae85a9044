#pragma once

#include "evaluator.hpp"
#include "jfnk/gmres.hpp"
#include "jfnk/solver.hpp"
#include "secant_memory.hpp"

namespace jfnk::detail {

/// How a phase of the strategy ended.
enum class Ending {
  converged,
  schedule_done,         ///< the iterations allowed were made
  patience_lost,         ///< multisecant only
  line_search_failed,    ///< Newton only
  krylov_stalled,        ///< Newton only
  linearisation_failed,  ///< Newton only
  stopped,
  limit
};

/// Whether nothing more may be evaluated after such an ending.
[[nodiscard]] inline bool is_final(Ending ending) {
  return ending == Ending::converged || ending == Ending::stopped || ending == Ending::limit;
}

/// Vectors that live from solve to solve.
struct Workspace {
  Iterate base;   // where the phase stands
  Iterate trial;  // where it looks
  Iterate best;   // lowest norm so far
  Vector step;
  Vector direction;
  Vector probe;
  Gmres gmres;
  SecantMemory secants;
};

/// One solve: the problem, the choices, the workspace and the record, shared by the phases.
struct Solve {
  const Options& options;
  Evaluator& evaluator;
  const PreconditionerRef& preconditioner;
  const ObserverRef& observer;
  Workspace& work;
  Report& report;

  /// Adds a line to the history and shows it; false if the observer asks to stop.
  bool record(Iteration line, const Iterate& at) const;
  /// Copies `point` to the best iterate if it is lower, or if it is the `solution`: the reference
  /// norm may vary, so that a point which meets the tolerance need not have the lowest norm.
  void keep_if_best(const Iterate& point, bool solution) const;
  /// z = P r, counted.
  void precondition(const Vector& r, Vector& z) const;
};

/// Up to `max_steps` inexact Newton steps from the best iterate.
[[nodiscard]] Ending newton_phase(Solve& solve, int max_steps);

/// Multisecant iterations from the best iterate, until patience is lost.
[[nodiscard]] Ending multisecant_phase(Solve& solve, int max_iterations);

}  // namespace jfnk::detail
