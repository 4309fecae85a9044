// Ground drawn by bytes: polygons on a grid of 16 x 16, some of their points a little beside it,
// and sides of every kind. What is accepted as ground must become meshes that conform and cover it.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string>

#include "limit/ground/ground_case.hpp"
#include "limit/ground/ground_outline.hpp"

namespace {

using limit::ground::GroundScene;
using limit::mesh::Point;

class Pen {
 public:
  explicit Pen(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  [[nodiscard]] bool is_dry() const { return bytes_.empty(); }
  std::uint8_t byte() {
    if (is_dry()) return 0;
    const std::uint8_t first = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return first;
  }
  Point point() {
    const std::uint8_t place = byte(), beside = byte();
    const int x = place / 16, y = place % 16;
    return {x + little(beside / 16), y + little(beside % 16)};
  }

 private:
  // Mostly nothing, else around every tolerance.
  static double little(int nibble) {
    constexpr std::array<double, 16> all{0,    0,    0,    0,    0,     0,    0,    0,
                                         1e-3, 3e-5, 1e-5, 1e-7, -1e-7, 3e-8, 1e-9, 1e-12};
    return all[static_cast<std::size_t>(nibble)];
  }
  std::span<const std::uint8_t> bytes_;
};

// A side for every piece of a polygon that no other polygon has the other way around.
void add_sides(GroundScene& scene, Pen& pen) {
  const auto is_shared = [&](const Point& from, const Point& to) {
    for (const auto& region : scene.regions) {
      const auto& outline = region.outline;
      for (std::size_t i = 0; i < outline.size(); ++i) {
        if (outline[i] == to && outline[(i + 1) % outline.size()] == from) return true;
      }
    }
    return false;
  };
  for (const auto& region : scene.regions) {
    for (std::size_t i = 0; i < region.outline.size(); ++i) {
      const Point &from = region.outline[i], &to = region.outline[(i + 1) % region.outline.size()];
      if (is_shared(from, to)) continue;
      const std::uint8_t kind = pen.byte();
      limit::ground::GroundSide& side = scene.sides.emplace_back();
      side.name = std::to_string(scene.sides.size());
      side.kind = static_cast<limit::ground::SideKind>(kind % 5);
      side.along = {from, to};
      side.base =
          (kind & 16U) != 0 ? limit::ground::BaseKind::rough : limit::ground::BaseKind::smooth;
      side.tension = (kind & 32U) != 0;
      if (side.kind == limit::ground::SideKind::loaded) side.shear = (kind & 64U) != 0 ? 0.1 : 0.0;
    }
  }
}

GroundScene drawn(Pen pen) {
  GroundScene scene;
  scene.load.sought = limit::ground::Sought::gravity;
  limit::ground::GroundMaterial& soil = scene.materials.emplace_back();
  soil.name = "soil";
  soil.soil.cohesion = 1.0;
  soil.soil.friction_angle = soil.dilation_angle = 0.2;
  soil.soil.unit_weight = 1.0;
  const int regions = 1 + pen.byte() % 3;
  for (int r = 0; r < regions; ++r) {
    limit::ground::GroundRegion& region = scene.regions.emplace_back();
    region.name = std::to_string(r);
    const int points = 3 + pen.byte() % 6;
    for (int i = 0; i < points; ++i) region.outline.push_back(pen.point());
  }
  add_sides(scene, pen);
  return scene;
}

// Conforms (or throws), and covers as much as the polygons.
void check(const limit::mesh::Mesh& mesh, double area) {
  (void)limit::mesh::edges_of(mesh);
  double covered = 0.0;
  for (const limit::mesh::Triangle& triangle : mesh.triangles) {
    covered += limit::mesh::twice_area(mesh, triangle) / 2.0;
  }
  constexpr double of_area = 1e-6;  // what may lie between places that count as one
  if (!(std::abs(covered - area) <= of_area * area)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const GroundScene scene = drawn(Pen({data, size}));
  tables::Diagnosis diagnosis("drawn");
  const limit::ground::GroundOutline outline = limit::ground::ground_outline(scene, diagnosis);
  if (!diagnosis.errors().empty()) return 0;
  const auto made = limit::ground::ground_case(scene, diagnosis);
  if (!made) {
    if (diagnosis.errors().empty()) std::abort();  // refused without a reason
    return 0;
  }
  check(made->associated.lower.mesh, outline.area);
  check(made->associated.upper.mesh, outline.area);
  return 0;
}
