#include "limit/solver/ipopt_solver.hpp"

#include <IpIpoptApplication.hpp>
#include <IpSolveStatistics.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "limit/solver/cone_nlp.hpp"

namespace limit::solver {

namespace {

using Application = Ipopt::SmartPtr<Ipopt::IpoptApplication>;

Application application(const SolverOptions& options) {
  Application ipopt = new Ipopt::IpoptApplication(false);
  auto set = ipopt->Options();
  set->SetIntegerValue("print_level", 0);
  set->SetStringValue("sb", "yes");  // no banner
  set->SetStringValue("linear_solver", "mumps");
  set->SetIntegerValue("mumps_pivot_order", 0);  // approximate minimum degree
  set->SetStringValue("nlp_scaling_method", "none");
  // A bound that is relaxed is none.
  set->SetNumericValue("bound_relax_factor", 0.0);
  set->SetNumericValue("tol", options.tolerance);
  // `tol` is measured against the multipliers, and where these grow large it is met far from the
  // optimum; these two are absolute.
  set->SetNumericValue("dual_inf_tol", 1e2 * options.tolerance);
  set->SetNumericValue("compl_inf_tol", 1e2 * options.tolerance);
  if (options.form == ConeForm::barrier) {
    // Newton's method with a line search; there is nothing for Ipopt's own barrier to do.
    set->SetStringValue("mu_strategy", "monotone");
    set->SetStringValue("hessian_constant", "no");
    set->SetStringValue("jac_c_constant", "yes");
  } else {
    set->SetStringValue("mu_strategy", "adaptive");
  }
  // No file of options: an ipopt.opt that lies in the current folder is meant for another program.
  if (ipopt->Initialize("") != Ipopt::Solve_Succeeded) {
    throw std::runtime_error("Ipopt refused its options");
  }
  return ipopt;
}

struct Ending {
  SolverStatus status;
  const char* word;
};

Ending ending(Ipopt::ApplicationReturnStatus status) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
      return {SolverStatus::solved, "solved"};
    case Ipopt::Solved_To_Acceptable_Level:
      return {SolverStatus::acceptable, "solved to the acceptable level"};
    case Ipopt::Search_Direction_Becomes_Too_Small:
      return {SolverStatus::acceptable, "search direction became too small"};
    case Ipopt::Maximum_Iterations_Exceeded:
      return {SolverStatus::capped, "iteration limit"};
    case Ipopt::Maximum_CpuTime_Exceeded:
      return {SolverStatus::timed_out, "time limit"};
    case Ipopt::Restoration_Failed:
      return {SolverStatus::failed, "restoration failed"};
    case Ipopt::Infeasible_Problem_Detected:
      return {SolverStatus::failed, "infeasible problem detected"};
    case Ipopt::Diverging_Iterates:
      return {SolverStatus::failed, "iterates diverge"};
    case Ipopt::Error_In_Step_Computation:
      return {SolverStatus::failed, "error in the step computation"};
    case Ipopt::Invalid_Number_Detected:
      return {SolverStatus::failed, "invalid number detected"};
    case Ipopt::Insufficient_Memory:
      return {SolverStatus::failed, "insufficient memory"};
    default:
      return {SolverStatus::failed, "internal error"};
  }
}

int iterations_of(const Application& ipopt) {
  const auto statistics = ipopt->Statistics();
  return IsValid(statistics) ? statistics->IterationCount() : 0;
}

double seconds_of(const Application& ipopt) {
  const auto statistics = ipopt->Statistics();
  return IsValid(statistics) ? statistics->TotalCPUTime() : 0.0;
}

// Ipopt does not say. Factors of plane meshes take some such power of their entries, and this many
// times what the interior-point method's condensed ones do.
double work_of(const programme::ConeProgram& program, int iterations) {
  constexpr double share = 20.0;
  return share * iterations * std::pow(static_cast<double>(program.equations.nonZeros()), 1.5);
}

ConeSolution solve_at_once(const programme::ConeProgram& program, const SolverOptions& options) {
  const Application ipopt = application(options);
  ipopt->Options()->SetIntegerValue("max_iter", options.max_iterations);
  ipopt->Options()->SetNumericValue("max_cpu_time", options.max_seconds);
  const Ipopt::SmartPtr<ConeNlp> nlp = new ConeNlp(program, options.form);
  const Ending end = ending(ipopt->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(nlp))));
  ConeSolution solution{nlp->variables(), nlp->multipliers(), {}, end.status, end.word};
  solution.iterations = iterations_of(ipopt);
  solution.work = work_of(program, solution.iterations);
  return solution;
}

// The cones' barrier has the parameter 2 each, so that its weight is the duality gap over 2 x
// cones.
ConeSolution solve_by_barrier(const programme::ConeProgram& program, const SolverOptions& options) {
  constexpr double reduction = 5.0;
  const Application ipopt = application(options);
  const Ipopt::SmartPtr<ConeNlp> nlp = new ConeNlp(program, options.form);
  const double cones = 2.0 * static_cast<double>(program.cones.size());
  ConeSolution solution;
  double seconds = options.max_seconds;
  // Far above the multipliers of common soils, which are of order 1 to 100: a start too far down
  // the path costs more steps than two stages more.
  double gap = 100.0;
  for (int stage = 0;; ++stage) {
    nlp->barrier = gap / cones;
    const int iterations = options.max_iterations - solution.iterations;
    if (iterations <= 0 || seconds <= 0.0) {
      solution.status = iterations <= 0 ? SolverStatus::capped : SolverStatus::timed_out;
      solution.message = iterations <= 0 ? "iteration limit" : "time limit";
      break;
    }
    ipopt->Options()->SetIntegerValue("max_iter", iterations);
    ipopt->Options()->SetNumericValue("max_cpu_time", seconds);
    if (stage == 1) ipopt->Options()->SetStringValue("warm_start_init_point", "yes");
    const Ending end = ending(ipopt->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(nlp))));
    solution.iterations += iterations_of(ipopt);
    seconds -= seconds_of(ipopt);
    solution.status = end.status;
    solution.message = end.word;
    const bool usable =
        end.status == SolverStatus::solved || end.status == SolverStatus::acceptable;
    if (!usable && stage > 0) break;  // the stage before is kept
    solution.variables = nlp->variables();
    solution.multipliers = nlp->multipliers();
    if (stage == 0) solution.interior_multipliers = solution.multipliers;
    const double wanted = options.gap * std::max(1.0, std::abs(nlp->objective()));
    if (!usable || gap <= wanted) break;
    gap = std::max(gap / reduction, wanted);
  }
  solution.work = work_of(program, solution.iterations);
  return solution;
}

}  // namespace

ConeSolution solve_by_ipopt(const programme::ConeProgram& program, const SolverOptions& options) {
  return options.form == ConeForm::barrier ? solve_by_barrier(program, options)
                                           : solve_at_once(program, options);
}

}  // namespace limit::solver
