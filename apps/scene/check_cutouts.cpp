#include <fmt/format.h>

#include <algorithm>

#include "scene/check.hpp"
#include "scene/cutouts.hpp"
#include "scene/derived.hpp"
#include "scene/names.hpp"

namespace scene {

namespace {

// Whether a cutout's own keys say one shape; reports otherwise.
bool check_shape(const Scene& scene, const Cutout& cutout, const std::string& table,
                 tables::Diagnosis& diagnosis) {
  const auto key = [&](const char* name) { return table + "." + name; };
  if (!diagnosis.good({key("outline"), key("centre"), key("radius")})) return false;
  const bool circle = !cutout.centre.empty() || cutout.radius.has_value();
  if (circle == !cutout.outline.empty()) {
    diagnosis.error(
        table,
        circle ? "an outline and a circle are given" : "neither an outline nor a circle is given",
        "exactly one of outline, and centre with radius");
    return false;
  }
  if (circle && (cutout.centre.empty() || !cutout.radius)) {
    diagnosis.error(cutout.radius ? key("centre") : key("radius"), "is missing",
                    "a circle has a centre and a radius");
    return false;
  }
  if (circle) return check_length(cutout.centre, 2, key("centre"), scene, diagnosis);
  if (const std::string why = shape::objection(ring_of(scene, cutout)); !why.empty()) {
    diagnosis.error(key("outline"), "found no simple polygon", why);
    return false;
  }
  return true;
}

void check_cutout(const Scene& scene, std::size_t index, bool& all_good,
                  tables::Diagnosis& diagnosis) {
  const Cutout& cutout = scene.cutout[index];
  const std::string table = fmt::format("cutout.{}", index);
  all_good = check_shape(scene, cutout, table, diagnosis) && all_good;
  const auto has_its_name = [&](const Support& support) { return support.name == cutout.name; };
  if (std::ranges::any_of(scene.support, has_its_name)) {
    diagnosis.error(table + ".name", fmt::format("found \"{}\" again", cutout.name),
                    "it is the name of a support");
  }
  if (cutout.kind != CutoutKind::free && (cutout.pressure != 0.0 || cutout.shear != 0.0)) {
    diagnosis.error(table + (cutout.pressure != 0.0 ? ".pressure" : ".shear"),
                    fmt::format("found on a surface of kind {}", name_of(cutout.kind)),
                    "tractions act on free surfaces");
  }
}

// What is left of the box.
void check_body(const Scene& scene, tables::Diagnosis& diagnosis) {
  const shape::Body body = body_of(scene);
  constexpr double fewest_cells = 9.0;
  const double cell = scene.geometry.spacing * scene.geometry.spacing;
  if (body.area() < fewest_cells * cell) {
    diagnosis.error("cutout.0", fmt::format("the cutouts leave {:.3g} m2 of the body", body.area()),
                    fmt::format("a particle stands for {:.3g} m2", cell));
  } else if (body.pieces() > 1) {
    diagnosis.error("cutout.0", fmt::format("the cutouts leave {} bodies apart", body.pieces()),
                    "a scene has one");
  }
}

}  // namespace

void check_cutouts(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (scene.cutout.empty() || !diagnosis.good({"geometry.dimension", "geometry.layout"})) return;
  if (scene.geometry.dimension != 2) {
    diagnosis.error(
        "cutout.0", "found in 3D",
        "only plane bodies have cutouts: in space give [[region]]s without it, prisms by "
        "geometry.depth, or a [mesh]");
    return;
  }
  if (scene.geometry.layout != Layout::cell) {
    diagnosis.error("cutout.0", "found with geometry.layout = \"vertex\"",
                    "particles of a body with cutouts are those of cells: layout = \"cell\"");
    return;
  }
  if (scene.initial_stress.kind == InitialStressKind::geostatic) {
    diagnosis.error("initial_stress.kind", "found geostatic in a body with cutouts",
                    "it is the stress of ground without a hole: kind = \"gravity\" settles any; "
                    "what is dug later is a [[region]] that a [[stage]] removes");
  }
  if (scene.limit.check) {
    diagnosis.error("limit.check", "found true for a body with cutouts",
                    "fpm-limit brackets it as a scene of polygons");
  }
  check_names(scene.cutout, "cutout", diagnosis);
  bool all_good = true;
  for (std::size_t i = 0; i < scene.cutout.size(); ++i) {
    check_cutout(scene, i, all_good, diagnosis);
  }
  if (all_good && box_is_good(scene, diagnosis) &&
      diagnosis.good({"geometry.spacing", "geometry.max"})) {
    check_body(scene, diagnosis);
  }
}

}  // namespace scene
