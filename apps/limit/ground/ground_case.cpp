#include "limit/ground/ground_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "limit/ground/ground_boundary.hpp"
#include "limit/ground/ground_columns.hpp"
#include "limit/ground/ground_cut.hpp"
#include "limit/ground/ground_footing.hpp"
#include "limit/ground/ground_lift.hpp"
#include "limit/ground/ground_mesh.hpp"
#include "limit/ground/ground_outline.hpp"
#include "limit/ground/ground_pressure.hpp"
#include "limit/ground/ground_skins.hpp"
#include "limit/ground/ground_water.hpp"
#include "limit/ground/ground_words.hpp"

namespace limit::ground {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

void make_weight_live(problem::Soil& soil) {
  soil.live_unit_weight = std::exchange(soil.unit_weight, 0.0);
  soil.live_weight_gradient = std::exchange(soil.weight_gradient, mesh::Point::Zero());
}

// All given loads become live, as a strength that just carries them is sought.
void make_live(problem::Problem& problem) {
  for (problem::Soil& soil : problem.soils) {
    make_weight_live(soil);
    soil.live_seepage = soil.seepage;
    soil.seepage.setZero();
  }
  for (problem::Boundary& boundary : problem.boundaries) {
    boundary.live_normal_stress = boundary.normal_stress;
    boundary.live_shear_stress = boundary.shear_stress;
    boundary.normal_stress = boundary.shear_stress = 0.0;
  }
  problem.pressure_is_live = true;
  problem.footing.live_load = problem.footing.dead_load;
  problem.footing.dead_load = {};
  // Whether it is more or less than one is all that is asked.
  problem.most_multiplier = 4.0;
}

// The problem without its mesh.
problem::Problem loads_of(const GroundScene& scene, const std::optional<Base>& base, bool reduce,
                          tables::Diagnosis& diagnosis) {
  problem::Problem problem;
  for (const GroundMaterial& material : scene.materials) {
    problem::Soil soil = material.soil;
    if (reduce) soil = problem::davis_reduced(soil, material.dilation_angle);
    if (scene.load.sought == Sought::gravity && material.grows) make_weight_live(soil);
    // A share of the weight grows with it, unlike the water of a table.
    if (scene.load.sought == Sought::gravity && scene.water.r_u) {
      soil.live_seepage = std::exchange(soil.seepage, mesh::Point::Zero());
    }
    if (scene.load.sought == Sought::earthquake && material.grows && scene.load.kh != 0.0) {
      soil.live_unit_weight = soil.unit_weight;
      soil.live_weight_gradient = soil.weight_gradient;
    }
    problem.soils.push_back(soil);
  }
  const bool is_shaken = scene.load.sought != Sought::earthquake;
  problem.pull = {is_shaken ? scene.load.kh : 0.0, scene.load.kv - 1.0};
  problem.live_pull = is_shaken ? problem.pull : mesh::Point(scene.load.kh, 0.0);
  problem.pore_pressure = scene.water.in_triangles;
  for (const GroundSide& side : scene.sides) problem.boundaries.push_back(boundary_of(scene, side));
  if (base) problem.footing = footing_of(scene, *base, diagnosis);
  if (scene.load.sought == Sought::strength) make_live(problem);
  return problem;
}

// Largest live load as a stress, over a length.
double live_stress(const problem::Problem& problem, double length) {
  double largest = 0.0;
  for (const problem::Soil& soil : problem.soils) {
    largest = std::max(largest, soil.live_unit_weight * problem.live_pull.norm() * length);
  }
  for (const problem::Boundary& boundary : problem.boundaries) {
    largest = std::max(
        {largest, std::abs(boundary.live_normal_stress), std::abs(boundary.live_shear_stress)});
  }
  for (std::size_t i = 0; i < 2; ++i) {
    largest = std::max(largest, std::abs(problem.footing.live_load[i]) / (2.0 * length));
  }
  return largest;
}

void require_live_load(const GroundScene& scene, const std::optional<Base>& base,
                       const problem::Problem& problem, tables::Diagnosis& diagnosis) {
  const char* allowed = "";
  switch (scene.load.sought) {
    case Sought::footing:
      if (base) return;
      allowed = "a footing's pressure wants a side of kind footing";
      break;
    case Sought::traction:
      allowed = "a traction wants a loaded side with live_pressure or live_shear";
      break;
    case Sought::gravity:
      allowed = "gravity wants a material with a unit_weight that grows";
      break;
    case Sought::earthquake:
      allowed =
          "an earthquake wants kh, 1 or -1 for along +x or -x, and a material with a "
          "unit_weight that grows";
      break;
    case Sought::strength:
      allowed = "strength wants a load: unit weights, pressures, shears";
      break;
  }
  if (live_stress(problem, 1.0) > 0.0) return;
  diagnosis.error("load.sought", "nothing in the scene would grow", allowed);
}

// Ground whose strength is friction alone bears in proportion to what presses on it: where all of
// that grows, or is nothing, so does what it bears.
void require_strength(const GroundScene& scene, const problem::Problem& problem,
                      tables::Diagnosis& diagnosis) {
  if (scene.load.sought == Sought::strength) return;
  const bool bears_more =
      std::ranges::any_of(problem.soils,
                          [](const problem::Soil& soil) {
                            return !soil.is_loose() || soil.unit_weight > 0.0 ||
                                   !soil.weight_gradient.isZero(0.0) || !soil.seepage.isZero(0.0);
                          }) ||
      std::ranges::any_of(problem.boundaries, [](const problem::Boundary& boundary) {
        return boundary.normal_stress != 0.0;
      });
  if (bears_more || problem.pore_pressure) return;
  diagnosis.error("load.sought",
                  "no material has a cohesion, and what friction bears is in proportion to the "
                  "load that grows",
                  "allowed is strength, the factor of safety; or a weight that is given beside, "
                  "water that seeps, or a pressure on another side than the footing's");
}

// Half a footing's width, else half the height of the part of the outline that is free to move.
double length_of(const GroundScene& scene, const GroundOutline& outline,
                 const std::optional<Base>& base) {
  if (base) return base->width / 2.0;
  double low = 0.0, high = 0.0;
  bool is_first = true;
  for (const GroundSegment& segment : outline.segments) {
    if (segment.right >= 0) continue;
    const SideKind kind = scene.sides[static_cast<std::size_t>(segment.side)].kind;
    if (kind != SideKind::free && kind != SideKind::loaded) continue;
    for (const int end : {segment.first, segment.second}) {
      const double y = outline.at(end).y();
      low = is_first ? y : std::min(low, y);
      high = is_first ? y : std::max(high, y);
      is_first = false;
    }
  }
  const double half_height = (high - low) / 2.0;
  return half_height > 0.0 ? half_height : outline.size / 4.0;
}

// Live loads count as far as the multiplier is known to be about one.
problem::Units units_of(const problem::Problem& problem, double length) {
  const double live = problem.most_multiplier ? 1.0 : 0.0;
  double surcharge = 0.0, stress = 0.0;
  for (const problem::Boundary& boundary : problem.boundaries) {
    surcharge = std::max(surcharge, -(boundary.normal_stress + live * boundary.live_normal_stress));
  }
  for (const problem::Soil& soil : problem.soils) {
    const double load = surcharge + (soil.unit_weight + live * soil.live_unit_weight) * length;
    // The tangent of a curved envelope may have next to no cohesion.
    const double strength =
        soil.is_curved()
            ? soil.envelope.radius_about(soil.envelope.unconfined() / 2.0 + load)
            : soil.cohesion * std::cos(soil.friction_angle) + load * std::sin(soil.friction_angle);
    stress += strength / static_cast<double>(problem.soils.size());
  }
  // Clay that just stands has a fifth or so of the weight of the whole height, two lengths: divided
  // by the factor, the strength is no less, however soft it is.
  constexpr double of_weight = 0.36;
  if (problem.most_multiplier) stress = std::max(stress, of_weight * live_stress(problem, length));
  problem::Units units{length, stress, 1.0 / live_stress(problem, length)};
  return units;
}

GroundFineness fineness_of(const GroundScene& scene, const GroundOutline& outline, double length,
                           bool is_lower) {
  double steepest = 0.0;
  for (const GroundMaterial& material : scene.materials) {
    steepest = std::max(steepest, std::tan(material.soil.friction_angle));
  }
  // As the fans of a strip: the lower bound wants more rays, both the more, the more friction.
  constexpr double pi = std::numbers::pi;
  // Between the fans half a unit of length, but neither very few triangles nor very many.
  const double longest =
      std::clamp(length / 2.0, std::sqrt(outline.area / 150.0), std::sqrt(outline.area / 50.0));
  if (is_lower) return {(24.0 + 30.0 * steepest) / pi, 4, 1.5, longest};
  return {(12.0 + 15.0 * steepest) / pi, 4, 2.0, longest};
}

mesh::Mesh mesh_of(const GroundScene& scene, const GroundOutline& outline,
                   const GroundFineness& fineness, const problem::Problem& loads) {
  problem::Problem problem = loads;
  problem.mesh = ground_mesh(scene, outline, fineness);
  return problem.pore_pressure ? with_inner_nodes(problem) : problem.mesh;
}

// The meshes of triangles longer than high; none where the ground is too narrow for them.
void add_long_meshes(const GroundScene& scene, const GroundOutline& outline, double length,
                     problem::Case& result) {
  // A soil of friction phi is squeezed along one axis by next to nothing as it grows across it; its
  // lines of slip, at 45 - phi / 2 to that axis, are at 45 degrees where that axis is squeezed by
  // tan(45 + phi / 2): 4 at 62 degrees, 16 at 83.
  for (const double stretch : {4.0, 16.0}) {  // powers of two: nothing is rounded
    GroundOutline squeezed = outline;
    for (mesh::Point& point : squeezed.points) point.x() /= stretch;
    squeezed.area /= stretch;
    const auto add = [&](bool is_lower, std::vector<mesh::Mesh>& meshes) {
      mesh::Mesh mesh = mesh_of(scene, squeezed, fineness_of(scene, squeezed, length, is_lower),
                                is_lower ? result.lower : result.upper);
      for (mesh::Point& node : mesh.nodes) node.x() *= stretch;
      mesh.stretch = stretch;
      meshes.push_back(std::move(mesh));
    };
    try {
      add(true, result.long_lower);
      add(false, result.long_upper);
    } catch (const GroundTooFine&) {
      continue;
    }
  }
}

// Twice as coarse as the upper bound's first mesh everywhere.
mesh::Mesh rough_mesh(const GroundScene& scene, const GroundOutline& outline, double length,
                      const problem::Problem& loads) {
  GroundFineness fineness = fineness_of(scene, outline, length, false);
  fineness.rays_per_radian /= 2.0;
  fineness.rings /= 2;
  fineness.longest *= 2.0;
  return mesh_of(scene, outline, fineness, loads);
}

problem::Case case_of(const GroundScene& scene, const GroundOutline& outline,
                      const std::optional<Base>& base, bool reduce, tables::Diagnosis& diagnosis) {
  problem::Case result;
  result.title = scene.title.empty() ? "ground of polygons" : scene.title;
  result.names = scene.units;
  result.unit = scene.units.stress;
  describe(scene, result);
  result.lower = loads_of(scene, base, reduce, diagnosis);
  if (diagnosis.errors().empty()) require_live_load(scene, base, result.lower, diagnosis);
  if (diagnosis.errors().empty()) require_strength(scene, result.lower, diagnosis);
  if (diagnosis.errors().empty() && !reduce && scene.load.sought != Sought::gravity) {
    check_bare_faces(scene, outline, result.lower, diagnosis);
    check_ends_of_pressure(scene, outline, result.lower, diagnosis);
  }
  if (!diagnosis.errors().empty()) return result;
  result.assumptions = assumptions_of(scene, result.lower, base);
  const double length = length_of(scene, outline, base);
  result.units = units_of(result.lower, length);
  result.upper = result.lower;
  if (result.seeks_strength) {
    say_skins(scene, outline, result.lower, result);
  }
  say_ends_of_live_pressure(scene, outline, result.lower, result);
  say_pressure(scene, outline, result);
  try {
    result.lower.mesh =
        mesh_of(scene, outline, fineness_of(scene, outline, length, true), result.lower);
    result.upper.mesh =
        mesh_of(scene, outline, fineness_of(scene, outline, length, false), result.upper);
  } catch (const GroundTooFine& narrow) {
    diagnosis.error(
        fmt::format("region.{}.outline", scene.regions[narrow.region].number),
        fmt::format("so narrow at ({:.6g}, {:.6g}) that a mesh would begin with more than {} "
                    "triangles",
                    narrow.place.x(), narrow.place.y(), most_first_triangles),
        "triangles are as small as the narrowest place near them; layers and gaps are wider, or "
        "left out");
    return result;
  }
  if (result.seeks_strength && scene.materials.size() > 1) {
    result.rough_upper = rough_mesh(scene, outline, length, result.upper);
    add_long_meshes(scene, outline, length, result);
  }
  return result;
}

bool weighs_by_samples(const GroundMaterial& material) {
  return material.unit_weight.samples ||
         (material.saturated_unit_weight && material.saturated_unit_weight->samples);
}

// What Davis reduces is one friction angle by one dilation angle.
bool has_davis_twin(const GroundMaterial& material) {
  return material.dilation_angle != material.soil.friction_angle &&
         !material.friction_angle.varies();
}

}  // namespace

std::optional<problem::Cases> ground_case(const GroundScene& told, tables::Diagnosis& diagnosis) {
  if (!can_mesh_ground) {
    diagnosis.error("region", "ground of polygons",
                    "this fpm-limit was built without CGAL, which meshes such ground and is under "
                    "the GPL; `./fpmw build` builds one with it (cmake -DFPM_WITH_CGAL=ON)");
    return std::nullopt;
  }
  GroundOutline outline = ground_outline(told, diagnosis);
  if (!diagnosis.errors().empty()) return std::nullopt;
  GroundScene scene = told;
  const bool has_samples = std::ranges::any_of(scene.materials, weighs_by_samples);
  if (has_samples) {
    cut_along_tables(scene);
    cut_between_samples(scene);
  }
  if (scene.water.is_there() || has_samples) {
    wet(scene, diagnosis);
    if (diagnosis.errors().empty()) outline = ground_outline(scene, diagnosis);
    if (!diagnosis.errors().empty()) return std::nullopt;
  }
  const bool has_columns = cut_columns(scene, outline, diagnosis);
  if (!diagnosis.errors().empty()) return std::nullopt;
  if (has_columns) outline = ground_outline(scene, diagnosis);
  if (!diagnosis.errors().empty()) return std::nullopt;
  if (scene.water.in_triangles) {
    divide_at_kinks(scene, scene.water.in_triangles->field(), outline);
  }
  const std::optional<Base> base = find_base(scene, outline, diagnosis);
  if (!diagnosis.errors().empty()) return std::nullopt;
  problem::Cases result{case_of(scene, outline, base, false, diagnosis), std::nullopt};
  if (!diagnosis.errors().empty()) return std::nullopt;
  note_dilation(scene, result.associated);
  if (std::ranges::none_of(scene.materials, has_davis_twin)) return result;
  result.davis = case_of(scene, outline, base, true, diagnosis);
  if (!diagnosis.errors().empty()) return std::nullopt;
  // Both in the same units, for one report.
  result.davis->units = result.associated.units;
  return result;
}

}  // namespace limit::ground
