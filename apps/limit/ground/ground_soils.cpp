#include "limit/ground/ground_soils.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "limit/ground/ground_curves.hpp"
#include "limit/ground/ground_variation.hpp"

namespace limit::ground {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Corner {
  mesh::Point place{0.0, 0.0};
  std::string region;
};

std::vector<Corner> corners_of(const GroundScene& scene, std::size_t m) {
  std::vector<Corner> corners;
  for (const GroundRegion& region : scene.regions) {
    if (region.material != m) continue;
    for (const mesh::Point& place : region.outline) corners.push_back({place, region.name});
  }
  return corners;
}

std::array<double, 2> pair_of(const mesh::Point& place) {
  return {place.x(), place.y()};
}

// Whether a number that changes is known and more than zero wherever its material is.
bool check_number(const tables::VaryingNumber& number, const std::vector<Corner>& corners,
                  const std::string& key, const char* what, double most,
                  tables::Diagnosis& diagnosis) {
  if (!number.varies()) return true;
  const std::string allowed =
      std::isfinite(most)
          ? fmt::format("allowed is {} of more than zero and up to {:g} wherever the material is",
                        what, most)
          : fmt::format("allowed is {} of more than zero wherever the material is", what);
  const auto low =
      number.is_linear() ? std::array{-infinity, -infinity} : number.samples->coverage()[0];
  const auto high =
      number.is_linear() ? std::array{infinity, infinity} : number.samples->coverage()[1];
  for (const Corner& corner : corners) {
    const auto place = pair_of(corner.place);
    for (std::size_t i = 0; i < 2; ++i) {
      constexpr double round_off = 1e-9;
      const double slack =
          std::isfinite(low[i]) ? round_off * (std::abs(place[i]) + high[i] - low[i]) : 0.0;
      if (place[i] >= low[i] - slack && place[i] <= high[i] + slack) continue;
      diagnosis.error(
          key,
          fmt::format("found values from {} = {:.6g} to {:.6g}, and region {} reaches "
                      "({:.6g}, {:.6g})",
                      i == 0 ? "x" : "y", low[i], high[i], corner.region, place[0], place[1]),
          "allowed are values for all of where the material is");
      return false;
    }
    const double here = number.at_place(place);
    if (here > 0.0 && here <= most) continue;
    diagnosis.error(
        key,
        fmt::format("{:g} at ({:g}, {:g}), in region {}", here, place[0], place[1], corner.region),
        allowed);
    return false;
  }
  if (number.is_linear()) return true;
  const auto [least, largest] = std::ranges::minmax(number.samples->values);
  if (least > 0.0 && largest <= most) return true;
  diagnosis.error(key, fmt::format("{:g} among its values", least > 0.0 ? largest : least),
                  allowed);
  return false;
}

// How many pieces the ground will be cut into around the samples of a weight that jumps.
std::size_t pieces_of(const tables::Samples& samples, const std::vector<Corner>& corners) {
  if (samples.kind == tables::Samples::Kind::points) return samples.values.size();
  std::size_t pieces = 1;
  for (const Eigen::Index axis : {0, 1}) {
    const auto [low, high] =
        std::ranges::minmax(corners, {}, [&](const Corner& corner) { return corner.place[axis]; });
    const auto along = static_cast<std::size_t>(axis);
    pieces *= samples.cell(along, high.place[axis]) - samples.cell(along, low.place[axis]) + 1;
  }
  return pieces;
}

// Whether a weight is linear, or will be cut into what is.
bool check_weight(const tables::VaryingNumber& weight, const std::vector<Corner>& corners,
                  const std::string& key, tables::Diagnosis& diagnosis) {
  const auto samples = weight.samples;
  if (samples && samples->kind == tables::Samples::Kind::raster && !samples->nearest) {
    diagnosis.error(key, "found a raster",
                    "fpm-limit balances a weight exactly, and between the middles of four cells a "
                    "raster is not linear: allowed is one value in each cell, { raster = ..., "
                    "nearest = true }, for both programs; or a number, one that is linear, a "
                    "table, or points");
    return false;
  }
  constexpr std::size_t most = 1000;
  if (samples && samples->jumps() && !corners.empty() && pieces_of(*samples, corners) > most) {
    diagnosis.error(key,
                    fmt::format("found {} {} over the material", pieces_of(*samples, corners),
                                samples->columns > 0 ? "cells" : "points"),
                    fmt::format("the mesh has sides between what is nearest to each: allowed are "
                                "{}",
                                most));
    return false;
  }
  return check_number(weight, corners, key, "a weight", infinity, diagnosis);
}

mesh::Point middle_of(const std::vector<Corner>& corners) {
  mesh::Point sum(0.0, 0.0);
  for (const Corner& corner : corners) sum += corner.place;
  return sum / static_cast<double>(corners.size());
}

// Values are told from the middle of the corners, so that they are typical of the material there.
void tell_soil(GroundScene& scene, std::size_t m, tables::Diagnosis& diagnosis) {
  GroundMaterial& material = scene.materials[m];
  problem::Soil& soil = material.soil;
  const auto key = [&](const char* name) { return fmt::format("material.{}.{}", m, name); };
  soil.cohesion = material.cohesion.value;
  soil.friction_angle = material.friction_angle.value * degree;
  soil.unit_weight = material.unit_weight.value;
  const std::vector<Corner> corners = corners_of(scene, m);
  constexpr double steepest = 90.0 - 1e-9;
  const bool is_good =
      check_number(material.cohesion, corners, key("cohesion"), "a cohesion", infinity,
                   diagnosis) &&
      check_number(material.friction_angle, corners, key("friction_angle"), "an angle", steepest,
                   diagnosis) &&
      check_weight(material.unit_weight, corners, key("unit_weight"), diagnosis) &&
      (!material.saturated_unit_weight || check_weight(*material.saturated_unit_weight, corners,
                                                       key("saturated_unit_weight"), diagnosis));
  if (!is_good || corners.empty()) return;
  const mesh::Point middle = middle_of(corners);
  const bool is_linear = material.cohesion.is_linear() && !material.friction_angle.varies();
  if (material.cohesion.varies() || !is_linear || material.unit_weight.varies()) {
    soil.centre = middle;
  }
  if (!is_linear) {
    if (!material.cohesion.varies() && material.cohesion.value <= 0.0) {
      diagnosis.error(
          key("cohesion"),
          fmt::format("found {:g}, with a friction angle that changes", material.cohesion.value),
          "allowed is more than zero there, as a trace of a thousandth of the load");
      return;
    }
    soil.variation =
        std::make_shared<const GroundVariation>(material.cohesion, material.friction_angle);
    const auto there = soil.variation->at(middle);
    soil.cohesion = there.cohesion;
    soil.friction_angle = there.friction_angle;
  } else if (material.cohesion.varies()) {
    soil.cohesion = material.cohesion.at_place(pair_of(middle));
    soil.cohesion_gradient = {material.cohesion.gradient[0], material.cohesion.gradient[1]};
  }
  if (!material.unit_weight.samples) take_weight(material.unit_weight, soil);
}

// The least tension at which a cut-off changes nothing is that of the apex, infinite in clay. Where
// the strength changes, it must be below the apex everywhere.
void tell_tension(GroundScene& scene, std::size_t m, tables::Diagnosis& diagnosis) {
  const GroundMaterial& material = scene.materials[m];
  problem::Soil& soil = scene.materials[m].soil;
  if (!material.tension_cutoff) return;
  if (*material.tension_cutoff == 0.0 && soil.unit_weight == 0.0 && !soil.has_uneven_weight()) {
    diagnosis.error(fmt::format("material.{}.tension_cutoff", m), "found 0, of soil without weight",
                    "nothing presses it together below a free face, and no stress field can be "
                    "certified: allowed is a trace, as a thousandth of the cohesion, or a weight");
    return;
  }
  std::vector<std::array<double, 2>> places;
  for (const Corner& corner : corners_of(scene, m)) places.push_back(pair_of(corner.place));
  const auto [softest, strongest] = material.cohesion.extremes(places);
  const auto [gentlest, steepest] = material.friction_angle.extremes(places);
  const auto apex = [](double cohesion, double angle) {
    return angle > 0.0 ? cohesion / std::tan(angle * degree) : infinity;
  };
  const double least = apex(softest, steepest), most = apex(strongest, gentlest);
  if (*material.tension_cutoff < least) {
    soil.tension = *material.tension_cutoff;
  } else if (*material.tension_cutoff < most) {
    diagnosis.error(
        fmt::format("material.{}.tension_cutoff", m),
        fmt::format("found {:g}, and the cohesion bears {:g} Pa of tension in one place "
                    "and {:g} in another",
                    *material.tension_cutoff, least, most),
        "allowed is a cut-off below what the cohesion bears everywhere, or none");
  }
}

}  // namespace

void take_weight(const tables::VaryingNumber& weight, problem::Soil& soil) {
  soil.unit_weight = weight.varies() ? weight.at_place(pair_of(soil.centre)) : weight.value;
  soil.weight_gradient = {weight.gradient[0], weight.gradient[1]};
}

void recentre(const mesh::Point& centre, problem::Soil& soil) {
  if (!soil.variation) soil.cohesion = soil.cohesion_at(centre);
  soil.unit_weight = soil.unit_weight_at(centre);
  soil.centre = centre;
}

void tell_soils(GroundScene& scene, tables::Diagnosis& diagnosis) {
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    tell_soil(scene, m, diagnosis);
    tell_curve(scene, m);
  }
  if (!diagnosis.errors().empty()) return;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) tell_tension(scene, m, diagnosis);
}

}  // namespace limit::ground
