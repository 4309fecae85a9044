// Weight aslant, of an earthquake: from the first, or of a stage.
#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string>

#include "scene/check.hpp"
#include "scene/drives.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"

namespace scene {
namespace {

// What is behind a mirror weighs the other way across it.
void check_mirror(const Scene& scene, Axis axis, const std::string& key, const std::string& found,
                  tables::Diagnosis& diagnosis) {
  for (const Symmetry& mirror : scene.symmetry) {
    if (mirror.axis != axis || !diagnosis.good({key, "symmetry"})) continue;
    diagnosis.error(key,
                    fmt::format("found {}, across the mirror at {} = {:g}", found, name_of(axis),
                                mirror.position),
                    "behind it the weight is aslant the other way: take the whole body, or a "
                    "roller");
    return;
  }
}

void check_from_the_first(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Load& load = scene.load;
  const Point& weight = scene.gravity.acceleration;
  const std::string key = "load.kh";
  if (load.sought == Sought::earthquake) {
    check_mirror(scene, Axis::x, "load.sought", "earthquake", diagnosis);
    return;
  }
  if (!diagnosis.good({key, "load.kv"})) return;
  if (load.kh == 0.0) {
    for (const Axis axis : {Axis::x, Axis::z}) {
      const auto i = static_cast<std::size_t>(axis);
      if (i >= weight.size() || weight[i] == 0.0) continue;
      check_mirror(scene, axis, "gravity.acceleration",
                   fmt::format("{:g} along {}", weight[i], name_of(axis)), diagnosis);
    }
    return;
  }
  constexpr double written = 1e-5;  // with six digits
  if (!has_gravity(scene)) {
    diagnosis.warning(key, fmt::format("found {:g} in ground without weight", load.kh),
                      "it has no effect: an earthquake is weight aslant");
  } else if (std::abs(weight[0] * (1.0 - load.kv) + weight[1] * load.kh) >
             written * std::hypot(weight[0], weight[1])) {
    diagnosis.error(
        key,
        fmt::format("found {:g}, and a gravity.acceleration of {:g} along x", load.kh, weight[0]),
        "give one of them: without [gravity], kh and kv say how the earth's is aslant");
  } else {
    check_mirror(scene, Axis::x, key, fmt::format("{:g}", load.kh), diagnosis);
  }
}

void check_stage(const Scene& scene, std::size_t s, tables::Diagnosis& diagnosis) {
  const Stage& stage = scene.stage[s];
  const std::string kh = fmt::format("stage.{}.kh", s), kv = fmt::format("stage.{}.kv", s);
  if (!diagnosis.good({kh, kv}) || (!stage.kh && !stage.kv)) return;
  const std::string& key = stage.kh ? kh : kv;
  if (!has_gravity(scene)) {
    diagnosis.error(key, "found in ground without weight",
                    "an earthquake is weight aslant: give materials a unit_weight");
  } else if (scene.load.sought == Sought::earthquake) {
    diagnosis.error(key, "found with load.sought = \"earthquake\"",
                    "fpm-limit seeks that of one ground, without stages: leave load.sought out");
  } else if (scene.gravity.acceleration[1] >= 0.0) {
    diagnosis.error(key, "found with a gravity that does not act downwards",
                    "kh and kv are shares of the weight downwards");
  } else if (stage.kh.value_or(0.0) != 0.0) {
    check_mirror(scene, Axis::x, key, fmt::format("{:g}", *stage.kh), diagnosis);
  }
}

}  // namespace

void check_quake(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (!diagnosis.good({"gravity.acceleration", "geometry.dimension", "material"})) return;
  const std::size_t size = scene.gravity.acceleration.size();
  if (size != 0 && size != static_cast<std::size_t>(scene.geometry.dimension)) return;
  check_from_the_first(scene, diagnosis);
  for (std::size_t s = 0; s < scene.stage.size(); ++s) check_stage(scene, s, diagnosis);
}

}  // namespace scene
