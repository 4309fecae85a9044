#pragma once

#include <array>

#include "forcing.hpp"

namespace jfnk::detail {

/// What an iteration of a stage came to.
enum class Ending {
  go_on,
  converged,
  schedule_done,         ///< the iterations allowed were made
  patience_lost,         ///< multisecant only
  line_search_failed,    ///< Newton only
  stagnated,             ///< Newton only: steps hardly lower ||F|| any more
  krylov_stalled,        ///< Newton only
  linearisation_failed,  ///< Newton only
  transient_failed,      ///< pseudo-transient only
  stopped,
  limit,
  noise_floor,  ///< ||F|| is at its noise, above the tolerance
  stationary    ///< Newton only: ||F|| is stationary, but no root
};

/// Whether nothing more may be evaluated after such an ending.
[[nodiscard]] inline bool is_final(Ending ending) {
  return ending == Ending::converged || ending == Ending::stopped || ending == Ending::limit ||
         ending == Ending::noise_floor;
}

/// What the solver is at.
enum class Stage { multisecant, newton, pseudo_transient, ended };

/// Counts the members that a list names; those that are lists themselves count as one.
struct FieldCounter {
  int count = 0;
  template <class Field>
  void operator()(Field&) {
    ++count;
  }
};

/// What lists its fields itself.
template <class T>
concept Listed = requires(T& part, FieldCounter& visit) {
  part.for_each_field(visit);
};

// Each part of the course lists its fields once, in `for_each_field`: snapshots walk these lists,
// and a test counts the members against them.

/// The stage that goes on.
struct StageCourse {
  Stage kind = Stage::ended;
  int iterations = 0;
  int limit = 0;            ///< of iterations
  int round = 0;            ///< of the hybrid, which the stage belongs to
  double start_norm = 0.0;  ///< lowest ||F|| when the stage began
  int start_evaluations = 0;

  template <class Visitor>
  void for_each_field(Visitor& visit) {
    visit(kind);
    visit(iterations);
    visit(limit);
    visit(round);
    visit(start_norm);
    visit(start_evaluations);
  }
};

/// Of the multisecant stages.
struct MultisecantCourse {
  double mark = 0.0;  ///< see Multisecant::patience
  int last_fall = 0;  ///< evaluations at the mark
  int wild = 0;       ///< points in a row far above the best
  double mixing = 1.0;
  bool mixing_known = false;
  double expected_change = 0.0;  ///< of F in the first step, if an action foretold it
  double lead = 0.0;             ///< of least squares over Broyden; see Multisecant::broyden
  double broyden_error = 0.0;    ///< likewise
  bool inverted = false;         ///< work.by_broyden belongs to work.base
  bool preconditioned = false;   ///< and so does work.preconditioned

  template <class Visitor>
  void for_each_field(Visitor& visit) {
    visit(mark);
    visit(last_fall);
    visit(wild);
    visit(mixing);
    visit(mixing_known);
    visit(expected_change);
    visit(lead);
    visit(broyden_error);
    visit(inverted);
    visit(preconditioned);
  }
};

/// Of the Newton stages.
struct NewtonCourse {
  ForcingState forcing;
  double radius = 0.0;  ///< of the dogleg; 0: none
  std::array<double, 10> last_norms{};
  int last_norms_count = 0;
  double window_norm = 0.0;  ///< ||F|| at the beginning of the window of stagnation
  int window_steps = 0;
  int poor_steps = 0;          ///< in a row, that kept little of what the linear model promised
  int short_steps = 0;         ///< in a row, shorter than the rounding of u
  bool by_lines = false;       ///< line searches only
  bool by_full_steps = false;  ///< no search, and a new preconditioner at every step
  int since_best = 0;          ///< full steps since the last lowest ||F||
  double highest_full = 0.0;   ///< ||F|| after the first steps of an early try of full steps
  double lowest_full = 0.0;    ///< and the lowest since
  int left_domain = 0;         ///< trials of the last step where F had no value
  double feasible = 0.0;       ///< length of the last step that had to be cut by them; 0: none

  template <class Visitor>
  void for_each_field(Visitor& visit) {
    visit(forcing);
    visit(radius);
    visit(last_norms);
    visit(last_norms_count);
    visit(window_norm);
    visit(window_steps);
    visit(poor_steps);
    visit(short_steps);
    visit(by_lines);
    visit(by_full_steps);
    visit(since_best);
    visit(highest_full);
    visit(lowest_full);
    visit(left_domain);
    visit(feasible);
  }
};

/// What has been tried when Newton failed.
struct RescueCourse {
  Ending newton_failure = Ending::go_on;  ///< the first one, which the rescues shall mend
  double trouble_norm = 0.0;              ///< ||F|| where Report::trouble was met
  double minimum_norm = 0.0;  ///< ||F|| at a minimum that a search has ended in; 0: none yet
  bool noise_measured = false;
  double noise_norm = 0.0;  ///< ||F|| where that was
  bool restarted = false;
  bool transient_tried = false;
  bool early_full_steps = false;  ///< were tried, or are
  bool last_full_steps = false;
  int round_cost = 0;  ///< evaluations of the last round of Newton; 0: none yet

  template <class Visitor>
  void for_each_field(Visitor& visit) {
    visit(newton_failure);
    visit(trouble_norm);
    visit(minimum_norm);
    visit(noise_measured);
    visit(noise_norm);
    visit(restarted);
    visit(transient_tried);
    visit(early_full_steps);
    visit(last_full_steps);
    visit(round_cost);
  }
};

/// Of the pseudo-transient stage.
struct TransientCourse {
  double time_step = 0.0;
  double shift_sign = 1.0;
  int idle_steps = 0;  ///< in a row, that hardly changed ||F||

  template <class Visitor>
  void for_each_field(Visitor& visit) {
    visit(time_step);
    visit(shift_sign);
    visit(idle_steps);
  }
};

/// Of the preconditioner, the caller's or the learnt one.
struct PreconditionerCourse {
  int setup_evaluations = 0;     ///< counts at the last setup
  double setup_norm = 0.0;       ///< lowest ||F|| at the last setup
  double setup_best_rate = 0.0;  ///< gain per evaluation soon after it
  int stale = 0;                ///< Krylov iterations since then that new factors would have spared
  bool doubted = false;         ///< a round without it was tried
  bool suspended = false;       ///< such a round goes on
  bool learning_tried = false;  ///< and there is no more to be had; see Learning
  bool pattern_known = false;   ///< of the Jacobian to be learnt
  int groups = 0;               ///< products that it then costs; 0: not known
  int next_try = 0;             ///< evaluations before another

  template <class Visitor>
  void for_each_field(Visitor& visit) {
    visit(setup_evaluations);
    visit(setup_norm);
    visit(setup_best_rate);
    visit(stale);
    visit(doubted);
    visit(suspended);
    visit(learning_tried);
    visit(pattern_known);
    visit(groups);
    visit(next_try);
  }
};

/// Where a solve stands, besides its vectors and its report: all that decides what comes next.
struct Course {
  StageCourse stage;
  MultisecantCourse multisecant;
  NewtonCourse newton;
  RescueCourse rescue;
  TransientCourse transient;
  PreconditionerCourse preconditioner;

  template <class Visitor>
  void for_each_field(Visitor& visit) {
    visit(stage);
    visit(multisecant);
    visit(newton);
    visit(rescue);
    visit(transient);
    visit(preconditioner);
  }
};

}  // namespace jfnk::detail
