#include "limit/footing/scene_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "limit/mesh/cut.hpp"
#include "scene/derived.hpp"
#include "scene/scene.hpp"
#include "scene/water.hpp"

namespace limit::footing {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

// The strip of the scene; its soil is that below the footing's edge.
struct Footing2d {
  problem::Strip strip;
  problem::Box box;
  mesh::Point axis_at_surface;
  std::vector<problem::Soil> soils;  // as the materials
  bool wall_is_rough = false, floor_is_rough = false;
};

/// Finds the footing and says what of the scene belongs to none.
class Reader {
 public:
  Reader(const scene::Scene& scene, tables::Diagnosis& diagnosis)
      : scene_(scene), diagnosis_(diagnosis) {}

  // With a strip of no soil. Incomplete, if the diagnosis has an error then.
  Footing2d footing() {
    const scene::Geometry& geometry = scene_.geometry;
    require(geometry.dimension == 2, "geometry.dimension", "found 3");
    const double left = geometry.min[0], top = geometry.max[1];
    require(scene_.symmetry.size() == 1 && scene_.symmetry[0].axis == scene::Axis::x &&
                scene_.symmetry[0].position == left,
            "symmetry", "the left side is no mirror");
    const scene::Drive& drive = scene_.drive;
    const bool presses = drive.kind == scene::DriveKind::displacement &&
                         drive.side == scene::Side::top && drive.direction[0] == 0.0 &&
                         drive.direction[1] < 0.0;
    require(presses, "drive", "nothing is pressed down into the top");
    const bool reaches = !drive.range_min.empty() && drive.range_min[0] <= left &&
                         drive.range_max[0] < geometry.max[0];
    if (presses) {
      require(reaches, "drive.range_min",
              "the footing does not reach from the mirror to a place on the top");
    }
    require(drive.contact.friction_angle == 0.0 && drive.contact.adhesion == 0.0, "drive",
            "its plate has a friction or adhesion of its own");
    require(scene_.approximation.interfaces != scene::InterfaceKind::contact &&
                std::ranges::count(scene_.interface, scene::InterfaceKind::contact,
                                   &scene::Interface::kind) == 0,
            "interface", "bodies slide on each other");
    require(scene_.cutout.empty(), "cutout", "the body has cutouts");
    require(scene_.initial_stress.loaded_sides.empty(), "initial_stress.loaded_sides",
            "the initial stress loads sides, in ground without weight");
    require(!scene::has_water(scene_), "water",
            "the ground is under water; in ground of [[region]]s it may be");
    take_supports();
    if (!diagnosis_.errors().empty()) return found_;
    take_tractions(drive.range_max[0]);
    found_.axis_at_surface = mesh::Point(left, top);
    found_.strip.half_width = drive.range_max[0] - left;
    // Without friction contact holds nothing along its face.
    found_.strip.rough =
        drive.lateral == scene::Lateral::fixed && drive.method != scene::DriveMethod::contact;
    found_.box = {(geometry.max[0] - left) / found_.strip.half_width,
                  (top - geometry.min[1]) / found_.strip.half_width};
    const double gravity = downwards();
    for (std::size_t m = 0; m < scene_.material.size(); ++m) take_soil(m, gravity);
    return found_;
  }

 private:
  void require(bool holds, const std::string& key, const std::string& why) {
    if (!holds) {
      diagnosis_.error(key, why, "fpm-limit brackets footings on one half of a plane body only");
    }
  }

  double downwards() {
    const scene::Point& acceleration = scene_.gravity.acceleration;
    if (acceleration.empty()) return 0.0;
    require(acceleration[0] == 0.0 && acceleration[1] <= 0.0, "gravity.acceleration",
            "it does not act downwards");
    return -acceleration[1];
  }

  void take_soil(std::size_t m, double gravity) {
    const scene::Material& material = scene_.material[m];
    const std::string table = fmt::format("material.{}.", m);
    require(scene::yields(material), table + "model", "an elastic material never yields");
    require(material.match == "plane_strain", table + "match",
            "only strengths matched in plane strain are those of Mohr-Coulomb");
    require(!material.tension_cutoff, table + "tension_cutoff",
            "the bounds are those of a soil without a tension cut-off");
    require(!material.residual_strain, table + "residual_strain",
            "the bounds are those of a soil whose strength stays");
    require(!material.curve.intact_strength && !material.curve.power_coefficient, table + "model",
            "strength of a curved envelope is for ground of [[region]]s");
    require(!material.overconsolidation_ratio, table + "model",
            "the bounds are those of a soil whose strength stays");
    const auto require_one = [&](const tables::VaryingNumber& number, const char* key) {
      require(!number.varies(), table + key,
              "it changes from place to place; in ground of [[region]]s it may");
    };
    require_one(material.cohesion.value_or(0.0), "cohesion");
    require_one(material.friction_angle.value_or(0.0), "friction_angle");
    require_one(material.density, material.unit_weight ? "unit_weight" : "density");
    problem::Soil soil;
    soil.cohesion = material.cohesion.value_or(0.0).value;
    soil.friction_angle = material.friction_angle.value_or(0.0).value * degree;
    soil.unit_weight = material.density.value * gravity;
    found_.soils.push_back(soil);
    if (!diagnosis_.errors().empty()) return;
    problem::Strip strip = found_.strip;
    strip.soil = found_.soils.back();
    if (const auto objection = problem::objection_to(strip)) {
      diagnosis_.error(table + objection->key, objection->found, objection->allowed);
    }
  }

  static bool fixes(const scene::Support& support, scene::Axis axis) {
    return std::count(support.directions.begin(), support.directions.end(), axis) != 0;
  }

  void take_supports() {
    bool has_wall = false, has_floor = false;
    for (std::size_t i = 0; i < scene_.support.size(); ++i) {
      const scene::Support& support = scene_.support[i];
      const std::string key = fmt::format("support.{}", i);
      const bool along_x = fixes(support, scene::Axis::x), along_y = fixes(support, scene::Axis::y);
      if (!support.side) {
        require(false, key, "it holds something else than a whole side");
      } else if (*support.side == scene::Side::right) {
        has_wall = has_wall || along_x;
        found_.wall_is_rough = found_.wall_is_rough || along_y;
      } else if (*support.side == scene::Side::bottom) {
        has_floor = has_floor || along_y;
        found_.floor_is_rough = found_.floor_is_rough || along_x;
      } else {
        require(false, key, "it holds neither the bottom nor the right side");
      }
    }
    require(has_wall && has_floor, "support",
            "the right side or the bottom may move across itself");
  }

  void take_tractions(double edge) {
    for (std::size_t i = 0; i < scene_.traction.size(); ++i) {
      const scene::Traction& traction = scene_.traction[i];
      const bool covers_surface =
          traction.range_min.empty() ||
          (traction.range_min[0] <= edge && traction.range_max[0] >= scene_.geometry.max[0]);
      require(traction.side == scene::Side::top && covers_surface && traction.value[0] == 0.0 &&
                  traction.value[1] <= 0.0,
              fmt::format("traction.{}", i),
              "it is no surcharge on the whole surface beside the footing");
      found_.strip.surcharge -= traction.value[1];
    }
  }

  const scene::Scene& scene_;
  tables::Diagnosis& diagnosis_;
  Footing2d found_;
};

int region_at(const scene::Scene& scene, const mesh::Point& place) {
  return static_cast<int>(scene::material_at(scene, {place.data(), 2}));
}

mesh::Mesh divided(const scene::Scene& scene, mesh::Mesh mesh) {
  std::array<std::vector<double>, 2> lines;
  for (const scene::Material& material : scene.material) {
    for (std::size_t i = 0; i < material.region_min.size(); ++i) {
      for (const double at : {material.region_min[i], material.region_max[i]}) {
        const bool is_done = std::count(lines[i].begin(), lines[i].end(), at) != 0;
        if (is_done || at <= scene.geometry.min[i] || at >= scene.geometry.max[i]) continue;
        mesh = mesh::cut(mesh, static_cast<int>(i), at, lines[i]);
        lines[i].push_back(at);
      }
    }
  }
  for (mesh::Triangle& triangle : mesh.triangles) {
    mesh::Point centre(0, 0);
    for (const int node : triangle.nodes)
      centre += mesh.nodes[static_cast<std::size_t>(node)] / 3.0;
    triangle.region = region_at(scene, centre);
  }
  return mesh;
}

problem::Problem problem_of(const scene::Scene& scene, const Footing2d& footing,
                            const mesh::Fan& fan) {
  problem::Problem problem = problem::strip_problem(footing.strip, fan);
  for (mesh::Point& node : problem.mesh.nodes) node += footing.axis_at_surface;
  problem.mesh = divided(scene, std::move(problem.mesh));
  problem.soils = footing.soils;
  const auto tangential = [&](mesh::FanBoundary which, bool rough) {
    problem.boundaries[static_cast<std::size_t>(which)].tangential =
        rough ? problem::Known::support : problem::Known::traction;
  };
  tangential(mesh::FanBoundary::wall, footing.wall_is_rough);
  tangential(mesh::FanBoundary::floor, footing.floor_is_rough);
  return problem;
}

problem::Case case_of(const scene::Scene& scene, const Footing2d& footing) {
  problem::Strip strip = footing.strip;
  double steepest = 0.0;
  for (const problem::Soil& soil : footing.soils) {
    steepest = std::max(steepest, soil.friction_angle);
  }
  // The soil at the footing's edge, just below it, gives the scales and the hand formulas.
  constexpr double just = 1e-6;
  const mesh::Point edge = footing.axis_at_surface + strip.half_width * mesh::Point(1.0, -just);
  strip.soil = footing.soils[static_cast<std::size_t>(region_at(scene, edge))];

  problem::Case result = problem::strip_case(strip, footing.box);
  const bool is_layered = footing.soils.size() > 1;
  if (!scene.title.empty()) result.title = scene.title + "\n" + result.title;
  if (is_layered) {
    result.hand.clear();
    result.data.resize(1);
    for (std::size_t m = 0; m < footing.soils.size(); ++m) {
      const problem::Soil& soil = footing.soils[m];
      result.data.emplace_back(scene.material[m].name,
                               fmt::format("c = {:g} Pa, phi = {:g} deg, {:g} N/m3", soil.cohesion,
                                           soil.friction_angle / degree, soil.unit_weight));
    }
    result.data.emplace_back("surcharge", fmt::format("{:g} Pa", strip.surcharge));
  }
  result.assumptions[1] = fmt::format(
      "the scene's own box, {:.4g} half widths wide and {:.4g} deep; {} right side, {} "
      "bottom",
      footing.box.width, footing.box.depth, footing.wall_is_rough ? "rough" : "smooth",
      footing.floor_is_rough ? "rough" : "smooth");
  problem::Strip sharpest = strip;
  sharpest.soil.friction_angle = steepest;
  result.lower = problem_of(scene, footing, problem::lower_fan(sharpest, footing.box));
  result.upper = problem_of(scene, footing, problem::upper_fan(sharpest, footing.box));
  return result;
}

}  // namespace

std::optional<problem::Cases> scene_case(const scene::Scene& scene, bool tension,
                                         tables::Diagnosis& diagnosis) {
  Footing2d footing = Reader(scene, diagnosis).footing();
  if (!diagnosis.errors().empty()) return std::nullopt;
  footing.strip.tension = tension;
  problem::Cases result{case_of(scene, footing), std::nullopt};
  if (scene::is_associated(scene)) return result;
  for (std::size_t m = 0; m < footing.soils.size(); ++m) {
    const double dilation = scene.material[m].dilation_angle.value_or(0.0).value * degree;
    footing.soils[m] = problem::davis_reduced(footing.soils[m], dilation);
  }
  result.davis = case_of(scene, footing);
  // Both in the same units, for one report.
  result.davis->units = result.associated.units;
  return result;
}

}  // namespace limit::footing
