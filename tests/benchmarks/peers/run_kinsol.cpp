// Every problem by KINSOL: Newton-GMRES with line search under several forcings and dimensions, and
// Anderson's method on u - P F(u) where there is a preconditioner.
#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_spgmr.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "trial.hpp"

namespace {

using peers::Vector;

Eigen::Map<Vector> view(N_Vector v) {
  return {N_VGetArrayPointer(v), static_cast<Eigen::Index>(N_VGetLength(v))};
}

int residual(N_Vector u, N_Vector f, void* data) {
  peers::Trial& trial = *static_cast<peers::Trial*>(data);
  // Solved: a zero residual ends the solve by every criterion.
  if (trial.met_at() > 0) {
    N_VConst(0.0, f);
    return 0;
  }
  if (trial.exhausted()) return -1;
  Vector r(trial.size());
  if (!trial.evaluate(view(u), r)) return 1;
  view(f) = r;
  return 0;
}

int fixed_point(N_Vector u, N_Vector g, void* data) {
  const peers::Trial& trial = *static_cast<peers::Trial*>(data);
  if (const int flag = residual(u, g, data); flag != 0) return flag;
  Vector z(trial.size());
  trial.precondition(view(g), z);
  view(g) = view(u) - z;
  return 0;
}

int precondition(N_Vector, N_Vector, N_Vector, N_Vector, N_Vector v, void* data) {
  const peers::Trial& trial = *static_cast<peers::Trial*>(data);
  Vector z(trial.size());
  trial.precondition(view(v), z);
  view(v) = z;
  return 0;
}

struct Choice {
  std::string name;
  int forcing;    // KIN_ETA...
  int dimension;  // of the Krylov space, or pairs of Anderson's method
  bool anderson = false;
  int strategy = KIN_LINESEARCH;
};

peers::Outcome solve(peers::Trial& trial, const Choice& choice, SUNContext context) {
  const auto n = static_cast<sunindextype>(trial.size());
  N_Vector u = N_VNew_Serial(n, context);
  N_Vector u_scale = N_VNew_Serial(n, context);
  N_Vector f_scale = N_VNew_Serial(n, context);
  view(u) = trial.problem().start;
  N_VConst(1.0, u_scale);
  N_VConst(1.0, f_scale);
  if (trial.problem().u_scale.size() > 0) view(u_scale) = trial.problem().u_scale.cwiseInverse();
  if (trial.problem().f_scale.size() > 0) view(f_scale) = trial.problem().f_scale.cwiseInverse();

  void* memory = KINCreate(context);
  KINSetErrHandlerFn(
      memory, [](int, const char*, const char*, char*, void*) {}, nullptr);
  KINSetUserData(memory, &trial);
  if (choice.anderson) KINSetMAA(memory, std::min<long>(choice.dimension, n));
  KINInit(memory, choice.anderson ? fixed_point : residual, u);
  KINSetNumMaxIters(memory, 2000);
  // The goal is of the 2-norm and the harness sees it met; KINSOL's own tests must not end first.
  KINSetFuncNormTol(memory, choice.anderson ? 1e-300 : trial.goal() * 1e-3 / std::sqrt(double(n)));
  KINSetScaledStepTol(memory, 1e-14);
  // The default, 1000 times the first guess and 1 at least, holds up starts at zero.
  KINSetMaxNewtonStep(memory, 1e10);
  SUNLinearSolver linear = nullptr;
  if (!choice.anderson) {
    KINSetEtaForm(memory, choice.forcing);
    if (choice.forcing == KIN_ETACHOICE2) KINSetEtaParams(memory, 0.9, 2.0);
    const int side = trial.preconditioned() ? SUN_PREC_RIGHT : SUN_PREC_NONE;
    linear =
        SUNLinSol_SPGMR(u, side, static_cast<int>(std::min<long>(choice.dimension, n)), context);
    KINSetLinearSolver(memory, linear, nullptr);
    if (trial.preconditioned()) KINSetPreconditioner(memory, nullptr, precondition);
  }
  const int flag = KINSol(memory, u, choice.anderson ? KIN_FP : choice.strategy, u_scale, f_scale);
  KINFree(&memory);
  if (linear != nullptr) SUNLinSolFree(linear);
  for (N_Vector v : {u, u_scale, f_scale}) N_VDestroy(v);
  return {flag >= 0, trial.met_at() > 0, trial.met_at(), "flag " + std::to_string(flag)};
}

}  // namespace

int main(int argc, char** argv) {
  SUNContext context = nullptr;
  if (SUNContext_Create(nullptr, &context) != 0) return 1;
  const Choice choices[] = {{"EW1 20", KIN_ETACHOICE1, 20},
                            {"EW1 200", KIN_ETACHOICE1, 200},
                            {"EW2 200", KIN_ETACHOICE2, 200},
                            {"constant 200", KIN_ETACONSTANT, 200},
                            {"full steps", KIN_ETACHOICE1, 200, false, KIN_NONE},
                            {"Anderson 5", 0, 5, true},
                            {"Anderson 20", 0, 20, true}};
  std::vector<peers::Configuration> configurations;
  for (const Choice& choice : choices) {
    configurations.push_back(
        {"KINSOL " + choice.name,
         [&choice, context](peers::Trial& trial) { return solve(trial, choice, context); },
         choice.anderson});
  }
  peers::run_all(argc > 1 ? argv[1] : "", configurations);
  SUNContext_Free(&context);
  return 0;
}
