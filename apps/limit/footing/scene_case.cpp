#include "limit/footing/scene_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "limit/mesh/cut.hpp"

namespace limit::footing {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

void require(bool holds, const std::string& key, const std::string& why) {
  if (!holds) {
    throw std::invalid_argument(fmt::format(
        "{}: {}; fpm-limit brackets footings on one half of a plane body only", key, why));
  }
}

// The strip of the scene; its soil is that below the footing's edge.
struct Footing2d {
  problem::Strip strip;
  problem::Box box;
  mesh::Point axis_at_surface;
  std::vector<problem::Soil> soils;  // as the materials
  bool wall_is_rough = false, floor_is_rough = false;
};

double gravity_of(const scene::Scene& scene) {
  const scene::Point& acceleration = scene.gravity.acceleration;
  if (acceleration.empty()) return 0.0;
  require(acceleration[0] == 0.0 && acceleration[1] <= 0.0, "gravity.acceleration",
          "it does not act downwards");
  return -acceleration[1];
}

problem::Soil soil_of(const scene::Material& material, double gravity, bool reduce) {
  const std::string key = "material." + material.name;
  require(material.model != scene::MaterialModel::elastic, key + ".model",
          "an elastic material never yields");
  require(material.match == scene::ConeMatch::plane_strain, key + ".match",
          "only strengths matched in plane strain are those of Mohr-Coulomb");
  problem::Soil soil{material.cohesion.value_or(0.0),
                     material.friction_angle.value_or(0.0) * degree, material.density * gravity};
  if (!reduce) return soil;
  return problem::davis_reduced(soil, material.dilation_angle.value_or(0.0) * degree);
}

bool fixes(const scene::Support& support, scene::Axis axis) {
  return std::count(support.directions.begin(), support.directions.end(), axis) != 0;
}

void take_supports(const scene::Scene& scene, Footing2d& footing) {
  bool has_wall = false, has_floor = false;
  for (const scene::Support& support : scene.support) {
    const std::string key = "support." + support.name;
    require(support.side.has_value(), key, "it holds something else than a whole side");
    const bool along_x = fixes(support, scene::Axis::x), along_y = fixes(support, scene::Axis::y);
    if (*support.side == scene::Side::right) {
      has_wall = has_wall || along_x;
      footing.wall_is_rough = footing.wall_is_rough || along_y;
    } else if (*support.side == scene::Side::bottom) {
      has_floor = has_floor || along_y;
      footing.floor_is_rough = footing.floor_is_rough || along_x;
    } else {
      require(false, key, "it holds neither the bottom nor the right side");
    }
  }
  require(has_wall && has_floor, "support", "the right side or the bottom may move across itself");
}

void take_tractions(const scene::Scene& scene, double edge, Footing2d& footing) {
  for (const scene::Traction& traction : scene.traction) {
    const std::string key = "traction." + traction.name;
    const bool covers_surface =
        traction.range_min.empty() ||
        (traction.range_min[0] <= edge && traction.range_max[0] >= scene.geometry.max[0]);
    require(traction.side == scene::Side::top && covers_surface && traction.value[0] == 0.0 &&
                traction.value[1] <= 0.0,
            key, "it is no surcharge on the whole surface beside the footing");
    footing.strip.surcharge -= traction.value[1];
  }
}

Footing2d footing_of(const scene::Scene& scene, bool reduce) {
  const scene::Geometry& geometry = scene.geometry;
  require(geometry.dimension == 2, "geometry.dimension", "found 3");
  const double left = geometry.min[0], top = geometry.max[1];
  require(scene.symmetry.size() == 1 && scene.symmetry[0].axis == scene::Axis::x &&
              scene.symmetry[0].position == left,
          "symmetry", "the left side is no mirror");
  const scene::Drive& drive = scene.drive;
  require(drive.kind == scene::DriveKind::displacement && drive.side == scene::Side::top &&
              drive.direction[0] == 0.0 && drive.direction[1] < 0.0,
          "drive", "nothing is pressed down into the top");
  require(!drive.range_min.empty() && drive.range_min[0] <= left &&
              drive.range_max[0] < geometry.max[0],
          "drive.range_min", "the footing does not reach from the mirror to a place on the top");

  Footing2d footing;
  footing.axis_at_surface = mesh::Point(left, top);
  footing.strip.half_width = drive.range_max[0] - left;
  footing.strip.rough = drive.lateral == scene::Lateral::fixed;
  footing.box = {(geometry.max[0] - left) / footing.strip.half_width,
                 (top - geometry.min[1]) / footing.strip.half_width};
  const double gravity = gravity_of(scene);
  for (const scene::Material& material : scene.material) {
    footing.soils.push_back(soil_of(material, gravity, reduce));
  }
  take_supports(scene, footing);
  take_tractions(scene, drive.range_max[0], footing);
  return footing;
}

// The last material whose region holds the place.
int region_at(const scene::Scene& scene, const mesh::Point& place) {
  for (std::size_t m = scene.material.size(); m-- > 0;) {
    const scene::Material& material = scene.material[m];
    bool inside = true;
    for (std::size_t i = 0; i < material.region_min.size(); ++i) {
      const double x = place[static_cast<Eigen::Index>(i)];
      inside = inside && x >= material.region_min[i] && x <= material.region_max[i];
    }
    if (inside) return static_cast<int>(m);
  }
  throw std::invalid_argument("material: no material fills the whole body");
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

problem::Case case_of(const scene::Scene& scene, bool tension, bool reduce) {
  Footing2d footing = footing_of(scene, reduce);
  problem::Strip& strip = footing.strip;
  strip.tension = tension;
  double steepest = 0.0;
  for (std::size_t m = 0; m < footing.soils.size(); ++m) {
    strip.soil = footing.soils[m];
    steepest = std::max(steepest, strip.soil.friction_angle);
    problem::check(strip);
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

SceneCase scene_case(const scene::Scene& scene, bool tension) {
  SceneCase result{case_of(scene, tension, false), std::nullopt, scene};
  const bool is_associated =
      std::all_of(scene.material.begin(), scene.material.end(), [](const scene::Material& m) {
        return m.dilation_angle.value_or(0.0) == m.friction_angle.value_or(0.0);
      });
  if (is_associated) return result;
  result.davis = case_of(scene, tension, true);
  // Both in the same units, for one report.
  result.davis->units = result.associated.units;
  return result;
}

}  // namespace limit::footing
