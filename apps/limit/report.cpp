#include "limit/report.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "wiring/version.hpp"

namespace limit {

namespace {

using nlohmann::ordered_json;

std::string_view word(ConeForm form) {
  switch (form) {
    case ConeForm::cones:
      return "cone";
    case ConeForm::inequality:
      return "inequality";
    case ConeForm::quadratic:
      return "quadratic inequality";
    case ConeForm::barrier:
      break;
  }
  return "barrier";
}

std::string_view solver(ConeForm form) {
  return form == ConeForm::cones ? "interior point" : "Ipopt";
}

std::string_view status_of(const Bracket& bracket) {
  if (!bracket.lower || !bracket.upper) return "not certified";
  return bracket.reached ? "reached" : "wider than asked";
}

ordered_json as_json(const Attempt& attempt, double stress) {
  ordered_json json{{"bound", attempt.is_lower ? "lower" : "upper"},
                    {"triangles", attempt.triangles},
                    {"cones", word(attempt.form)},
                    {"solver", solver(attempt.form)},
                    {"message", attempt.message},
                    {"iterations", attempt.iterations},
                    {"processor_seconds", attempt.seconds},
                    {"certified_Pa", nullptr}};
  if (attempt.certified) json["certified_Pa"] = *attempt.certified * stress;
  return json;
}

// Of a bracket alone; both the answer and the Davis-reduced one have it.
ordered_json as_json(const Bracket& bracket, double stress) {
  ordered_json json{{"lower_bound", nullptr},
                    {"upper_bound", nullptr},
                    {"certified", bracket.lower.has_value() && bracket.upper.has_value()},
                    {"status", status_of(bracket)},
                    {"gap", nullptr}};
  if (bracket.lower) json["lower_bound"] = bracket.lower_bound() * stress;
  if (bracket.upper) json["upper_bound"] = bracket.upper_bound() * stress;
  if (bracket.lower && bracket.upper) {
    json["mean"] = (bracket.lower_bound() + bracket.upper_bound()) / 2.0 * stress;
    json["half_gap"] = (bracket.upper_bound() - bracket.lower_bound()) / 2.0 * stress;
    json["gap"] = bracket.gap();
  }
  if (bracket.lower) {
    const LowerCertificate& found = bracket.lower->certificate;
    json["lower_certificate"] = {{"equilibrium_residual_Pa", found.residual * stress},
                                 {"yield_excess_Pa", found.yield_excess * stress},
                                 {"shrink_factor", found.kept},
                                 {"before_shrinking_Pa", found.proposed * stress}};
    json["lower_solver"] = as_json(bracket.lower->attempt, stress);
  }
  if (bracket.upper) {
    const UpperCertificate& found = bracket.upper->certificate;
    json["upper_certificate"] = {{"dissipation_Pa", found.dissipation * stress},
                                 {"flow_rule_violation", found.violation},
                                 {"dilation_left", found.residual},
                                 {"share_kept", found.kept}};
    json["upper_solver"] = as_json(bracket.upper->attempt, stress);
  }
  return json;
}

ordered_json as_json(const wiring::PlateauCheck& run) {
  const auto or_null = [](const std::optional<double>& value) {
    return value ? ordered_json(*value) : ordered_json(nullptr);
  };
  constexpr std::array<const char*, 3> places{"below", "inside", "above"};
  return {{"plateau_Pa", run.plateau},
          {"settlement_m", run.settlement},
          {"place", places[static_cast<std::size_t>(run.place)]},
          {"distance", run.distance},
          {"passed_lower_bound_at_m", or_null(run.passed_lower)},
          {"passed_upper_bound_at_m", or_null(run.passed_upper)},
          {"perhaps", run.reasons}};
}

void say_bracket(std::string& text, const Bracket& bracket, double stress) {
  const auto out = std::back_inserter(text);
  if (bracket.lower) {
    fmt::format_to(out, "  lower bound {:>14.7g} Pa\n", bracket.lower_bound() * stress);
  } else {
    fmt::format_to(out, "  lower bound           none Pa, no stress field could be certified\n");
  }
  if (bracket.upper) {
    fmt::format_to(out, "  upper bound {:>14.7g} Pa\n", bracket.upper_bound() * stress);
  } else {
    fmt::format_to(out, "  upper bound           none Pa, no velocity field could be certified\n");
  }
  if (bracket.lower && bracket.upper) {
    fmt::format_to(out, "  collapse    {:>14.7g} Pa +- {:.3g} Pa (gap {:.2f} %)\n",
                   (bracket.lower_bound() + bracket.upper_bound()) / 2.0 * stress,
                   (bracket.upper_bound() - bracket.lower_bound()) / 2.0 * stress,
                   100.0 * bracket.gap());
  }
}

void say_certificates(std::string& text, const Bracket& bracket, double stress) {
  const auto out = std::back_inserter(text);
  text += "Certificates, found without the optimiser:\n";
  if (bracket.lower) {
    const LowerCertificate& found = bracket.lower->certificate;
    fmt::format_to(out,
                   "  stress field   {} triangles; equilibrium to {:.1e} Pa, yield excess before "
                   "shrinking {:.1e} Pa, shrunk by {:.1e}\n",
                   bracket.lower->mesh.triangles.size(), found.residual * stress,
                   found.yield_excess * stress, 1.0 - found.kept);
  }
  if (bracket.upper) {
    const UpperCertificate& found = bracket.upper->certificate;
    fmt::format_to(out,
                   "  velocity field {} triangles; dissipation {:.7g} Pa per unit velocity, "
                   "violation of the flow rule as proposed {:.1e}, repaired by {:.1e}\n",
                   bracket.upper->mesh.triangles.size(), found.dissipation * stress,
                   found.violation, 1.0 - found.kept);
  }
}

void say_solver(std::string& text, const Bracket& bracket) {
  const auto out = std::back_inserter(text);
  int iterations = 0;
  for (const Attempt& attempt : bracket.attempts) iterations += attempt.iterations;
  fmt::format_to(out, "Solver: {} attempts, {} iterations; the bounds come from\n",
                 bracket.attempts.size(), iterations);
  const auto say = [&](std::string_view name, const Attempt& attempt) {
    fmt::format_to(out, "  {}: {}, {} form, {}, {} iterations\n", name, solver(attempt.form),
                   word(attempt.form), attempt.message, attempt.iterations);
  };
  if (bracket.lower) say("lower", bracket.lower->attempt);
  if (bracket.upper) say("upper", bracket.upper->attempt);
}

}  // namespace

std::string attempt_line(const Attempt& attempt, double stress_unit) {
  const std::string bound =
      attempt.certified ? fmt::format("{:.7g} Pa", *attempt.certified * stress_unit) : "no bound";
  return fmt::format("{} {:5d} triangles: {}, {} ({} iterations, {:.1f} s)",
                     attempt.is_lower ? "lower" : "upper", attempt.triangles, bound,
                     attempt.message, attempt.iterations, attempt.seconds);
}

std::string text_report(const Case& problem, const Answer& answer, const BracketOptions& options) {
  const double stress = problem.units.stress;
  std::string text;
  const auto out = std::back_inserter(text);
  text += problem.title + '\n';
  for (const auto& [what, value] : problem.data) fmt::format_to(out, "  {:<15} {}\n", what, value);
  text += '\n' + std::string("Mean pressure at collapse:\n");
  say_bracket(text, answer.bracket, stress);
  if (answer.bracket.lower && answer.bracket.upper && !answer.bracket.reached) {
    fmt::format_to(out,
                   "  wider than the gap asked for, {:g} %: allow more by --max-triangles ({}) or "
                   "--max-seconds ({:g})\n",
                   100.0 * options.gap, options.max_triangles, options.max_seconds);
  }
  if (answer.davis) {
    text += "With Davis' reduced strength for this dilation (an estimate, not rigorous):\n";
    say_bracket(text, *answer.davis, stress);
  }
  if (answer.run) text += text_of(*answer.run);
  text += '\n';
  say_certificates(text, answer.bracket, stress);
  say_solver(text, answer.bracket);
  text += "Assumptions:\n";
  for (const std::string& assumption : problem.assumptions) {
    fmt::format_to(out, "  {}\n", assumption);
  }
  if (!problem.hand.empty()) text += "By hand (none of them a bound):\n";
  for (const HandFormula& formula : problem.hand) {
    fmt::format_to(out, "  {:<30}{:>10.5g} Pa\n", formula.name, formula.pressure);
  }
  return text;
}

std::string json_report(const Case& problem, const Answer& answer, const BracketOptions& options) {
  const double stress = problem.units.stress;
  ordered_json json = as_json(answer.bracket, stress);
  json["quantity"] = "mean pressure at collapse";
  json["unit"] = "Pa";
  json["gap_wanted"] = options.gap;
  if (answer.davis) {
    json["davis_reduced"] = as_json(*answer.davis, stress);
    json["davis_reduced"]["rigorous"] = false;
  }
  if (answer.run) json["run"] = as_json(*answer.run);
  json["case"] = problem.title;
  for (const auto& [what, value] : problem.data) json["data"][what] = value;
  json["assumptions"] = problem.assumptions;
  for (const HandFormula& formula : problem.hand) {
    json["hand_formulas_Pa"][formula.name] = formula.pressure;
  }
  json["attempts"] = ordered_json::array();
  for (const Attempt& attempt : answer.bracket.attempts) {
    json["attempts"].push_back(as_json(attempt, stress));
  }
  json["program"] = std::string("fpm-limit ") + std::string(wiring::version);
  return json.dump(2) + '\n';
}

}  // namespace limit
