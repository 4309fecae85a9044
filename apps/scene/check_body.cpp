#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "constitutive/parameters.hpp"
#include "scene/check.hpp"
#include "scene/derived.hpp"
#include "scene/element_body.hpp"
#include "scene/names.hpp"
#include "scene/places.hpp"
#include "tables/table.hpp"

namespace scene {

namespace {

// Relative distance from a whole number that decimal input may leave behind.
constexpr double round_off = 1e-9;
// Particles and their neighbours are counted in 32 bits.
constexpr double most_particles = 2147483647.0;
constexpr std::int64_t fewest_per_axis = 3;

/// Whether an extent is a whole number of spacings but for the round-off of its two coordinates.
bool is_whole(double extent, double spacing, const Geometry& geometry) {
  const double value = extent / spacing;
  return std::abs(value - std::round(value)) <=
         round_off * value + coordinate_round_off(geometry) / spacing;
}

/// A number with so many digits that it does not look whole.
std::string not_whole(double value) {
  constexpr int fewest = 6, most = 17;
  std::string text;
  for (int digits = fewest; digits <= most; ++digits) {
    text = fmt::format("{:.{}g}", value, digits);
    if (text.find('.') != std::string::npos) break;
  }
  return text;
}

/// The spacing nearest to the wanted one that divides every extent, or 0 if none from half to twice
/// the wanted one does.
double nearest_spacing(const Geometry& geometry) {
  const double extent = geometry.max[0] - geometry.min[0];
  const double cells = extent / geometry.spacing;
  // More candidates than this are not worth a suggestion.
  constexpr double most_candidates = 1e6;
  if (cells > most_candidates) return 0.0;
  double best = 0.0;
  for (auto n = std::max(1.0, std::floor(cells / 2.0)); n <= 2.0 * cells + 1.0; n += 1.0) {
    const double spacing = extent / n;
    bool fits = true;
    for (std::size_t i = 1; i < geometry.min.size(); ++i) {
      fits = fits && is_whole(geometry.max[i] - geometry.min[i], spacing, geometry);
    }
    const bool nearer = std::abs(spacing - geometry.spacing) < std::abs(best - geometry.spacing);
    if (fits && (best == 0.0 || nearer)) best = spacing;
  }
  return best;
}

/// Whether the coordinates' digits tell particles from each other, as differences of coordinates.
bool is_resolved(const Geometry& geometry, tables::Diagnosis& diagnosis) {
  constexpr double of_spacing = 1e-7;
  const double round_off = coordinate_round_off(geometry);
  if (round_off <= of_spacing * geometry.spacing) return true;
  diagnosis.error("geometry.min",
                  fmt::format("found so far from the origin that its coordinates are known to "
                              "{:.2g} m, with a spacing of {}",
                              round_off, geometry.spacing),
                  fmt::format("allowed is {:.0e} of the spacing: measure from a point nearer to "
                              "the body",
                              of_spacing));
  return false;
}

void check_spacing(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Geometry& geometry = scene.geometry;
  if (!is_resolved(geometry, diagnosis)) return;
  if (has_elements(scene)) return;  // which fill their box as they are
  double particles = 1.0;
  for (std::size_t i = 0; i < geometry.min.size(); ++i) {
    const double extent = geometry.max[i] - geometry.min[i];
    if (!is_whole(extent, geometry.spacing, geometry)) {
      const double nearest = nearest_spacing(geometry);
      diagnosis.error("geometry.spacing",
                      fmt::format("found {}, which is {} times in the extent {:.12g} along {}",
                                  geometry.spacing, not_whole(extent / geometry.spacing), extent,
                                  name_of(static_cast<Axis>(i))),
                      nearest > 0.0 ? fmt::format("the nearest that fits is {}", nearest)
                                    : "it must be a whole number of times in every extent");
      return;
    }
    particles *= extent / geometry.spacing + 1.0;
  }
  if (particles > most_particles && !scene.grading.enabled) {
    diagnosis.error(
        "geometry.spacing",
        fmt::format("found {}, which makes {:.3g} particles", geometry.spacing, particles),
        fmt::format("allowed are at most {:.0f}", most_particles));
    return;
  }
  const auto counts = lattice_counts(geometry);
  for (std::size_t i = 0; i < geometry.min.size(); ++i) {
    if (counts[i] >= fewest_per_axis) continue;
    diagnosis.error("geometry.spacing",
                    fmt::format("found {}, which makes {} particles along {}", geometry.spacing,
                                counts[i], name_of(static_cast<Axis>(i))),
                    fmt::format("allowed are at least {} along every axis", fewest_per_axis));
    return;
  }
}

std::optional<double> value_of(const std::optional<tables::VaryingNumber>& number) {
  return number ? std::optional(number->value) : std::nullopt;
}

/// A parameter that a model needs, or that has no effect on it.
void check_parameter(const constitutive::ParameterInfo& parameter,
                     const std::optional<double>& value, const Material& material,
                     const std::string& key, tables::Diagnosis& diagnosis) {
  if (!diagnosis.good({key})) return;
  const bool used = parameter.is_used_by(model_of(material));
  if (used && !value) {
    diagnosis.error(key, "is missing", fmt::format("the model {} needs it", material.model));
  } else if (!used && value.value_or(0.0) != 0.0) {
    diagnosis.warning(key, fmt::format("found {}", tables::number_text(*value)),
                      fmt::format("it has no effect on the model {}", material.model));
  }
}

/// A clay in critical states is made by the stress it begins with.
void check_overconsolidation(const Scene& scene, const Material& material, const std::string& table,
                             tables::Diagnosis& diagnosis) {
  const std::string key = table + ".overconsolidation_ratio";
  const auto& ratio = material.overconsolidation_ratio;
  if (!diagnosis.good({key})) return;
  if (!model_of(material).critical_state) {
    if (!ratio) return;
    diagnosis.warning(key, fmt::format("found {}", tables::number_text(*ratio)),
                      fmt::format("it has no effect on the model {}", material.model));
    return;
  }
  if (!ratio) {
    diagnosis.error(key, "is missing", fmt::format("the model {} needs it", material.model));
  }
  const std::string kind = "initial_stress.kind";
  if (!diagnosis.good({kind})) return;
  const InitialStressKind initial = scene.initial_stress.kind;
  if (initial == InitialStressKind::geostatic) return;
  if (initial == InitialStressKind::uniform) {
    const auto stress = uniform_stress(scene, material);
    if (stress[0] + stress[1] + stress[2] < 0.0) return;
    diagnosis.error(kind, fmt::format("found no pressure with the model {}", material.model),
                    "without a mean stress that presses it has no stiffness");
    return;
  }
  diagnosis.error(
      kind,
      fmt::format("found {} with the model {}", name_of(scene.initial_stress.kind), material.model),
      "without a mean stress it has no stiffness: use \"geostatic\"");
}

/// What the model asks of its parameters, in libconstitutive's words.
void check_parameters(const Scene& scene, std::size_t index, const std::string& table,
                      tables::Diagnosis& diagnosis) {
  const Material& material = scene.material[index];
  const auto key = [&](std::string_view name) { return fmt::format("{}.{}", table, name); };
  const constitutive::ModelInfo& model = model_of(material);
  const auto check = [&](const char* name, const std::optional<double>& value) {
    check_parameter(constitutive::parameter_info(name), value, material, key(name), diagnosis);
  };
  check("cohesion", value_of(material.cohesion));
  check("friction_angle", value_of(material.friction_angle));
  check("dilation_angle", value_of(material.dilation_angle));
  check("compression_index", material.compression_index);
  check("swelling_index", material.swelling_index);
  check("critical_stress_ratio", material.critical_stress_ratio);
  const auto note = [&](const char* name, const std::optional<double>& value) {
    if (!value || constitutive::parameter_info(name).is_used_by(model)) return;
    diagnosis.warning(key(name), fmt::format("found {}", tables::number_text(*value)),
                      fmt::format("it has no effect on the model {}", material.model));
  };
  note("tension_cutoff", material.tension_cutoff);
  note("residual_strain", material.residual_strain);
  note("residual_cohesion", material.residual_cohesion);
  note("residual_friction_angle", material.residual_friction_angle);
  material.curve.for_each([&](const char* name, const std::optional<double>& value, bool needed) {
    if (needed) check(name, value);
    note(name, needed ? std::nullopt : value);
  });
  check_overconsolidation(scene, material, table, diagnosis);
  if (diagnosis.good({key("cohesion"), key("friction_angle"), key("dilation_angle"),
                      key("compression_index"), key("swelling_index"), key("intact_strength"),
                      key("power_coefficient")})) {
    const auto parameters = least_parameters(scene, index, diagnosis);
    for (auto& objection : constitutive::joint_objections(parameters, model)) {
      diagnosis.error(key(objection.parameter), objection.found, objection.allowed);
    }
  }
  if (material.model == "von_mises" && scene.geometry.dimension == 3 &&
      diagnosis.good({"geometry.dimension"})) {
    diagnosis.warning(
        key("model"), "found von_mises in 3D",
        "it is the cylinder sqrt(J2) = cohesion: compression carries 1.73 cohesion "
        "where undrained clay has 2; model = \"mohr_coulomb\" with friction_angle = 0 "
        "has its prism");
  }
  if (!model.only_plane_strain.empty() && scene.geometry.dimension == 3 &&
      diagnosis.good({"geometry.dimension", key("match")})) {
    diagnosis.error(key(model.match.empty() ? "model" : "match"),
                    fmt::format("found {} in 3D", model.match.empty() ? model.name : model.match),
                    std::string(model.only_plane_strain));
  }
}

void check_material(const Scene& scene, std::size_t index, tables::Diagnosis& diagnosis) {
  const Material& material = scene.material[index];
  const std::string table = fmt::format("material.{}", index);
  const auto key = [&](const char* name) { return table + "." + name; };

  const bool has_region = !material.region_min.empty() || !material.region_max.empty();
  if (!scene.region.empty()) {
    // They say where it is.
  } else if (index == 0 && has_region) {
    diagnosis.error(material.region_min.empty() ? key("region_max") : key("region_min"),
                    "the first material has a region", "it fills the whole body: leave it out");
  } else if (index > 0 && !has_region && diagnosis.good({key("region_min"), key("region_max")})) {
    diagnosis.error(key("region_min"), "is missing",
                    "every material after the first needs its region");
  } else {
    check_region(material.region_min, material.region_max, table, scene, diagnosis);
  }

  if (diagnosis.good({key("model")})) check_parameters(scene, index, table, diagnosis);
  check_varying(scene, index, diagnosis);
}

}  // namespace

bool check_length(const Point& point, std::size_t wanted, const std::string& key,
                  const Scene& scene, tables::Diagnosis& diagnosis) {
  if (!diagnosis.good({key, "geometry.dimension"})) return false;
  if (point.empty() || point.size() == wanted) return true;
  diagnosis.error(key, fmt::format("found length {}", point.size()),
                  fmt::format("needed is length {}, as geometry.dimension is {}", wanted,
                              scene.geometry.dimension));
  return false;
}

bool box_is_good(const Scene& scene, const tables::Diagnosis& diagnosis) {
  const auto n = static_cast<std::size_t>(scene.geometry.dimension);
  return diagnosis.good({"geometry.dimension", "geometry.min", "geometry.max"}) &&
         scene.geometry.min.size() == n && scene.geometry.max.size() == n;
}

bool check_region(const Point& region_min, const Point& region_max, const std::string& table,
                  const Scene& scene, tables::Diagnosis& diagnosis) {
  const std::string lower = table + ".region_min", upper = table + ".region_max";
  if (!diagnosis.good({lower, upper})) return false;
  if (region_min.empty() && region_max.empty()) return true;
  if (region_min.empty() || region_max.empty()) {
    diagnosis.error(region_min.empty() ? lower : upper, "is missing",
                    "a region needs region_min and region_max");
    return false;
  }
  const auto n = static_cast<std::size_t>(scene.geometry.dimension);
  const bool lower_fits = check_length(region_min, n, lower, scene, diagnosis);
  const bool upper_fits = check_length(region_max, n, upper, scene, diagnosis);
  if (!lower_fits || !upper_fits || !box_is_good(scene, diagnosis)) return false;
  for (std::size_t i = 0; i < n; ++i) {
    const auto axis = name_of(static_cast<Axis>(i));
    if (region_min[i] > region_max[i]) {
      diagnosis.error(upper, fmt::format("found {} along {}", region_max[i], axis),
                      fmt::format("it must not be below region_min, {}", region_min[i]));
      return false;
    }
    const double slack = same_place(scene.geometry);
    if (region_max[i] < scene.geometry.min[i] - slack ||
        region_min[i] > scene.geometry.max[i] + slack) {
      diagnosis.error(
          lower, fmt::format("the region is outside the body along {}", axis),
          fmt::format("the body is from {} to {}", scene.geometry.min[i], scene.geometry.max[i]));
      return false;
    }
  }
  return true;
}

bool check_at(const Point& at, const std::string& key, const Scene& scene,
              tables::Diagnosis& diagnosis) {
  const auto n = static_cast<std::size_t>(scene.geometry.dimension);
  if (at.empty()) return true;
  if (!check_length(at, n, key, scene, diagnosis) || !box_is_good(scene, diagnosis)) return false;
  const double slack = same_place(scene.geometry);
  for (std::size_t i = 0; i < n; ++i) {
    if (at[i] >= scene.geometry.min[i] - slack && at[i] <= scene.geometry.max[i] + slack) continue;
    diagnosis.error(
        key, fmt::format("found {} along {}", at[i], name_of(static_cast<Axis>(i))),
        fmt::format("the body is from {} to {}", scene.geometry.min[i], scene.geometry.max[i]));
    return false;
  }
  return true;
}

void check_geometry(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Geometry& geometry = scene.geometry;
  const auto n = static_cast<std::size_t>(geometry.dimension);
  const bool min_fits = check_length(geometry.min, n, "geometry.min", scene, diagnosis);
  const bool max_fits = check_length(geometry.max, n, "geometry.max", scene, diagnosis);
  if (!min_fits || !max_fits || !box_is_good(scene, diagnosis)) return;
  for (std::size_t i = 0; i < n; ++i) {
    if (geometry.min[i] < geometry.max[i]) continue;
    diagnosis.error(
        "geometry.max",
        fmt::format("found {} along {}", geometry.max[i], name_of(static_cast<Axis>(i))),
        fmt::format("it must be above geometry.min, {}", geometry.min[i]));
  }
  if (diagnosis.good({"geometry.max", "geometry.spacing"})) check_spacing(scene, diagnosis);
}

void check_materials(const Scene& scene, tables::Diagnosis& diagnosis) {
  for (std::size_t i = 0; i < scene.material.size(); ++i) {
    check_material(scene, i, diagnosis);
  }
  check_names(scene.material, "material", diagnosis);
}

void check_hourglass(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Hourglass& hourglass = scene.hourglass;
  if (!diagnosis.good({"hourglass.control", "geometry.dimension", "material"})) return;
  if (hourglass.control == HourglassControl::mixed) {
    const auto refuse = [&](const std::string& found, const std::string& why) {
      diagnosis.error("hourglass.control", found, why);
    };
    bool none_yields = true;
    for (std::size_t i = 0; i < scene.material.size(); ++i) {
      none_yields = none_yields && diagnosis.good({fmt::format("material.{}.model", i)}) &&
                    !yields(scene.material[i]);
    }
    for (const Material& material : scene.material) {
      if (!material.tension_cutoff || !yields(material)) continue;
      refuse(fmt::format("found mixed with the tension_cutoff of {}", material.name),
             "sub-points with one pressure have no tension cut-off: use \"incremental\"");
      break;
    }
    for (const Material& material : scene.material) {
      if (model_of(material).curve == constitutive::Curve::none) continue;
      refuse(fmt::format("found mixed with the model {}", material.model),
             "sub-points with one pressure have no curved envelope: use \"incremental\"");
      break;
    }
    for (const Material& material : scene.material) {
      const bool critical = model_of(material).critical_state;
      if (!critical && !(material.residual_strain && yields(material))) continue;
      refuse(critical ? fmt::format("found mixed with the model {}", material.model)
                      : fmt::format("found mixed with the residual_strain of {}", material.name),
             "sub-points with one pressure have no strength of their own that could change: use "
             "\"incremental\"");
      break;
    }
    if (none_yields) {
      refuse("found mixed with elastic materials only",
             "a body that does not yield gains nothing from sub-points: use \"stiffness\"");
    }
  }
  const bool no_stiffness = hourglass.control == HourglassControl::none ||
                            hourglass.control == HourglassControl::viscosity;
  if (no_stiffness && hourglass.stiffness_ratio.value_or(0.0) != 0.0) {
    diagnosis.warning(
        "hourglass.stiffness_ratio", fmt::format("found {}", *hourglass.stiffness_ratio),
        fmt::format("it has no effect on the control {}", name_of(hourglass.control)));
  }
}

}  // namespace scene
