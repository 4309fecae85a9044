#include "shape/outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace shape {

namespace {

std::string text_of(const Point& at) {
  return fmt::format("({:.6g}, {:.6g})", at.x(), at.y());
}

class Arranger {
 public:
  Arranger(std::span<const NamedRegion> regions, std::span<const NamedLine> sides,
           tables::Diagnosis& diagnosis)
      : regions_(regions), sides_(sides), diagnosis_(diagnosis) {}

  Outline outline() {
    measure();
    if (is_good()) collect_points();
    if (is_good() && points_are_apart()) {
      for (auto& loops : result_.regions) {
        for (Loop& loop : loops) divide(loop);
      }
      for (std::size_t r = 0; r < regions_.size(); ++r) check_itself(r);
    }
    if (is_good()) check_overlaps();
    if (is_good()) join();
    if (is_good()) check_connection();
    if (is_good()) name_sides();
    for (std::size_t r = 0; r < result_.regions.size(); ++r) {
      for (const Ring& ring : result_.rings(r)) result_.area += signed_area(ring);
    }
    return std::move(result_);
  }

 private:
  using Loop = Outline::Loop;

  [[nodiscard]] bool is_good() const { return diagnosis_.errors().empty(); }
  [[nodiscard]] static std::string key(std::size_t region, bool of_hole = false) {
    return fmt::format("region.{}.{}", region, of_hole ? "holes" : "outline");
  }
  [[nodiscard]] std::string name(std::size_t region) const { return regions_[region].name; }
  [[nodiscard]] const Point& at(int point) const { return result_.at(point); }

  void measure() {
    Point low = regions_.front().ring.front(), high = low;
    for (const NamedRegion& region : regions_) {
      for (const Point& point : region.ring) {
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
      }
    }
    // Squares of lengths must neither overflow nor vanish.
    constexpr double least = 1e-100, most = 1e100;
    const double extent = (high - low).maxCoeff();
    if (!(extent >= least && extent <= most)) {
      diagnosis_.error(key(0), fmt::format("the ground is {:.3g} m across", extent),
                       fmt::format("allowed are {:g} .. {:g} m", least, most));
      return;
    }
    // Coordinates must tell places apart that are well within the tolerance.
    constexpr double farthest = 1e6;
    const double away = std::max(high.cwiseAbs().maxCoeff(), low.cwiseAbs().maxCoeff());
    if (away > farthest * extent) {
      diagnosis_.error(
          key(0),
          fmt::format("the ground is {:.3g} m across, {:.3g} m away from the origin", extent, away),
          fmt::format("allowed is {:g} times its size", farthest));
    }
    result_.size = (high - low).norm();
  }

  int id_of(const Point& place) {
    for (std::size_t i = 0; i < result_.points.size(); ++i) {
      if ((result_.points[i] - place).norm() <= result_.tolerance()) return static_cast<int>(i);
    }
    result_.points.push_back(place);
    return static_cast<int>(result_.points.size()) - 1;
  }

  void collect_points() {
    for (std::size_t r = 0; r < regions_.size(); ++r) {
      std::vector<Loop>& loops = result_.regions.emplace_back();
      loops.push_back(loop_of(regions_[r].ring, key(r), 1.0));
      for (const Ring& hole : regions_[r].holes) {
        loops.push_back(loop_of(hole, key(r, true), -1.0));
      }
    }
    for (std::size_t s = 0; s < sides_.size(); ++s) {
      int before = -1;
      for (const Point& point : sides_[s].along) {
        const int here = id_of(point);
        if (here == before) {
          diagnosis_.error(fmt::format("side.{}.along", s),
                           fmt::format("found {} twice in a row", text_of(point)),
                           "a side passes no place twice");
        }
        before = here;
      }
    }
  }

  // A ring as a loop of points that goes around as `sign` says.
  Loop loop_of(Ring ring, const std::string& key, double sign) {
    // A polygon that is closed by its first point is the same polygon.
    if (ring.size() > 1 && (ring.front() - ring.back()).norm() <= result_.tolerance()) {
      ring.pop_back();
    }
    if (sign * signed_area(ring) < 0.0) std::reverse(ring.begin(), ring.end());
    Loop loop;
    for (const Point& point : ring) loop.push_back(id_of(point));
    if (loop.size() < 3) {
      diagnosis_.error(key, fmt::format("found {} points", loop.size()), "a polygon has 3 or more");
    }
    for (std::size_t k = 0; k < loop.size(); ++k) {
      if (loop[k] != loop[(k + 1) % loop.size()]) continue;
      diagnosis_.error(key, fmt::format("found {} twice in a row", text_of(at(loop[k]))),
                       "an outline passes no place twice");
    }
    return loop;
  }

  /// A straight piece of a region's loops.
  struct Piece {
    int from = 0, to = 0;
    std::size_t loop = 0;
  };

  [[nodiscard]] std::vector<Piece> pieces(std::size_t r) const {
    std::vector<Piece> all;
    const std::vector<Loop>& loops = result_.regions[r];
    for (std::size_t l = 0; l < loops.size(); ++l) {
      for (std::size_t k = 0; k < loops[l].size(); ++k) {
        all.push_back({loops[l][k], loops[l][(k + 1) % loops[l].size()], l});
      }
    }
    return all;
  }

  // The key of what has this point.
  [[nodiscard]] std::string key_of_point(int point) const {
    for (std::size_t r = 0; r < result_.regions.size(); ++r) {
      for (const Piece& piece : pieces(r)) {
        if (piece.from == point) return key(r, piece.loop > 0);
      }
    }
    for (std::size_t s = 0; s < sides_.size(); ++s) {
      for (const Point& place : sides_[s].along) {
        if ((place - at(point)).norm() <= result_.tolerance()) {
          return fmt::format("side.{}.along", s);
        }
      }
    }
    return "region";
  }

  // Nothing is thinner than a millionth of the ground's size, but what is meant to coincide.
  bool points_are_apart() {
    const double thin = 1e-6 * result_.size;
    for (int i = 0; i < static_cast<int>(result_.points.size()); ++i) {
      for (int j = 0; j < i; ++j) {
        const double apart = (at(i) - at(j)).norm();
        if (apart > thin) continue;
        diagnosis_.error(key_of_point(i),
                         fmt::format("{} and {} almost coincide", text_of(at(j)), text_of(at(i))),
                         fmt::format("apart are at least {:.3g} m, or nothing", thin));
        return false;
      }
      for (std::size_t r = 0; r < result_.regions.size(); ++r) {
        for (const auto& [a, b, loop] : pieces(r)) {
          if (i == a || i == b) continue;
          const double apart = distance(at(i), at(a), at(b));
          if (apart > thin || apart <= result_.tolerance()) continue;
          diagnosis_.error(key(r, loop > 0),
                           fmt::format("{} almost lies on {} - {}: a layer without thickness",
                                       text_of(at(i)), text_of(at(a)), text_of(at(b))),
                           fmt::format("apart are at least {:.3g} m, or nothing", thin));
          return false;
        }
      }
    }
    return true;
  }

  // Takes every point that lies on a loop into it.
  void divide(Loop& loop) const {
    Loop divided;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int a = loop[k], b = loop[(k + 1) % loop.size()];
      std::vector<std::pair<double, int>> between;
      for (int i = 0; i < static_cast<int>(result_.points.size()); ++i) {
        if (i == a || i == b || distance(at(i), at(a), at(b)) > result_.tolerance()) continue;
        between.emplace_back((at(i) - at(a)).norm(), i);
      }
      std::sort(between.begin(), between.end());
      divided.push_back(a);
      for (const auto& [along, point] : between) divided.push_back(point);
    }
    loop = divided;
  }

  void check_itself(std::size_t r) {
    const std::vector<Piece> all = pieces(r);
    for (std::size_t i = 0; i < all.size(); ++i) {
      for (std::size_t j = i + 1; j < all.size(); ++j) {
        const Piece &one = all[i], &other = all[j];
        const std::string where = key(r, other.loop > 0);
        if (one.from == other.from) {
          diagnosis_.error(where,
                           fmt::format("the polygon touches itself at {}", text_of(at(one.from))),
                           "an outline passes no place twice");
          return;
        }
        const auto place = crossing(at(one.from), at(one.to), at(other.from), at(other.to));
        if (!place) continue;
        diagnosis_.error(where, fmt::format("the polygon crosses itself at {}", text_of(*place)),
                         "an outline passes no place twice");
        return;
      }
    }
    check_holes(r);
  }

  // Loops that do not meet are within one another or apart.
  void check_holes(std::size_t r) {
    const std::vector<Ring> rings = result_.rings(r);
    for (std::size_t hole = 1; hole < rings.size(); ++hole) {
      for (std::size_t other = 0; other < rings.size(); ++other) {
        const bool wanted = other == 0;
        const Point& at = rings[hole].front();
        if (other == hole || is_inside(rings[other], at) == wanted) continue;
        diagnosis_.error(key(r, true),
                         wanted ? fmt::format("the hole at {} is outside the outline", text_of(at))
                                : fmt::format("the hole at {} is in another one", text_of(at)),
                         "holes are within the outline, side by side");
        return;
      }
    }
  }

  void check_overlaps() {
    for (std::size_t r = 0; r < regions_.size(); ++r) {
      for (std::size_t other = 0; other < regions_.size(); ++other) {
        if (other == r) continue;
        const auto place = overlap(r, other);
        if (!place) continue;
        diagnosis_.error(key(std::max(r, other)),
                         fmt::format("\"{}\" and \"{}\" overlap at {}", name(std::min(r, other)),
                                     name(std::max(r, other)), text_of(*place)),
                         "regions share sides at most");
        return;
      }
    }
  }

  // A place of region r's outline that shows that it overlaps another one.
  [[nodiscard]] std::optional<Point> overlap(std::size_t r, std::size_t other) const {
    const std::vector<Piece> theirs = pieces(other);
    const std::vector<Ring> rings = result_.rings(other);
    for (const Piece& mine : pieces(r)) {
      const Point &a = at(mine.from), &b = at(mine.to);
      const Point middle = (a + b) / 2.0;
      bool lies_on_it = false;
      for (const Piece& piece : theirs) {
        if (const auto place = crossing(a, b, at(piece.from), at(piece.to))) return place;
        if (mine.from == piece.from && mine.to == piece.to) return middle;
        lies_on_it = lies_on_it || (mine.from == piece.to && mine.to == piece.from);
      }
      if (!lies_on_it && is_inside(rings, middle)) return middle;
    }
    return std::nullopt;
  }

  void join() {
    std::map<std::pair<int, int>, std::size_t> known;
    for (std::size_t r = 0; r < result_.regions.size(); ++r) {
      for (const auto& [a, b, loop] : pieces(r)) {
        const auto [at, is_new] = known.emplace(std::minmax(a, b), result_.segments.size());
        if (is_new) {
          result_.segments.push_back({a, b, static_cast<int>(r)});
        } else {
          result_.segments[at->second].right = static_cast<int>(r);
        }
      }
    }
  }

  void check_connection() {
    std::vector<std::size_t> part(regions_.size());
    std::iota(part.begin(), part.end(), std::size_t{0});
    for (const OutlineSegment& segment : result_.segments) {
      if (segment.right < 0) continue;
      const std::size_t from = part[static_cast<std::size_t>(segment.left)];
      const std::size_t to = part[static_cast<std::size_t>(segment.right)];
      std::replace(part.begin(), part.end(), from, to);
    }
    for (std::size_t r = 1; r < part.size(); ++r) {
      if (part[r] == part[0]) continue;
      diagnosis_.error(
          key(r),
          fmt::format("\"{}\" shares no side with \"{}\" or what adjoins it", name(r), name(0)),
          "the ground is one piece");
      return;
    }
    std::map<int, int> leaving;
    for (const OutlineSegment& segment : result_.segments) {
      if (segment.right >= 0 || ++leaving[segment.first] < 2) continue;
      diagnosis_.error(
          key(static_cast<std::size_t>(segment.left)),
          fmt::format("the ground's outline touches itself at {}", text_of(at(segment.first))),
          "regions share whole sides, and an outline passes no place twice");
      return;
    }
  }

  void name_sides() {
    for (std::size_t s = 0; s < sides_.size(); ++s) {
      const auto& along = sides_[s].along;
      for (std::size_t i = 0; i + 1 < along.size(); ++i) name_piece(s, along[i], along[i + 1]);
    }
    if (!is_good()) return;
    for (const OutlineSegment& segment : result_.segments) {
      if (segment.right >= 0 || segment.side >= 0) continue;
      diagnosis_.error(key(static_cast<std::size_t>(segment.left)),
                       fmt::format("no [[side]] names the {} {} - {}",
                                   is_hole(segment.first) ? "outline of a hole," : "outline",
                                   text_of(at(segment.first)), text_of(at(segment.second))),
                       "every part of the outline belongs to a side");
      return;
    }
  }

  void name_piece(std::size_t s, const Point& from, const Point& to) {
    const std::string here = fmt::format("side.{}.along", s);
    double covered = 0.0;
    const double near = 2.0 * result_.tolerance();
    for (OutlineSegment& segment : result_.segments) {
      const Point &a = at(segment.first), &b = at(segment.second);
      if (segment.right >= 0 || distance(a, from, to) > near || distance(b, from, to) > near) {
        continue;
      }
      covered += (b - a).norm();
      if (segment.side >= 0) {
        const NamedLine& other = sides_[static_cast<std::size_t>(segment.side)];
        diagnosis_.error(
            here,
            fmt::format("{} - {} is named by side \"{}\", too", text_of(a), text_of(b), other.name),
            "a part of the outline belongs to one side");
        return;
      }
      segment.side = static_cast<int>(s);
    }
    if (std::abs(covered - (to - from).norm()) > 1e-6 * result_.size) {
      diagnosis_.error(
          here, fmt::format("{} - {} lies off the ground's outline", text_of(from), text_of(to)),
          "a side follows the outline of the regions together");
    }
  }

  // Whether the outline's loop through a point runs clockwise.
  [[nodiscard]] bool is_hole(int point) const {
    std::vector<Point> loop;
    for (int here = point; loop.empty() || here != point;) {
      loop.push_back(at(here));
      for (const OutlineSegment& segment : result_.segments) {
        if (segment.right >= 0 || segment.first != here) continue;
        here = segment.second;
        break;
      }
    }
    return signed_area(loop) < 0.0;
  }

  std::span<const NamedRegion> regions_;
  std::span<const NamedLine> sides_;
  tables::Diagnosis& diagnosis_;
  Outline result_;
};

}  // namespace

std::vector<Ring> Outline::rings(std::size_t region) const {
  std::vector<Ring> rings;
  for (const Loop& loop : regions[region]) {
    Ring& ring = rings.emplace_back();
    for (const int point : loop) ring.push_back(at(point));
  }
  return rings;
}

Outline join_regions(std::span<const NamedRegion> regions, std::span<const NamedLine> sides,
                     tables::Diagnosis& diagnosis) {
  return Arranger(regions, sides, diagnosis).outline();
}

}  // namespace shape
