#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace jfnk {

/// The nonlinear strategy.
enum class Method {
  newton_krylov,  ///< inexact Newton, directions by a Krylov solver, globalised
  multisecant,    ///< (preconditioned) Anderson iteration, one residual per iteration
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
  enum class Solver {
    gmres,                ///< lowest residual of the space; memory grows with the iterations
    bicgstab,             ///< fixed memory, two Jacobian actions per iteration (van der Vorst 1992)
    conjugate_gradients,  ///< fixed memory, one action per iteration; for Jacobians and
                          ///< preconditioners that are symmetric and positive definite
    direct  ///< du = -P F without any action, for a P that is J^-1 where it was set up; gmres where
            ///< there is no preconditioner
  };
  Solver solver = Solver::gmres;
  /// Columns kept before a restart; memory is restart + 1 vectors, of which only those used are
  /// touched. A restart below what a system needs costs several times the actions. Range [1, inf).
  int restart = 200;
  /// Upper bound on Jacobian actions per Newton step; the direction found is then used as it is.
  /// Range [1, inf).
  int max_iterations = 200;
  /// Keep the preconditioned vectors so that the preconditioner may vary (twice the memory).
  bool flexible = false;
  /// GMRES keeps its columns in single precision: half the memory, and half of what an iteration
  /// reads. For forcing terms of 1e-5 and looser.
  bool single_precision = false;
  Forcing forcing = {};
};

/// How a Newton direction du is shortened until ||F|| falls.
struct Globalisation {
  enum class Rule {
    backtracking,  ///< u + lambda du, lambda = 1, factor, factor^2, ...
    parabola,      ///< lambda at the lowest point of the parabola through what is known of ||F||^2,
                   ///< kept between least_cut and greatest_cut of the last (Dennis & Schnabel 1983)
    dogleg,        ///< within a radius, from the steepest descent of the linear model in the Krylov
             ///< space to its solution (Powell 1970; Brown & Saad 1990); lines after a restart
    full_steps  ///< lambda = 1 wherever F has a value, whether or not ||F|| falls, until
                ///< `watchdog` ends it: semismooth Newton for contact and obstacles; then lines
  };
  Rule rule = Rule::dogleg;
  /// backtracking: lambda *= factor after a trial that did not reduce ||F|| enough (Chen, Huang &
  /// Lyamin 2020, Table A1). Range (0, 1).
  double factor = 0.8;
  /// parabola and dogleg: the shortest new step over the last. Range (0, greatest_cut].
  double least_cut = 0.1;
  /// parabola and dogleg: the longest new step over the last. Range [least_cut, 1).
  double greatest_cut = 0.5;
  /// The step is cut by this after a trial out of the domain of F. Range (0, 1).
  double domain_factor = 0.5;
  /// Trials after the first before the search is given up. Range [0, inf).
  int max_cuts = 40;
  /// Accept if ||F(u + s)|| <= (1 - sufficient_decrease (1 - rho)) m, rho = ||F + J s|| / ||F||
  /// (Eisenstat & Walker 1994); 0 is the simple decrease of the paper. Range [0, 1).
  double sufficient_decrease = 1e-4;
  /// full_steps: given up after so many steps in a row without a new lowest ||F||. Range [1, inf).
  int watchdog = 100;
  /// m above is the highest of the last `window` norms: 1 is monotone, 5 suits semismooth
  /// residuals (Grippo, Lampariello & Lucidi 1986). Range [1, 10].
  int window = 1;
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
  /// When no step reduces ||F||, measure the noise of F once per solve (ECNoise, Moré & Wild 2011)
  /// and go on with the b that fits it. Costs about ten evaluations.
  bool measure_noise = true;
};

/// Anderson iteration on the true residual. Without a preconditioner and with a memory as long as a
/// Krylov space it is GMRES that corrects its linearisation at every vector.
struct Multisecant {
  /// Pairs (du, dF) kept: memory is twice that many vectors, of which only those used are touched.
  /// Range [1, inf).
  int memory = 200;
  /// Pairs are kept in single precision: half the memory, and half of what is read at each point.
  /// The linear model is then good to 1e-7 times its condition; F and u are in double precision.
  /// For relative tolerances of 1e-6 and looser: tighter ones take more steps.
  bool single_precision = false;
  /// Given up after this many evaluations in which the best ||F|| did not fall below
  /// progress times its value at the last such fall; 0 stands for 20 without and 10 with a
  /// preconditioner, or for what the Newton steps of the round before took if that is less (4 at
  /// least). Range [0, inf).
  int patience = 0;
  /// See patience; 1 accepts any improvement. Range (0, 1].
  double progress = 0.9;
  /// Given up as well after `wild_patience` points in a row with ||F|| > wild * best ||F||. Range
  /// (1, inf).
  double wild = 3.0;
  /// See wild. Range [1, inf).
  int wild_patience = 6;
  /// While pairs of a former solve (Solver::begin_with) are still in use, all pairs are dropped
  /// after this many evaluations without such a fall as `patience` asks for, and the iteration goes
  /// on from the best point. Range [1, inf).
  int given_patience = 5;
  /// A point with ||F|| > rejection * best ||F|| is left for the best one. Range (1, inf).
  double rejection = 30.0;
  /// Factor of the preconditioned remainder, u -= mixing P (F - dF gamma). Range (0, 1].
  double mixing = 1.0;
  /// Without a preconditioner, multiply `mixing` by the step length along F that is best for the
  /// linear model; costs one Jacobian action at the start.
  bool scale_mixing = true;
  /// Oldest pairs are dropped until the unit columns of dF have a condition estimate below this.
  /// Range (1, 1e6], as the least squares are good to round-off times its square.
  double max_condition = 1e4;
  /// With a preconditioner, keep Broyden's rank-one updates of it besides the least squares over
  /// all pairs. A step is by Broyden's H where ||s - H y|| <= 0.6 ||s|| held for the last pairs (s,
  /// y) and was smaller there than by least squares. Costs no application of the preconditioner
  /// beyond one at each point, and two and a half times the memory.
  bool broyden = true;
  /// With a preconditioner P, let gamma minimise ||P (F - dF gamma)|| instead of ||F - dF gamma||,
  /// as KINSOL's Anderson does on u - P F. Suits flows and contact, where P F is an error and F is
  /// not; all else is still judged by ||F||. Done with learnt factors in any case.
  bool preconditioned_norm = false;
  /// After Newton steps begin with the Krylov space of the last one instead of the pairs of before.
  bool renew = true;
  /// Halvings towards the best point after leaving the domain of F. Range [0, inf).
  int max_cuts = 10;
};

/// The schedule of Method::hybrid.
struct Hybrid {
  /// Rounds of multisecant followed by Newton. Range [1, inf).
  int rounds = 12;
  /// Newton steps of the first round. Range [1, inf).
  int newton_steps = 1;
  /// Newton steps of a round over those of the round before. Range [1, inf).
  double back_off = 2.0;
  /// Newton steps after the last round. Range [0, inf).
  int final_newton_steps = 100;
};

/// When Newton stands still or finds no step any more.
struct Stagnation {
  /// Newton stands still when this many steps together ... Range [2, inf).
  int window = 8;
  /// ... have left more than this of ||F||; 1 means never. Range (0, 1].
  double left = 0.8;
  /// Once per solve, begin again at the first u by Newton steps with a line search.
  bool restart = true;
};

/// When that fails too: implicit steps of du/dt = -F with a time step that grows as ||F|| falls
/// (Kelley & Keyes 1998).
struct PseudoTransient {
  /// Off: the failure is reported at once.
  bool enabled = true;
  /// Steps before it is given up, once per solve. Range [1, inf).
  int max_steps = 60;
  /// Back to Newton when ||F|| <= gain times its value at the failure. Range (0, 1).
  double gain = 0.1;
};

/// Whether and when Method::hybrid learns the Jacobian of an F on a lattice, where there is no
/// preconditioner or none that helps any more.
///
/// Unknowns that are moved, far from each other, show which components of F depend on them; how far
/// off in the index these are tells which diagonals of J are occupied. If the diagonals are few, as
/// on grids and chains whose nodes are numbered in order, J follows from some ten products J v
/// (Curtis, Powell & Reid 1974). Its sparse LU factors are the preconditioner, renewed where that
/// pays. F must not depend on an unknown by rounding alone. Not for residuals on several processes.
struct Learning {
  bool enabled = true;
  /// Evaluations before, without and with a preconditioner of the caller's (or its first failure).
  /// Range [1, inf).
  int after = 6;
  int after_preconditioned = 20;
  /// Only if at the present rate more evaluations than this are still to come. Range [0, inf).
  double worth = 25.0;
  /// Only for so many unknowns or more. Range [1, inf).
  int least_unknowns = 32;
  /// Given up when one unknown changes more components of F than this. Range [1, inf).
  int most_rows = 40;
  /// Given up when the factors would have more entries than this, at 12 bytes each. Range [1, inf).
  double most_entries = 5e7;
  /// Given up when the factors would cost more operations than the evaluations they may spare, an
  /// evaluation being taken to cost this many per unknown, those of the solver's own vectors
  /// included. To be raised where F is dear; inf asks for evaluations only. Range (0, inf].
  double operations = 200.0;
};

/// When `setup(u)` of a preconditioner is called, if it has one.
enum class PreconditionerSetup {
  at_start,           ///< once per solve, at the first u
  every_newton_step,  ///< before the linear system of each Newton step (and at the first u)
  when_it_pays        ///< at the first u, and when the gain per evaluation has fallen so far below
                      ///< that after the last setup that `setup_cost` would be earned back, or
                      ///< Krylov iterations beyond one per Newton step have come to that cost
};

/// All choices of a solve.
struct Options {
  Method method = Method::hybrid;
  Tolerances tolerances = {};
  /// Typical size of each unknown; the solver works in u / u_scale. Empty: ones. Each > 0, finite.
  Eigen::VectorXd u_scale = {};
  /// Typical size of each residual; all norms are of F / f_scale. Empty: ones. Each > 0, finite.
  Eigen::VectorXd f_scale = {};
  /// Bounds that no step and no difference crosses; a step goes at most nine tenths of the way.
  /// The first u must lie between them. Empty: none.
  Eigen::VectorXd lower = {};
  Eigen::VectorXd upper = {};
  /// Newton steps of newton_krylov, iterations of multisecant; hybrid has its own schedule.
  /// Range [1, inf).
  int max_iterations = 100;
  /// Residual evaluations + Jacobian actions <= max_evaluations. Range [1, inf).
  int max_evaluations = 10000;
  Krylov krylov = {};
  Globalisation globalisation = {};
  Jacobian jacobian = {};
  Multisecant multisecant = {};
  Hybrid hybrid = {};
  Stagnation stagnation = {};
  PseudoTransient pseudo_transient = {};
  Learning learning = {};
  PreconditionerSetup preconditioner_setup = PreconditionerSetup::when_it_pays;
  /// Cost of one `setup`, in evaluations of F; see when_it_pays. Range [0, inf).
  double setup_cost = 10.0;
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

/// The default, Method::hybrid, by name.
[[nodiscard]] Options hybrid();

/// The plain Newton-Krylov method: Method::newton_krylov, all else as it comes.
[[nodiscard]] Options newton_krylov();

/// Semismooth Newton, for contact, obstacles and the like written with Fischer-Burmeister or
/// minimum functions: full steps by a preconditioner that is set up at every one of them and is
/// taken for J^-1 (ColouredJacobian, or factors of your own). The work is in the setups: without
/// one, or with one that is not exact, each step solves by GMRES if `krylov.solver` is set so.
[[nodiscard]] Options semismooth();

/// The hybrid for load steps of plasticity with a good preconditioner: six rounds of multisecant
/// with 20 pairs, each rescued by three Newton steps of GMRES(60), eta = 0.3, cut by 0.8.
[[nodiscard]] Options plasticity();

}  // namespace jfnk
