// Every problem by PETSc's matrix-free SNES: line search with the default and with Eisenstat-Walker
// forcing, GMRES restarted after 30 and after 200, and the trust region.
#include <petscsnes.h>

#include <limits>
#include <string>

#include "trial.hpp"

namespace {

using peers::Vector;

PetscErrorCode residual(SNES, Vec x, Vec f, void* data) {
  peers::Trial& trial = *static_cast<peers::Trial*>(data);
  const PetscScalar* in = nullptr;
  PetscScalar* out = nullptr;
  PetscCall(VecGetArrayRead(x, &in));
  PetscCall(VecGetArray(f, &out));
  Eigen::Map<Vector> r_view(out, trial.size());
  if (trial.met_at() > 0) {
    // Solved: a zero residual ends the solve by every criterion.
    r_view.setZero();
  } else {
    const Vector u = Eigen::Map<const Vector>(in, trial.size());
    Vector r(trial.size());
    if (!trial.evaluate(u, r)) r.setConstant(std::numeric_limits<double>::quiet_NaN());
    r_view = r;
  }
  PetscCall(VecRestoreArrayRead(x, &in));
  PetscCall(VecRestoreArray(f, &out));
  return 0;
}

PetscErrorCode jacobian(SNES, Vec, Mat J, Mat, void*) {
  PetscCall(MatAssemblyBegin(J, MAT_FINAL_ASSEMBLY));
  return MatAssemblyEnd(J, MAT_FINAL_ASSEMBLY);
}

PetscErrorCode precondition(PC pc, Vec x, Vec y) {
  void* data = nullptr;
  PetscCall(PCShellGetContext(pc, &data));
  const peers::Trial& trial = *static_cast<peers::Trial*>(data);
  const PetscScalar* in = nullptr;
  PetscScalar* out = nullptr;
  PetscCall(VecGetArrayRead(x, &in));
  PetscCall(VecGetArray(y, &out));
  const Vector r = Eigen::Map<const Vector>(in, trial.size());
  Vector z(trial.size());
  trial.precondition(r, z);
  Eigen::Map<Vector>(out, trial.size()) = z;
  PetscCall(VecRestoreArrayRead(x, &in));
  PetscCall(VecRestoreArray(y, &out));
  return 0;
}

struct Choice {
  const char* name;
  const char* type;
  bool eisenstat_walker;
  int restart;
};

PetscErrorCode run(peers::Trial& trial, const Choice& choice, SNESConvergedReason* reason) {
  Vec u = nullptr;
  Vec f = nullptr;
  Mat J = nullptr;
  SNES snes = nullptr;
  KSP ksp = nullptr;
  PC pc = nullptr;
  PetscCall(VecCreateSeq(PETSC_COMM_SELF, static_cast<PetscInt>(trial.size()), &u));
  PetscCall(VecDuplicate(u, &f));
  PetscCall(SNESCreate(PETSC_COMM_SELF, &snes));
  PetscCall(SNESSetType(snes, choice.type));
  PetscCall(SNESSetFunction(snes, f, residual, &trial));
  PetscCall(MatCreateSNESMF(snes, &J));
  PetscCall(SNESSetJacobian(snes, J, J, jacobian, nullptr));
  PetscCall(SNESSetTolerances(snes, trial.goal() * 1e-3, 0.0, 0.0, 2000, peers::max_evaluations));
  PetscCall(SNESSetMaxLinearSolveFailures(snes, 10000));
  PetscCall(SNESKSPSetUseEW(snes, choice.eisenstat_walker ? PETSC_TRUE : PETSC_FALSE));
  PetscCall(SNESGetKSP(snes, &ksp));
  PetscCall(KSPSetType(ksp, KSPGMRES));
  PetscCall(KSPGMRESSetRestart(ksp, choice.restart));
  PetscCall(KSPGetPC(ksp, &pc));
  if (trial.preconditioned()) {
    PetscCall(KSPSetPCSide(ksp, PC_RIGHT));
    PetscCall(PCSetType(pc, PCSHELL));
    PetscCall(PCShellSetContext(pc, &trial));
    PetscCall(PCShellSetApply(pc, precondition));
  } else {
    PetscCall(PCSetType(pc, PCNONE));
  }
  {
    PetscScalar* values = nullptr;
    PetscCall(VecGetArray(u, &values));
    Eigen::Map<Vector>(values, trial.size()) = trial.problem().start;
    PetscCall(VecRestoreArray(u, &values));
  }
  PetscCall(SNESSolve(snes, nullptr, u));
  PetscCall(SNESGetConvergedReason(snes, reason));
  PetscCall(SNESDestroy(&snes));
  PetscCall(MatDestroy(&J));
  PetscCall(VecDestroy(&f));
  return VecDestroy(&u);
}

/// Begins PETSc; its end is that of the process, which is this solve's own.
peers::Outcome solve(peers::Trial& trial, const Choice& choice) {
  SNESConvergedReason reason = SNES_CONVERGED_ITERATING;
  const bool failed =
      PetscInitialize(nullptr, nullptr, nullptr, nullptr) != 0 || run(trial, choice, &reason) != 0;
  return {!failed && reason > 0, trial.met_at() > 0, trial.met_at(),
          failed ? "an error of PETSc" : SNESConvergedReasons[reason]};
}

}  // namespace

int main(int argc, char** argv) {
  const Choice choices[] = {
      {"bt 30", SNESNEWTONLS, false, 30},   {"bt 200", SNESNEWTONLS, false, 200},
      {"bt EW 30", SNESNEWTONLS, true, 30}, {"bt EW 200", SNESNEWTONLS, true, 200},
      {"tr 200", SNESNEWTONTR, false, 200}, {"tr EW 200", SNESNEWTONTR, true, 200}};
  std::vector<peers::Configuration> configurations;
  for (const Choice& choice : choices) {
    configurations.push_back({std::string("PETSc ") + choice.name,
                              [&choice](peers::Trial& trial) { return solve(trial, choice); }});
  }
  peers::run_all(argc > 1 ? argv[1] : "", configurations);
  return 0;
}
