#include "limit/report.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "program/version.hpp"

namespace limit {

namespace {

using nlohmann::ordered_json;

std::string_view word(solver::ConeForm form) {
  switch (form) {
    case solver::ConeForm::cones:
      return "cone";
    case solver::ConeForm::inequality:
      return "inequality";
    case solver::ConeForm::quadratic:
      return "quadratic inequality";
    case solver::ConeForm::barrier:
      break;
  }
  return "barrier";
}

std::string_view solver(solver::ConeForm form) {
  return form == solver::ConeForm::cones ? "interior point" : "Ipopt";
}

std::string_view status_of(const bracket::Solution& solution) {
  if (!solution.lower || !solution.upper) return "not certified";
  return solution.bracket.reached ? "reached" : "wider than asked";
}

// A key for what has the case's unit.
std::string with_unit(const std::string& key, const problem::Case& problem) {
  return problem.unit.empty() ? key : key + "_" + problem.unit;
}

ordered_json as_json(const problem::Case& problem, const bracket::Attempt& attempt) {
  ordered_json json{{"bound", attempt.is_lower ? "lower" : "upper"},
                    {"triangles", attempt.triangles},
                    {"cones", word(attempt.form)},
                    {"solver", solver(attempt.form)},
                    {"message", attempt.message},
                    {"iterations", attempt.iterations},
                    {"processor_seconds", attempt.seconds}};
  ordered_json& certified = json[with_unit("certified", problem)] = nullptr;
  if (attempt.certified) certified = *attempt.certified * problem.units.multiplier();
  return json;
}

// Where a turning block is, in the case's length.
struct BlockOutline {
  mesh::Point pole{0.0, 0.0}, low{0.0, 0.0}, high{0.0, 0.0};
};

BlockOutline outline_of(const problem::Case& problem, const problem::TurningBlock& block) {
  const auto at = [&](double angle, double radius) {
    mesh::Point place = block.pole + radius * mesh::Point(std::cos(angle), std::sin(angle));
    if (block.clockwise) place.x() = -place.x();
    return mesh::Point(problem.units.length * place);
  };
  const problem::SpiralArc &first = block.arcs.front(), &last = block.arcs.back();
  return {at(0.0, 0.0), at(first.upper, first.radius),
          at(last.lower, last.radius * std::exp(last.growth * (last.lower - last.upper)))};
}

ordered_json as_json(const problem::Case& problem, const bracket::BlockFactor& found) {
  const auto place = [](const mesh::Point& at) { return ordered_json{at.x(), at.y()}; };
  const BlockOutline outline = outline_of(problem, found.block);
  return {{"pole", place(outline.pole)},
          {"from", place(outline.high)},
          {"to", place(outline.low)},
          {"turns", found.block.clockwise ? "clockwise" : "counterclockwise"},
          {"factor", found.factor},
          {"multiplier_of_loads", found.certificate.multiplier * problem.units.multiplier()}};
}

// Of a solution alone; both the answer and the Davis-reduced one have it.
ordered_json as_json(const problem::Case& problem, const bracket::Solution& solution) {
  const bracket::Bracket& bracket = solution.bracket;
  const double stress = problem.units.stress, multiplier = problem.units.multiplier();
  ordered_json json{{"lower_bound", nullptr},
                    {"upper_bound", nullptr},
                    {"certified", solution.lower.has_value() && solution.upper.has_value()},
                    {"status", status_of(solution)},
                    {"gap", nullptr}};
  if (solution.lower) json["lower_bound"] = *solution.lower;
  if (solution.upper) json["upper_bound"] = *solution.upper;
  if (solution.lower && solution.upper) {
    json["mean"] = (*solution.lower + *solution.upper) / 2.0;
    json["half_gap"] = (*solution.upper - *solution.lower) / 2.0;
    json["gap"] = solution.gap();
  }
  if (bracket.lower) {
    const certificate::LowerCertificate& found = bracket.lower->certificate;
    json["lower_certificate"] = {
        {"equilibrium_residual_" + problem.names.stress, found.residual * stress},
        {"yield_excess_" + problem.names.stress, found.yield_excess * stress},
        {"shrink_factor", found.kept},
        {with_unit("before_shrinking", problem), found.proposed * multiplier}};
    json["lower_solver"] = as_json(problem, bracket.lower->attempt);
  }
  if (solution.block) json["turning_block"] = as_json(problem, *solution.block);
  if (bracket.upper) {
    const certificate::UpperCertificate& found = bracket.upper->certificate;
    json["upper_certificate"] = {
        {with_unit("dissipation", problem), found.dissipation * multiplier},
        {"flow_rule_violation", found.violation},
        {"dilation_left", found.residual},
        {"share_kept", found.kept}};
    json["upper_solver"] = as_json(problem, bracket.upper->attempt);
  }
  return json;
}

ordered_json as_json(const bounds::PlateauCheck& run) {
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

std::string unit_text(const problem::Case& problem) {
  return problem.unit.empty() ? "" : " " + problem.unit;
}

void say_bounds(std::string& text, const bracket::Solution& solution, const std::string& unit) {
  const auto out = std::back_inserter(text);
  if (solution.lower) {
    fmt::format_to(out, "  lower bound {:>14.7g}{}\n", *solution.lower, unit);
  } else {
    fmt::format_to(
        out, "  lower bound           none{}, {}\n", unit,
        solution.upper == 0.0 ? "none is sought above 0" : "no stress field could be certified");
  }
  if (solution.upper) {
    fmt::format_to(out, "  upper bound {:>14.7g}{}\n", *solution.upper, unit);
  } else {
    fmt::format_to(out, "  upper bound           none{}, no velocity field could be certified\n",
                   unit);
  }
  if (solution.lower && solution.upper) {
    fmt::format_to(out, "  collapse    {:>14.7g}{} +- {:.3g}{} (gap {:.2f} %)\n",
                   (*solution.lower + *solution.upper) / 2.0, unit,
                   (*solution.upper - *solution.lower) / 2.0, unit, 100.0 * solution.gap());
  }
}

void say_certificates(std::string& text, const problem::Case& problem,
                      const bracket::Solution& solution) {
  const bracket::Bracket& bracket = solution.bracket;
  const double stress = problem.units.stress;
  const auto out = std::back_inserter(text);
  text += "Certificates, found without the optimiser:\n";
  if (bracket.lower) {
    const certificate::LowerCertificate& found = bracket.lower->certificate;
    fmt::format_to(out,
                   "  stress field   {} triangles; equilibrium to {:.1e} {}, yield excess before "
                   "shrinking {:.1e} {}, shrunk by {:.1e}\n",
                   bracket.lower->mesh.triangles.size(), found.residual * stress,
                   problem.names.stress, found.yield_excess * stress, problem.names.stress,
                   1.0 - found.kept);
  }
  if (solution.block) {
    const BlockOutline outline = outline_of(problem, solution.block->block);
    fmt::format_to(out,
                   "  upper bound    a block that turns {} about ({:.5g}, {:.5g}), along a "
                   "logarithmic spiral from ({:.5g}, {:.5g}) to ({:.5g}, {:.5g}): at a factor of "
                   "{:.7g} it fails under {:.6f} of the loads\n",
                   solution.block->block.clockwise ? "clockwise" : "counterclockwise",
                   outline.pole.x(), outline.pole.y(), outline.high.x(), outline.high.y(),
                   outline.low.x(), outline.low.y(), solution.block->factor,
                   solution.block->certificate.multiplier * problem.units.multiplier());
  }
  if (bracket.upper) {
    const certificate::UpperCertificate& found = bracket.upper->certificate;
    fmt::format_to(out,
                   "  velocity field {} triangles; dissipation {:.7g}{} per unit power of the live "
                   "loads, violation of the flow rule as proposed {:.1e}, repaired by {:.1e}\n",
                   bracket.upper->mesh.triangles.size(),
                   found.dissipation * problem.units.multiplier(), unit_text(problem),
                   found.violation, 1.0 - found.kept);
  }
}

void say_solver(std::string& text, const bracket::Bracket& bracket) {
  const auto out = std::back_inserter(text);
  int iterations = 0;
  for (const bracket::Attempt& attempt : bracket.attempts) iterations += attempt.iterations;
  fmt::format_to(out, "Solver: {} attempts, {} iterations; the bounds come from\n",
                 bracket.attempts.size(), iterations);
  const auto say = [&](std::string_view name, const bracket::Attempt& attempt) {
    fmt::format_to(out, "  {}: {}, {} form, {}, {} iterations\n", name, solver(attempt.form),
                   word(attempt.form), attempt.message, attempt.iterations);
  };
  if (bracket.lower) say("lower", bracket.lower->attempt);
  if (bracket.upper) say("upper", bracket.upper->attempt);
}

std::vector<std::string> reasons_of(const problem::Case& problem, const Answer& answer) {
  const bool is_any = answer.found.lower || answer.found.upper;
  return is_any ? std::vector<std::string>{} : problem.reasons;
}

}  // namespace

std::string attempt_line(const problem::Case& problem, const bracket::Attempt& attempt) {
  const std::string bound =
      attempt.certified ? fmt::format("{:.7g}{}", *attempt.certified * problem.units.multiplier(),
                                      unit_text(problem))
                        : "no bound";
  const std::string at =
      attempt.factor ? fmt::format(", factor {:.6g}", *attempt.factor) : std::string();
  return fmt::format("{} {:5d} triangles{}: {}, {} ({} iterations, {:.1f} s)",
                     attempt.is_lower ? "lower" : "upper", attempt.triangles, at, bound,
                     attempt.message, attempt.iterations, attempt.seconds);
}

std::string text_report(const problem::Case& problem, const Answer& answer,
                        const bracket::BracketOptions& options) {
  const bracket::Bracket& bracket = answer.found.bracket;
  const std::string unit = unit_text(problem);
  std::string text;
  const auto out = std::back_inserter(text);
  text += problem.title + '\n';
  for (const auto& [what, value] : problem.data) fmt::format_to(out, "  {:<15} {}\n", what, value);
  std::string heading = problem.quantity;
  heading.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(heading.front())));
  text += '\n' + heading + ":\n";
  say_bounds(text, answer.found, unit);
  for (const std::string& note : problem.notes) fmt::format_to(out, "  {}\n", note);
  for (const std::string& reason : reasons_of(problem, answer)) {
    fmt::format_to(out, "  {}\n", reason);
  }
  if (answer.found.lower && answer.found.upper && !bracket.reached) {
    fmt::format_to(out,
                   "  wider than the gap asked for, {:g} %: allow more by --max-triangles ({}) or "
                   "--max-seconds ({:g})\n",
                   100.0 * options.gap, options.max_triangles, options.max_seconds);
  }
  if (answer.davis) {
    text += "With Davis' reduced strength for this dilation (an estimate, not rigorous):\n";
    say_bounds(text, *answer.davis, unit);
  }
  if (answer.run) text += bounds::text_of(*answer.run);
  text += '\n';
  if (!bracket.attempts.empty() || answer.found.block) {
    say_certificates(text, problem, answer.found);
  }
  if (!bracket.attempts.empty()) {
    say_solver(text, bracket);
  }
  text += "Assumptions:\n";
  for (const std::string& assumption : problem.assumptions) {
    fmt::format_to(out, "  {}\n", assumption);
  }
  if (!problem.hand.empty()) text += "By hand (none of them a bound):\n";
  for (const problem::HandFormula& formula : problem.hand) {
    fmt::format_to(out, "  {:<30}{:>10.5g} {}\n", formula.name, formula.pressure,
                   problem.names.stress);
  }
  return text;
}

std::string json_report(const problem::Case& problem, const Answer& answer,
                        const bracket::BracketOptions& options) {
  ordered_json json = as_json(problem, answer.found);
  json["quantity"] = problem.quantity;
  json["unit"] = problem.unit;
  json["gap_wanted"] = options.gap;
  if (answer.davis) {
    json["davis_reduced"] = as_json(problem, *answer.davis);
    json["davis_reduced"]["rigorous"] = false;
  }
  if (answer.run) json["run"] = as_json(*answer.run);
  json["case"] = problem.title;
  for (const auto& [what, value] : problem.data) json["data"][what] = value;
  json["assumptions"] = problem.assumptions;
  if (!problem.notes.empty()) json["notes"] = problem.notes;
  const std::vector<std::string> reasons = reasons_of(problem, answer);
  if (!reasons.empty()) json["reasons"] = reasons;
  for (const problem::HandFormula& formula : problem.hand) {
    json["hand_formulas_" + problem.names.stress][formula.name] = formula.pressure;
  }
  json["attempts"] = ordered_json::array();
  for (const bracket::Attempt& attempt : answer.found.bracket.attempts) {
    json["attempts"].push_back(as_json(problem, attempt));
  }
  json["program"] = std::string("fpm-limit ") + std::string(program::version);
  return json.dump(2) + '\n';
}

}  // namespace limit
