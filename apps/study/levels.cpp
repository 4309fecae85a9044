#include "study/levels.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <sstream>

#include "program/command_line.hpp"
#include "scene/derived.hpp"
#include "scene/element_body.hpp"
#include "scene/grading.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"
#include "scene/stages.hpp"

namespace study {

namespace {

/// With fewer cells across the least of them, values are not on their way to the limit yet.
constexpr double fewest = 6.0;

/// The numbers of cells that must stay whole: of the extents, and of the places that are whole now.
class WholeNumbers {
 public:
  explicit WholeNumbers(const scene::Geometry& geometry) : geometry_(geometry) {
    for (std::size_t axis = 0; axis < geometry.max.size(); ++axis) {
      add(geometry.max[axis] - geometry.min[axis]);
    }
  }

  /// A place along an axis; one at an end of the body says nothing.
  /// @param resolved  whether there must be some cells up to it
  void place(double at, std::size_t axis, bool resolved = true) {
    if (axis < geometry_.min.size()) add(at - geometry_.min[axis], resolved);
  }
  void places(const scene::Point& point) {
    for (std::size_t axis = 0; axis < point.size(); ++axis) place(point[axis], axis);
  }
  /// A range on a side: of the axes that are left.
  void range(const scene::Point& point, scene::Side side, bool resolved = true) {
    std::size_t k = 0;
    for (std::size_t axis = 0; axis < geometry_.min.size() && k < point.size(); ++axis) {
      if (static_cast<int>(axis) != scene::axis_of(side)) place(point[k++], axis, resolved);
    }
  }

  /// A length that cells resolve without being whole in it.
  void length(double value) {
    least_ = std::min(least_, static_cast<std::int64_t>(std::floor(value / geometry_.spacing)));
  }

  [[nodiscard]] std::int64_t divisor() const { return divisor_; }
  [[nodiscard]] std::int64_t least() const { return std::max<std::int64_t>(least_, 1); }

 private:
  void add(double length, bool resolved = true) {
    const double cells = length / geometry_.spacing;
    const auto whole = static_cast<std::int64_t>(std::llround(cells));
    constexpr double exact = 1e-6;
    if (whole <= 0 || std::abs(cells - static_cast<double>(whole)) > exact) return;
    divisor_ = std::gcd(divisor_, whole);
    if (resolved) least_ = least_ == 0 ? whole : std::min(least_, whole);
  }

  const scene::Geometry& geometry_;
  std::int64_t divisor_ = 0;
  std::int64_t least_ = 0;
};

/// Whether another traction of the side begins or ends there as well: pieces of one load that
/// changes along its side need no cells of their own.
bool goes_on(const scene::Scene& scene, const scene::Traction& traction, const scene::Point& end) {
  if (end.size() != 1) return false;
  const double slack = scene::same_place(scene.geometry);
  return std::ranges::any_of(scene.traction, [&](const scene::Traction& other) {
    if (&other == &traction || other.side != traction.side || other.range_min.size() != 1) {
      return false;
    }
    return std::abs(other.range_min[0] - end[0]) <= slack ||
           std::abs(other.range_max[0] - end[0]) <= slack;
  });
}

WholeNumbers whole_numbers_of(const scene::Scene& scene) {
  WholeNumbers numbers(scene.geometry);
  for (const scene::Drive* drive : scene::all_drives(scene)) {
    numbers.range(drive->range_min, drive->side);
    numbers.range(drive->range_max, drive->side);
  }
  for (const scene::Traction& traction : scene.traction) {
    numbers.range(traction.range_min, traction.side, !goes_on(scene, traction, traction.range_min));
    numbers.range(traction.range_max, traction.side, !goes_on(scene, traction, traction.range_max));
  }
  for (const scene::Material& material : scene.material) {
    numbers.places(material.region_min);
    numbers.places(material.region_max);
  }
  for (const scene::Cutout& cutout : scene.cutout) {
    if (cutout.radius) numbers.length(*cutout.radius);
  }
  return numbers;
}

double length_of(const std::vector<scene::PlanePoint>& line) {
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    length += std::hypot(line[i].x() - line[i - 1].x(), line[i].y() - line[i - 1].y());
  }
  return length;
}

/// Twice the area over the length around it: the radius of a circle, half the side of a square, the
/// width of what is long.
double width_of(const std::vector<scene::PlanePoint>& ring) {
  double area = 0.0;
  std::vector<scene::PlanePoint> closed = ring;
  closed.push_back(ring.front());
  for (std::size_t i = 0; i + 1 < closed.size(); ++i) {
    area += (closed[i].x() * closed[i + 1].y() - closed[i + 1].x() * closed[i].y()) / 2.0;
  }
  return 2.0 * std::abs(area) / length_of(closed);
}

/// The least width [m] of what a body of regions is made of, their holes, and what is pressed on.
double least_width(const scene::Scene& scene) {
  double least = std::numeric_limits<double>::infinity();
  for (const scene::Region& region : scene.region) {
    least = std::min(least, width_of(region.outline));
    for (const auto& hole : region.holes) least = std::min(least, width_of(hole));
  }
  for (const scene::OutlineSide& side : scene.side) {
    const bool pressed =
        side.kind == scene::OutlineKind::footing || side.kind == scene::OutlineKind::loaded;
    if (pressed) least = std::min(least, length_of(side.along));
  }
  return least;
}

std::string list_of(const scene::Point& point) {
  return fmt::format("[{}]", fmt::join(point, ", "));
}

/// @param finest  times finer than the scene's own
std::vector<double> spacings_down_to(const scene::Scene& scene, std::int64_t finest) {
  if (scene::has_elements(scene)) {
    throw program::UsageError(
        "the scene's particles are the elements of its mesh: no spacing makes them finer, a finer "
        "mesh does");
  }
  const WholeNumbers numbers = whole_numbers_of(scene);
  const std::int64_t divisor = numbers.divisor();
  constexpr double ratio = 1.5;
  std::vector<double> spacings;
  auto k = static_cast<std::int64_t>(
      std::ceil(fewest * static_cast<double>(divisor) / static_cast<double>(numbers.least())));
  for (; k <= finest * divisor;
       k = static_cast<std::int64_t>(std::ceil(ratio * static_cast<double>(k)))) {
    spacings.push_back(scene.geometry.spacing * static_cast<double>(divisor) /
                       static_cast<double>(k));
  }
  return spacings;
}

}  // namespace

std::vector<double> spacings_on_offer(const scene::Scene& scene) {
  constexpr std::int64_t finest = 8;
  return spacings_down_to(scene, finest);
}

std::vector<double> spacings_of_a_ladder(const scene::Scene& scene, bool budget) {
  constexpr double round_off = 1e-9;
  constexpr std::int64_t finest = 8, with_a_budget = 64;
  const double coarsest = least_width(scene) / fewest * (1.0 + round_off);
  std::vector<double> spacings = spacings_down_to(scene, budget ? with_a_budget : finest);
  std::erase_if(spacings, [&](double spacing) { return spacing > coarsest; });
  return spacings;
}

std::vector<std::string> settings_of_spacing(const scene::Scene& scene, double spacing) {
  std::vector<std::string> settings{fmt::format("geometry.spacing={}", spacing)};
  if (!scene.grading.enabled) return settings;
  const double times = spacing / scene.geometry.spacing;
  settings.push_back(
      fmt::format("grading.growth={}", std::min(1.0, times * scene::resolve_growth(scene))));
  settings.push_back(fmt::format("grading.coarsest={}", times * scene::resolve_coarsest(scene)));
  for (std::size_t i = 0; i < scene.refine.size(); ++i) {
    if (!scene.refine[i].spacing) continue;
    settings.push_back(fmt::format("refine.{}.spacing={}", i, times * *scene.refine[i].spacing));
  }
  return settings;
}

std::vector<std::string> settings_of_steps(const scene::Scene& scene, double times) {
  const auto more = [&](std::int64_t steps) {
    return std::llround(static_cast<double>(steps) * times);
  };
  std::vector<std::string> settings;
  if (scene.stage.empty()) {
    settings.push_back(fmt::format("programme.steps={}", more(scene::nominal_steps(scene))));
  }
  for (std::size_t s = 0; s < scene.stage.size(); ++s) {
    settings.push_back(fmt::format("stage.{}.steps={}", s,
                                   more(scene::nominal_steps(scene::scene_of_stage(scene, s)))));
  }
  return settings;
}

std::vector<scene::Side> parse_far(const std::string& text, const scene::Scene& scene) {
  std::vector<scene::Side> far;
  std::istringstream words(text);
  const auto refuse = [](const std::string& word, const std::string& why) {
    throw program::UsageError(fmt::format("--far: found {}; {}", word, why));
  };
  if (!scene.region.empty()) refuse(text, "the body is one of regions, which say where it ends");
  for (std::string word; std::getline(words, word, ',');) {
    const auto names = scene::names_of(scene::Side{});
    const auto at = std::ranges::find(names, word);
    if (at == names.end()) refuse(word, fmt::format("allowed are {}", fmt::join(names, ", ")));
    const auto side = static_cast<scene::Side>(at - names.begin());
    const auto axis = static_cast<std::size_t>(scene::axis_of(side));
    if (axis >= scene.geometry.min.size()) refuse(word, "the body has no such side");
    for (const scene::Drive* drive : scene::all_drives(scene)) {
      if (drive->kind == scene::DriveKind::displacement && drive->side == side) {
        refuse(word, "it is the side that is moved");
      }
    }
    if (scene::is_mirror(scene, side)) refuse(word, "it is a mirror");
    far.push_back(side);
  }
  if (far.empty()) refuse("none", "it needs a side");
  return far;
}

std::vector<std::string> widened(const scene::Scene& scene, const std::vector<scene::Side>& far,
                                 double times) {
  if (times == 1.0 || far.empty()) return {};
  const scene::Geometry& now = scene.geometry;
  // So many cells of every spacing on offer.
  const double unit = now.spacing * static_cast<double>(whole_numbers_of(scene).divisor());
  scene::Point min = now.min, max = now.max;
  for (const scene::Side side : far) {
    const auto axis = static_cast<std::size_t>(scene::axis_of(side));
    constexpr double round_off = 1e-9;
    const double more =
        unit * std::ceil((times - 1.0) * (now.max[axis] - now.min[axis]) / unit - round_off);
    if (scene::is_upper(side)) {
      max[axis] += more;
    } else {
      min[axis] -= more;
    }
  }
  std::vector<std::string> settings{"geometry.min=" + list_of(min), "geometry.max=" + list_of(max)};
  const double slack = scene::same_place(now);
  for (std::size_t m = 0; m < scene.material.size(); ++m) {
    scene::Point lower = scene.material[m].region_min, upper = scene.material[m].region_max;
    for (std::size_t axis = 0; axis < lower.size() && axis < upper.size(); ++axis) {
      if (lower[axis] <= now.min[axis] + slack) lower[axis] = std::min(lower[axis], min[axis]);
      if (upper[axis] >= now.max[axis] - slack) upper[axis] = std::max(upper[axis], max[axis]);
    }
    if (lower == scene.material[m].region_min && upper == scene.material[m].region_max) continue;
    settings.push_back(fmt::format("material.{}.region_min={}", m, list_of(lower)));
    settings.push_back(fmt::format("material.{}.region_max={}", m, list_of(upper)));
  }
  return settings;
}

}  // namespace study
