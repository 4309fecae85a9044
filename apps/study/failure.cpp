#include "study/failure.hpp"

#include <algorithm>
#include <cmath>

#include "scene/derived.hpp"
#include "scene/scene.hpp"
#include "scene/stages.hpp"
#include "study/quantity.hpp"

namespace study {

namespace {

constexpr std::string_view of_load = "load_parameter", of_strength = "strength_reduction";

}  // namespace

bool is_of_a_failure(const Quantity& quantity) {
  return quantity.kind != Quantity::Kind::at &&
         (quantity.column == of_load || quantity.column == of_strength);
}

double failure_resolution(const scene::Scene& scene, const Quantity& quantity) {
  double largest = 0.0;
  for (std::size_t s = 0; s < scene::stage_count(scene); ++s) {
    const scene::Scene now = scene::scene_of_stage(scene, s);
    double way = 1.0;
    if (quantity.column == of_strength) {
      way = scene.stage.empty() ? scene.drive.target - 1.0
                                : now.course.reduction_end - now.course.reduction_begin;
    } else if (!scene.stage.empty()) {
      way = now.course.load_end - now.course.load_begin;
    }
    // Steps are halved as long as they are no smaller than allowed.
    const double halvings = std::floor(-std::log2(now.programme.minimum_increment_ratio));
    const double increment = std::exp2(-halvings) * std::abs(way);
    largest = std::max(largest, increment / static_cast<double>(scene::nominal_steps(now)));
  }
  return largest;
}

}  // namespace study
