#include "bounds/plateau_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "scene/derived.hpp"
#include "scene/scene.hpp"

namespace bounds {

namespace {

// Time-weighted by settlement, as steps are not equal.
double mean_of_last_fifth(const std::vector<record::CurveRow>& curve) {
  const double from = 0.8 * curve.back().settlement;
  double sum = 0.0, length = 0.0;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const double step = curve[i].settlement - std::max(from, curve[i - 1].settlement);
    if (step <= 0.0) continue;
    sum += step * curve[i].mean_pressure;
    length += step;
  }
  return length > 0.0 ? sum / length : curve.back().mean_pressure;
}

std::optional<double> first_above(const std::vector<record::CurveRow>& curve, double pressure) {
  const auto at = std::find_if(curve.begin(), curve.end(), [&](const record::CurveRow& row) {
    return row.mean_pressure > pressure;
  });
  return at == curve.end() ? std::nullopt : std::optional(at->settlement);
}

std::vector<std::string> reasons_of(PlateauCheck::Place place, const scene::Scene& scene) {
  std::vector<std::string> reasons;
  if (place == PlateauCheck::Place::above) {
    if (scene.approximation.kinematics == scene::KinematicsKind::finite_strain) {
      reasons.emplace_back(
          "finite strain: the footing sinks in and the surface heaves, while the bounds are for "
          "the geometry of the beginning");
    }
    reasons.emplace_back(
        "spacing: an edge resolved by few particles bears more; compare a finer one");
    reasons.emplace_back("hourglass control: compare the energy-corrected pressure of the curve");
  }
  if (place == PlateauCheck::Place::below) {
    reasons.emplace_back("the run may not have reached collapse: does the curve still rise?");
    if (!scene::is_associated(scene)) {
      reasons.emplace_back(
          "non-associated flow bears less than the associated flow of the bounds; see the "
          "Davis-reduced bracket");
    }
  }
  return reasons;
}

}  // namespace

PlateauCheck check_plateau(const std::vector<record::CurveRow>& curve, const scene::Scene& scene,
                           double lower, double upper) {
  if (!scene.drive.width) {
    throw std::invalid_argument("drive.width: absent; without it the curve has no mean pressure");
  }
  if (curve.empty() || !(curve.back().settlement > 0.0)) {
    throw std::invalid_argument("the curve has no settlement");
  }
  PlateauCheck check;
  check.plateau = mean_of_last_fifth(curve);
  check.settlement = curve.back().settlement;
  if (check.plateau > upper) {
    check.place = PlateauCheck::Place::above;
    check.distance = check.plateau / upper - 1.0;
  } else if (check.plateau < lower) {
    check.place = PlateauCheck::Place::below;
    check.distance = 1.0 - check.plateau / lower;
  }
  check.passed_lower = first_above(curve, lower);
  check.passed_upper = first_above(curve, upper);
  check.reasons = reasons_of(check.place, scene);
  return check;
}

std::string text_of(const PlateauCheck& check) {
  std::string text = "The run against the bounds of its collapse load:\n";
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "  mean pressure over the last fifth of the settlement ({:g} m): {:.6g} Pa, ",
                 check.settlement, check.plateau);
  switch (check.place) {
    case PlateauCheck::Place::inside:
      text += "inside the bracket\n";
      break;
    case PlateauCheck::Place::above:
      fmt::format_to(out, "{:.1f} % above the upper bound\n", 100.0 * check.distance);
      break;
    case PlateauCheck::Place::below:
      fmt::format_to(out, "{:.1f} % below the lower bound\n", 100.0 * check.distance);
      break;
  }
  const auto say = [&](std::string_view bound, const std::optional<double>& passed) {
    fmt::format_to(out, "  the {} bound is passed {}\n", bound,
                   passed ? fmt::format("at a settlement of {:g} m", *passed) : "nowhere");
  };
  say("lower", check.passed_lower);
  say("upper", check.passed_upper);
  for (const std::string& reason : check.reasons) fmt::format_to(out, "  perhaps: {}\n", reason);
  return text;
}

}  // namespace bounds
