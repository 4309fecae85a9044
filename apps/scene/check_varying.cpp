#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "constitutive/parameters.hpp"
#include "scene/check.hpp"
#include "scene/derived.hpp"
#include "scene/element_body.hpp"
#include "scene/ground.hpp"
#include "scene/names.hpp"

namespace scene {
namespace {

// The coordinates along an axis of the faces of all boxes of materials, within the body.
std::vector<double> faces_along(const Scene& scene, std::size_t axis) {
  const double low = scene.geometry.min[axis], high = scene.geometry.max[axis];
  std::vector<double> faces{low, high};
  for (const Material& material : scene.material) {
    for (const Point* corner : {&material.region_min, &material.region_max}) {
      if (axis < corner->size()) faces.push_back(std::clamp((*corner)[axis], low, high));
    }
  }
  std::ranges::sort(faces);
  return faces;
}

// Corners of the boxes, in the plane, that the body is made of where it is of a material.
std::vector<PlanePoint> corners_of_boxes(const Scene& scene, std::size_t index) {
  const auto x = faces_along(scene, 0), y = faces_along(scene, 1);
  // In space a material may be anywhere along the third axis.
  const bool plane = scene.geometry.dimension == 2;
  std::vector<PlanePoint> corners;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      if (x[i] == x[i + 1] || y[j] == y[j + 1]) continue;
      const std::array<double, 2> middle{0.5 * (x[i] + x[i + 1]), 0.5 * (y[j] + y[j + 1])};
      if (plane && material_at(scene, middle) != index) continue;
      corners.insert(corners.end(),
                     {{x[i], y[j]}, {x[i + 1], y[j]}, {x[i + 1], y[j + 1]}, {x[i], y[j + 1]}});
    }
  }
  return corners;
}

// Whether a region is of a material at first, or becomes so in a stage.
bool is_ever_of(const Scene& scene, const Region& region, const std::string& material) {
  if (region.material == material) return true;
  return std::ranges::any_of(scene.stage, [&](const Stage& stage) {
    for (std::size_t k = 0; k < std::min(stage.regions.size(), stage.become.size()); ++k) {
      if (stage.regions[k] == region.name && stage.become[k] == material) return true;
    }
    return false;
  });
}

// Corners of a solid's elements that are of a material.
std::vector<PlanePoint> corners_of_elements(const Scene& scene, std::size_t index) {
  std::vector<PlanePoint> corners;
  const ElementBody body = elements_of(scene);
  for (const shape::MeshPart& part : body.joined.parts) {
    const Region& region = scene.region[static_cast<std::size_t>(part.region)];
    if (!is_ever_of(scene, region, scene.material[index].name)) continue;
    for (const int node : body.mesh.elements[static_cast<std::size_t>(part.element)].nodes) {
      corners.emplace_back(body.mesh.at(node).x(), body.mesh.at(node).y());
    }
  }
  return corners;
}

// Corners of where a material is, in the plane.
std::vector<PlanePoint> corners_of(const Scene& scene, std::size_t index) {
  if (scene.region.empty()) return corners_of_boxes(scene, index);
  if (is_solid(scene)) return corners_of_elements(scene, index);
  std::vector<PlanePoint> corners;
  for (const Region& region : scene.region) {
    if (!is_ever_of(scene, region, scene.material[index].name)) continue;
    corners.insert(corners.end(), region.outline.begin(), region.outline.end());
  }
  return corners;
}

// Whether each material after the first has its box.
bool have_boxes(const Scene& scene) {
  const auto n = static_cast<std::size_t>(scene.geometry.dimension);
  return !scene.region.empty() ||
         std::all_of(scene.material.begin() + 1, scene.material.end(), [&](const Material& m) {
           return m.region_min.size() == n && m.region_max.size() == n;
         });
}

using Places = std::vector<std::array<double, 2>>;

// Corners of where a material is; none where that is not known.
Places places_of(const Scene& scene, std::size_t index, const tables::Diagnosis& diagnosis) {
  Places places;
  if (!box_is_good(scene, diagnosis) || !have_boxes(scene)) return places;
  for (const PlanePoint& corner : corners_of(scene, index)) {
    places.push_back({corner.x(), corner.y()});
  }
  return places;
}

// Whether samples speak of all of where a material is.
bool covers(const tables::Samples& samples, const Places& places, const std::string& key,
            tables::Diagnosis& diagnosis) {
  const auto [low, high] = samples.coverage();
  constexpr double round_off = 1e-9;
  for (const auto& place : places) {
    for (std::size_t i = 0; i < 2; ++i) {
      const double slack = round_off * (std::abs(place[i]) + std::abs(high[i] - low[i]));
      if (std::isinf(low[i]) || (place[i] >= low[i] - slack && place[i] <= high[i] + slack)) {
        continue;
      }
      diagnosis.error(
          key,
          fmt::format("found values from {} = {:.6g} to {:.6g}, and the material reaches "
                      "({:.6g}, {:.6g})",
                      name_of(static_cast<Axis>(i)), low[i], high[i], place[0], place[1]),
          "allowed are values for all of where the material is");
      return false;
    }
  }
  return true;
}

// What a number that changes may be.
struct Allowed {
  const char* name;
  double least, most;  // the least itself is excluded unless it may be reached
  bool least_too;
  const char* words;
};

void check_number(const tables::VaryingNumber& number, const Allowed& allowed,
                  const std::string& table, const Places& places, tables::Diagnosis& diagnosis) {
  const std::string key = fmt::format("{}.{}", table, allowed.name);
  if (!number.varies() || !diagnosis.good({key})) return;
  const auto is_good = [&](double here) {
    return (here > allowed.least || (allowed.least_too && here == allowed.least)) &&
           here < allowed.most;
  };
  if (!number.is_linear()) {
    if (!covers(*number.samples, places, key, diagnosis)) return;
    const auto& values = number.samples->values;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (is_good(values[i])) continue;
      diagnosis.error(key, fmt::format("{:g} among its values", values[i]), allowed.words);
      return;
    }
    return;
  }
  // A linear value is least and most in corners.
  for (const auto& place : places) {
    const double here = number.at_place(place);
    if (is_good(here)) continue;
    diagnosis.error(key, fmt::format("{:g} at ({:g}, {:g})", here, place[0], place[1]),
                    allowed.words);
    return;
  }
}

}  // namespace

std::string dilation_objection(const Scene& scene, std::size_t index,
                               const tables::Diagnosis& diagnosis) {
  const Material& material = scene.material[index];
  const tables::VaryingNumber none;
  const auto friction = material.friction_angle.value_or(none);
  const auto dilation = material.dilation_angle.value_or(none);
  if (friction == dilation) return "";
  const Places places = places_of(scene, index, diagnosis);
  const auto words = [](double phi, double psi) {
    return psi > phi ? fmt::format("has {:g}, and dilates by {:g}", phi, psi) : std::string();
  };
  if (!friction.is_linear() || !dilation.is_linear() || places.empty()) {
    return words(friction.extremes(places).first, dilation.extremes(places).second);
  }
  for (const auto& place : places) {
    auto found = words(friction.at_place(place), dilation.at_place(place));
    if (!found.empty()) return found;
  }
  return "";
}

constitutive::MaterialParameters least_parameters(const Scene& scene, std::size_t index,
                                                  const tables::Diagnosis& diagnosis) {
  const Material& material = scene.material[index];
  constitutive::MaterialParameters parameters = parameters_of(material);
  const Places places = places_of(scene, index, diagnosis);
  if (material.cohesion && material.cohesion->varies()) {
    const auto [least, most] = material.cohesion->extremes(places);
    // Clay may be without strength at a surface.
    parameters.cohesion = least > 0.0 ? least : std::max(most, 1.0);
  }
  const auto changes = [](const auto& number) { return number && number->varies(); };
  if (changes(material.friction_angle) || changes(material.dilation_angle)) {
    if (material.friction_angle && parameters.friction_angle > 0.0) {
      parameters.friction_angle = material.friction_angle->extremes(places).first;
    }
    parameters.dilation_angle = 0.0;
  }
  return parameters;
}

double most_friction(const Scene& scene, std::size_t index, const tables::Diagnosis& diagnosis) {
  const double one = parameters_of(scene.material[index]).friction_angle;
  const auto& told = scene.material[index].friction_angle;
  if (one == 0.0 || !told || !told->varies()) return one;
  return told->extremes(places_of(scene, index, diagnosis)).second;
}

void check_varying(const Scene& scene, std::size_t index, tables::Diagnosis& diagnosis) {
  const Material& material = scene.material[index];
  const Places places = places_of(scene, index, diagnosis);
  constexpr double infinity = std::numeric_limits<double>::infinity(), right_angle = 90.0;
  const std::string table = fmt::format("material.{}", index);
  const auto check = [&](const std::optional<tables::VaryingNumber>& number,
                         const Allowed& allowed) {
    if (number) check_number(*number, allowed, table, places, diagnosis);
  };
  check(material.youngs_modulus,
        {"youngs_modulus", 0.0, infinity, false,
         "allowed is a modulus of more than zero wherever the material is"});
  // Particles of cells are within their material.
  const bool may_vanish = scene.geometry.layout == Layout::cell;
  check(material.cohesion,
        {"cohesion", 0.0, infinity, may_vanish,
         may_vanish ? "allowed is a cohesion of zero or more wherever the material is"
                    : "allowed is a cohesion of more than zero wherever the material is"});
  constexpr const char* angle =
      "allowed is an angle from zero to below 90 wherever the material is";
  check(material.friction_angle, {"friction_angle", 0.0, right_angle, true, angle});
  check(material.dilation_angle, {"dilation_angle", 0.0, right_angle, true, angle});
  constexpr const char* weight = "allowed is more than zero wherever the material is";
  check(material.unit_weight, {"unit_weight", 0.0, infinity, false, weight});
  check(material.saturated_unit_weight, {"saturated_unit_weight", 0.0, infinity, false, weight});
  const bool is_weight = material.unit_weight && material.unit_weight->varies();
  if (!is_weight) check(material.density, {"density", 0.0, infinity, false, weight});
  const auto changes = [](const auto& number) { return number && number->varies(); };
  const std::string friction = table + ".friction_angle", dilation = table + ".dilation_angle";
  if ((changes(material.friction_angle) || changes(material.dilation_angle)) &&
      diagnosis.good({friction, dilation, table + ".model"}) && model_of(material).frictional) {
    const std::string found = dilation_objection(scene, index, diagnosis);
    if (!found.empty()) {
      diagnosis.error(dilation, found,
                      "a material dilates by its friction angle at most: where both change by "
                      "samples, by the least of it, or by the same samples");
    }
  }
}

}  // namespace scene
