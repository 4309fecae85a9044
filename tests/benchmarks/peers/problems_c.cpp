// The problems as a library for other languages, which run_scipy.py loads: the very same residuals,
// counted by the same counter.
#include "trial.hpp"

namespace {

const std::vector<peers::Problem>& problems() {
  static const std::vector<peers::Problem> all = peers::all_problems();
  return all;
}

Eigen::Map<const peers::Vector> view(const peers::Trial* trial, const double* values) {
  return {values, trial->size()};
}

void write(const peers::Vector& from, double* to) {
  Eigen::Map<peers::Vector>(to, from.size()) = from;
}

}  // namespace

extern "C" {

int peers_problems() {
  return static_cast<int>(problems().size());
}
const char* peers_name(int problem) {
  return problems()[static_cast<std::size_t>(problem)].name.c_str();
}
const char* peers_set(int problem) {
  return set_of(problems()[static_cast<std::size_t>(problem)]);
}
int peers_max_seconds() {
  return peers::max_seconds;
}

/// A fresh trial of a problem, until `peers_close`.
peers::Trial* peers_open(int problem, int preconditioned) {
  return new peers::Trial(problems()[static_cast<std::size_t>(problem)], preconditioned != 0);
}
void peers_close(peers::Trial* trial) {
  delete trial;
}
int peers_unknowns(const peers::Trial* trial) {
  return static_cast<int>(trial->size());
}
void peers_start(const peers::Trial* trial, double* u) {
  write(trial->problem().start, u);
}
double peers_goal(const peers::Trial* trial) {
  return trial->goal();
}
/// 1 if F(u) is in r, 0 if u is out of the domain or no evaluation is left.
int peers_evaluate(peers::Trial* trial, const double* u, double* r) {
  peers::Vector result = peers::Vector::Zero(trial->size());
  if (!trial->evaluate(view(trial, u), result)) return 0;
  write(result, r);
  return 1;
}
void peers_precondition(const peers::Trial* trial, const double* r, double* z) {
  peers::Vector result(trial->size());
  trial->precondition(view(trial, r), result);
  write(result, z);
}
int peers_met_at(const peers::Trial* trial) {
  return trial->met_at();
}
int peers_exhausted(const peers::Trial* trial) {
  return trial->exhausted() ? 1 : 0;
}
double peers_milliseconds(const peers::Trial* trial) {
  return trial->milliseconds();
}

}  // extern "C"
