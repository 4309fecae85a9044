#pragma once

#include <string>
#include <vector>

namespace jfnk {

/// The nonlinear strategy.
enum class Method {
  newton_krylov,  ///< inexact Newton, directions by GMRES, globalised by backtracking
  multisecant,    ///< preconditioned Anderson iteration, one residual per iteration
  hybrid          ///< rounds of multisecant rescued by Newton steps, then Newton alone
};

/// When the iteration has converged: the first line or the second, and the third.
struct Tolerances {
  /// ||F|| <= relative * reference; reference is ||F(u0)|| or the residual's own. Range [0, 1).
  double relative = 1e-6;
  /// ||F|| <= absolute. Unit of F, range [0, inf).
  double absolute = 0.0;
  /// ||du|| <= step * ||u|| of the last step, asked in addition (Chen, Huang & Lyamin 2020,
  /// Eq. 23); 0 asks nothing. Range [0, 1).
  double step = 0.0;
};

/// How accurately each linear system is solved: ||J du + F|| <= eta ||F||.
struct Forcing {
  enum class Rule {
    constant,          ///< eta = initial, always
    eisenstat_walker2  ///< eta = gamma (||F_k|| / ||F_{k-1}||)^alpha with their safeguard (1996)
  };
  Rule rule = Rule::eisenstat_walker2;
  /// eta of the first Newton step, and of all if constant. Range (0, 1).
  double initial = 0.3;
  /// Factor of eisenstat_walker2. Range (0, 1].
  double gamma = 0.9;
  /// Exponent of eisenstat_walker2. Range (1, 2].
  double alpha = 2.0;
  /// eta <= maximum. Range (0, 1).
  double maximum = 0.9;
  /// eta >= end_game * tolerance / ||F||: no more accuracy than the last step needs; 0 switches it
  /// off. Range [0, 1).
  double end_game = 0.5;
};

/// The linear solver of a Newton step.
struct Krylov {
  /// Columns kept before a restart; memory is restart + 1 vectors, of which only those used are
  /// touched. A restart below what a system needs costs several times the actions. Range [1, inf).
  int restart = 200;
  /// Upper bound on Jacobian actions per Newton step; the direction found is then used as it is.
  /// Range [1, inf).
  int max_iterations = 200;
  /// Keep the preconditioned vectors so that the preconditioner may vary (twice the memory).
  bool flexible = false;
  Forcing forcing;
};

/// Backtracking along a Newton direction: u + lambda du, lambda = 1, factor, factor^2, ...
struct Globalisation {
  /// lambda *= factor after a trial that did not reduce ||F|| enough (Chen, Huang & Lyamin 2020,
  /// Table A1). Range (0, 1).
  double factor = 0.8;
  /// lambda *= domain_factor after a trial out of the domain of F. Range (0, 1).
  double domain_factor = 0.5;
  /// Trials after the first before the search is given up. Range [0, inf).
  int max_cuts = 40;
  /// Accept if ||F(u + lambda du)|| <= (1 - sufficient_decrease lambda (1 - eta)) ||F(u)||
  /// (Eisenstat & Walker 1994); 0 is the simple decrease of the paper. Range [0, 1).
  double sufficient_decrease = 1e-4;
};

/// Where the products J v come from.
struct Jacobian {
  enum class Source {
    user_if_available,  ///< `apply_jacobian` of the residual if it has one, else differences
    finite_difference   ///< always (F(u + eps v) - F(u)) / eps
  };
  enum class Step {
    automatic,     ///< length_scale if that is positive, else generic
    generic,       ///< eps = b sqrt(1 + ||u||) / ||v|| (Knoll & Keyes 2004)
    length_scale,  ///< eps = b length_scale sqrt(n) / ||v||: free of the unit of u
    paper          ///< eps = (1 + ||v||) b ||u||, b (1 + ||v||) at u = 0 (the paper's Eq. 30)
  };
  Source source = Source::user_if_available;
  Step step = Step::automatic;
  /// b, the root of the relative error of F. Range (0, 1); 1.5e-8 is the root of the rounding unit.
  double noise = 1.5e-8;
  /// A change of each unknown that matters, such as the particle spacing. Unit of u, range [0,
  /// inf).
  double length_scale = 0.0;
  /// Evaluations tried at one v when F(u + eps v) is out of domain: the sign flips first, then eps
  /// shrinks tenfold. Range [1, inf).
  int max_attempts = 6;
};

/// Preconditioned Anderson iteration on the true residual.
struct Multisecant {
  /// Pairs (du, dF) kept: memory is twice that many vectors. Range [1, inf).
  int memory = 20;
  /// Given up after this many evaluations in which the best ||F|| did not fall below
  /// progress times its value at the last such fall. Range [1, inf).
  int patience = 10;
  /// See patience; 1 accepts any improvement. Range (0, 1].
  double progress = 1.0;
  /// A point with ||F|| > rejection * best ||F|| is left for the best one. Range (1, inf).
  double rejection = 30.0;
  /// Factor of the preconditioned remainder, u -= mixing P (F - dF gamma). Range (0, 1].
  double mixing = 1.0;
  /// Oldest pairs are dropped until the unit columns of dF have a condition estimate below this.
  /// Range (1, 1e15].
  double max_condition = 1e8;
  /// Halvings towards the best point after leaving the domain of F. Range [0, inf).
  int max_cuts = 10;
};

/// The schedule of Method::hybrid.
struct Hybrid {
  /// Rounds of multisecant followed by Newton. Range [1, inf).
  int rounds = 6;
  /// Newton steps per round. Range [1, inf).
  int newton_steps = 3;
  /// Newton steps after the last round. Range [0, inf).
  int final_newton_steps = 12;
};

/// When `setup(u)` of a preconditioner is called, if it has one.
enum class PreconditionerSetup {
  at_start,          ///< once per solve, at the first u
  every_newton_step  ///< before the linear system of each Newton step (and at the first u)
};

/// All choices of a solve. Plain Newton-Krylov unless changed.
struct Options {
  Method method = Method::newton_krylov;
  Tolerances tolerances;
  /// Newton steps of newton_krylov, iterations of multisecant; hybrid has its own schedule.
  /// Range [1, inf).
  int max_iterations = 100;
  /// Residual evaluations + Jacobian actions <= max_evaluations. Range [1, inf).
  int max_evaluations = 10000;
  Krylov krylov;
  Globalisation globalisation;
  Jacobian jacobian;
  Multisecant multisecant;
  Hybrid hybrid;
  PreconditionerSetup preconditioner_setup = PreconditionerSetup::at_start;
};

/// All that is wrong with `options`, one sentence each with the field and its range; empty if
/// usable.
[[nodiscard]] std::vector<std::string> validate(const Options& options);

/// The algorithm of Appendix A of Chen, Huang & Lyamin 2020: finite-difference J v (Eq. 30),
/// unrestarted GMRES of at most m_max columns, eta = 0.01 (Eq. 31), backtracking by 0.8 on simple
/// decrease, and both tolerances of Eq. 23.
/// @param residual_tolerance  epsilon_F of Eq. 23
/// @param step_tolerance  epsilon_u of Eq. 23
/// @param m_max  Krylov dimension; the paper's range is 20 to 1000
/// @throws std::invalid_argument if m_max is outside that range
[[nodiscard]] Options appendix_a(double residual_tolerance = 1e-6, double step_tolerance = 1e-6,
                                 int m_max = 20);

/// The hybrid for residuals with a good preconditioner: multisecant rounds rescued by Newton steps
/// of GMRES(60), eta = 0.3.
[[nodiscard]] Options hybrid();

}  // namespace jfnk
