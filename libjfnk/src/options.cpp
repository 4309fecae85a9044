#include "jfnk/options.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "outcome_text.hpp"

namespace jfnk {
namespace {

// Of Globalisation::window.
constexpr int max_window = 10;

class Checker {
 public:
  void require(bool good, const char* name, const char* range, double value) {
    if (!good) {
      messages_.push_back(std::string(name) + " = " + detail::number(value, 10) + " must be " +
                          range);
    }
  }
  void at_least(int value, int low, const char* name) {
    const std::string range = "at least " + std::to_string(low);
    require(value >= low, name, range.c_str(), value);
  }
  void fraction(double value, const char* name) {
    require(value > 0.0 && value < 1.0, name, "in (0, 1)", value);
  }
  void half_open(double value, const char* name) {
    require(value >= 0.0 && value < 1.0, name, "in [0, 1)", value);
  }
  void up_to_one(double value, const char* name) {
    require(value > 0.0 && value <= 1.0, name, "in (0, 1]", value);
  }
  void not_negative(double value, const char* name) {
    require(value >= 0.0 && std::isfinite(value), name, "finite and not negative", value);
  }
  [[nodiscard]] std::vector<std::string> take() { return std::move(messages_); }
  void add(std::string message) { messages_.push_back(std::move(message)); }

 private:
  std::vector<std::string> messages_;
};

void check_krylov(const Krylov& k, Checker& check) {
  check.at_least(k.restart, 1, "krylov.restart");
  check.at_least(k.max_iterations, 1, "krylov.max_iterations");
  check.fraction(k.forcing.initial, "krylov.forcing.initial");
  check.up_to_one(k.forcing.gamma, "krylov.forcing.gamma");
  check.require(k.forcing.alpha > 1.0 && k.forcing.alpha <= 2.0, "krylov.forcing.alpha",
                "in (1, 2]", k.forcing.alpha);
  check.fraction(k.forcing.maximum, "krylov.forcing.maximum");
  check.half_open(k.forcing.end_game, "krylov.forcing.end_game");
}

void check_globalisation(const Globalisation& g, Checker& check) {
  check.fraction(g.factor, "globalisation.factor");
  check.fraction(g.greatest_cut, "globalisation.greatest_cut");
  check.require(g.least_cut > 0.0 && g.least_cut <= g.greatest_cut, "globalisation.least_cut",
                "in (0, greatest_cut]", g.least_cut);
  check.fraction(g.domain_factor, "globalisation.domain_factor");
  check.at_least(g.max_cuts, 0, "globalisation.max_cuts");
  check.half_open(g.sufficient_decrease, "globalisation.sufficient_decrease");
  check.at_least(g.watchdog, 1, "globalisation.watchdog");
  check.require(g.window >= 1 && g.window <= max_window, "globalisation.window", "in [1, 10]",
                g.window);
}

void check_jacobian(const Jacobian& j, Checker& check) {
  check.fraction(j.noise, "jacobian.noise");
  check.not_negative(j.length_scale, "jacobian.length_scale");
  check.at_least(j.max_attempts, 1, "jacobian.max_attempts");
  if (j.step == Jacobian::Step::length_scale && !(j.length_scale > 0.0)) {
    check.add("jacobian.length_scale must be positive when jacobian.step is length_scale");
  }
}

void check_multisecant(const Multisecant& m, Checker& check) {
  check.at_least(m.memory, 1, "multisecant.memory");
  check.at_least(m.patience, 0, "multisecant.patience");
  check.up_to_one(m.progress, "multisecant.progress");
  check.require(m.wild > 1.0, "multisecant.wild", "above 1", m.wild);
  check.at_least(m.wild_patience, 1, "multisecant.wild_patience");
  check.at_least(m.given_patience, 1, "multisecant.given_patience");
  check.require(m.rejection > 1.0, "multisecant.rejection", "above 1", m.rejection);
  check.up_to_one(m.mixing, "multisecant.mixing");
  check.require(m.max_condition > 1.0 && m.max_condition <= 1e6, "multisecant.max_condition",
                "in (1, 1e6]", m.max_condition);
  check.at_least(m.max_cuts, 0, "multisecant.max_cuts");
}

void check_scale(const Eigen::VectorXd& scale, const char* name, Checker& check) {
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    if (scale[i] > 0.0 && std::isfinite(scale[i])) continue;
    const std::string entry = std::string(name) + "[" + std::to_string(i) + "]";
    check.require(false, entry.c_str(), "positive and finite", scale[i]);
    return;
  }
}

void check_bounds(const Options& options, Checker& check) {
  const Eigen::VectorXd& lower = options.lower;
  const Eigen::VectorXd& upper = options.upper;
  const auto has_nan = [](const Eigen::VectorXd& v) { return (v.array() != v.array()).any(); };
  if (has_nan(lower) || has_nan(upper)) check.add("lower and upper must not be NaN");
  if (lower.size() == 0 || upper.size() == 0) return;
  if (lower.size() != upper.size()) {
    check.add("lower has size " + std::to_string(lower.size()) + ", upper has size " +
              std::to_string(upper.size()));
  } else if ((lower.array() >= upper.array()).any()) {
    check.add("lower must be below upper in every component");
  }
}

}  // namespace

std::vector<std::string> validate(const Options& options) {
  Checker check;
  check.half_open(options.tolerances.relative, "tolerances.relative");
  check.not_negative(options.tolerances.absolute, "tolerances.absolute");
  check.half_open(options.tolerances.step, "tolerances.step");
  check.at_least(options.max_iterations, 1, "max_iterations");
  check.at_least(options.max_evaluations, 1, "max_evaluations");
  check_krylov(options.krylov, check);
  check_globalisation(options.globalisation, check);
  check_jacobian(options.jacobian, check);
  check_multisecant(options.multisecant, check);
  check.at_least(options.hybrid.rounds, 1, "hybrid.rounds");
  check.at_least(options.hybrid.newton_steps, 1, "hybrid.newton_steps");
  check.require(options.hybrid.back_off >= 1.0 && std::isfinite(options.hybrid.back_off),
                "hybrid.back_off", "finite and at least 1", options.hybrid.back_off);
  check.at_least(options.stagnation.window, 2, "stagnation.window");
  check.up_to_one(options.stagnation.left, "stagnation.left");
  check.at_least(options.pseudo_transient.max_steps, 1, "pseudo_transient.max_steps");
  check.fraction(options.pseudo_transient.gain, "pseudo_transient.gain");
  check.at_least(options.learning.after, 1, "learning.after");
  check.at_least(options.learning.after_preconditioned, 1, "learning.after_preconditioned");
  check.not_negative(options.learning.worth, "learning.worth");
  check.at_least(options.learning.least_unknowns, 1, "learning.least_unknowns");
  check.at_least(options.learning.most_rows, 1, "learning.most_rows");
  check.require(options.learning.most_entries >= 1.0, "learning.most_entries", "at least 1",
                options.learning.most_entries);
  check.require(options.learning.operations > 0.0, "learning.operations", "above 0",
                options.learning.operations);
  check.not_negative(options.setup_cost, "setup_cost");
  check_scale(options.u_scale, "u_scale", check);
  check_scale(options.f_scale, "f_scale", check);
  check_bounds(options, check);
  check.at_least(options.hybrid.final_newton_steps, 0, "hybrid.final_newton_steps");
  return check.take();
}

Options appendix_a(double residual_tolerance, double step_tolerance, int m_max) {
  if (m_max < 20 || m_max > 1000) {
    throw std::invalid_argument("jfnk::appendix_a: m_max = " + std::to_string(m_max) +
                                " must be between 20 and 1000");
  }
  Options options;
  options.method = Method::newton_krylov;
  options.tolerances.relative = residual_tolerance;
  options.tolerances.step = step_tolerance;
  options.krylov.restart = m_max;
  options.krylov.max_iterations = m_max;
  options.krylov.forcing.rule = Forcing::Rule::constant;
  options.krylov.forcing.initial = 0.01;
  options.krylov.forcing.end_game = 0.0;
  options.globalisation.rule = Globalisation::Rule::backtracking;
  options.globalisation.factor = 0.8;
  // Departure: the paper cuts without end; 0.8^100 = 2e-10 is beyond any useful step
  // (doc/appendix_a.md).
  options.globalisation.max_cuts = 100;
  options.globalisation.domain_factor = 0.8;
  options.globalisation.sufficient_decrease = 0.0;
  options.jacobian.source = Jacobian::Source::finite_difference;
  options.jacobian.step = Jacobian::Step::paper;
  options.jacobian.measure_noise = false;
  options.stagnation.left = 1.0;
  options.stagnation.restart = false;
  options.pseudo_transient.enabled = false;
  options.learning.enabled = false;
  options.preconditioner_setup = PreconditionerSetup::at_start;
  return options;
}

Options hybrid() {
  return {};
}

Options newton_krylov() {
  Options options;
  options.method = Method::newton_krylov;
  return options;
}

Options semismooth() {
  Options options;
  options.method = Method::newton_krylov;
  options.max_iterations = 200;
  options.krylov.solver = Krylov::Solver::direct;
  options.globalisation.rule = Globalisation::Rule::full_steps;
  options.preconditioner_setup = PreconditionerSetup::every_newton_step;
  return options;
}

Options plasticity() {
  Options options;
  options.method = Method::hybrid;
  options.krylov.restart = 60;
  options.krylov.max_iterations = 60;
  options.krylov.forcing.rule = Forcing::Rule::constant;
  options.krylov.forcing.initial = 0.3;
  options.globalisation.rule = Globalisation::Rule::backtracking;
  options.jacobian.measure_noise = false;
  options.multisecant.memory = 20;
  options.multisecant.patience = 10;
  options.multisecant.progress = 1.0;
  options.multisecant.scale_mixing = false;
  options.multisecant.broyden = false;
  options.multisecant.renew = false;
  options.multisecant.wild_patience = std::numeric_limits<int>::max();
  options.stagnation.left = 1.0;
  options.stagnation.restart = false;
  options.hybrid.rounds = 6;
  options.hybrid.newton_steps = 3;
  options.hybrid.back_off = 1.0;
  options.hybrid.final_newton_steps = 12;
  options.pseudo_transient.enabled = false;
  options.learning.enabled = false;
  options.preconditioner_setup = PreconditionerSetup::at_start;
  return options;
}

}  // namespace jfnk
