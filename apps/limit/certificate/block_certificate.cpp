#include "limit/certificate/block_certificate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace limit::certificate {

namespace {

constexpr double pi = std::numbers::pi;

// Gauss-Legendre on steps so short that ten points are exact to rounding.
template <class Function>
double integral(double from, double to, double steepness, const Function& function) {
  constexpr std::array<double, 5> place{0.1488743389816312, 0.4333953941292472, 0.6794095682990244,
                                        0.8650633666889845, 0.9739065285171717};
  constexpr std::array<double, 5> weight{0.2955242247147529, 0.2692667193099963, 0.2190863625159820,
                                         0.1494513491505806, 0.0666713443086881};
  constexpr double longest = 0.2;
  const int steps = 1 + static_cast<int>((to - from) * (1.0 + steepness) / longest);
  const double half = (to - from) / (2.0 * steps);
  double sum = 0.0;
  for (int k = 0; k < steps; ++k) {
    const double middle = from + (2.0 * k + 1.0) * half;
    for (std::size_t i = 0; i < place.size(); ++i) {
      sum += half * weight[i] *
             (function(middle - half * place[i]) + function(middle + half * place[i]));
    }
  }
  return sum;
}

// A straight piece seen from the pole, the body to its left, with the soils on both sides.
struct Piece {
  mesh::Point first{0.0, 0.0}, second{0.0, 0.0};
  const problem::Soil* left = nullptr;
  const problem::Soil* right = nullptr;     // none on the outline
  const problem::Boundary* side = nullptr;  // on the outline
};

class Examination {
 public:
  Examination(const problem::Problem& problem, const problem::TurningBlock& block)
      : problem_(problem), block_(block) {
    const mesh::Mesh& mesh = problem.mesh;
    const auto seen = [&](int node) {
      const mesh::Point& place = mesh.nodes[static_cast<std::size_t>(node)];
      return mesh::Point((block.clockwise ? -place.x() : place.x()) - block.pole.x(),
                         place.y() - block.pole.y());
    };
    const auto soil = [&](int triangle) {
      const int region = mesh.triangles[static_cast<std::size_t>(triangle)].region;
      return &problem.soils[static_cast<std::size_t>(region)];
    };
    for (const mesh::Edge& edge : mesh::edges_of(mesh)) {
      Piece piece{seen(edge.first), seen(edge.second), soil(edge.left)};
      if (block.clockwise) std::swap(piece.first, piece.second);
      if (edge.right >= 0) {
        piece.right = soil(edge.right);
        if (piece.right == piece.left) continue;
      } else {
        piece.side = &problem.boundaries[static_cast<std::size_t>(edge.boundary)];
      }
      pieces_.push_back(piece);
    }
    for (const mesh::Triangle& triangle : mesh.triangles) {
      std::array<mesh::Point, 3> corners{seen(triangle.nodes[0]), seen(triangle.nodes[1]),
                                         seen(triangle.nodes[2])};
      if (block.clockwise) std::swap(corners[1], corners[2]);
      triangles_.push_back(corners);
    }
  }

  BlockCertificate certificate() {
    BlockCertificate result;
    if (problem_.has_water()) objection_ = "ground without pore water only";
    for (const problem::Soil& soil : problem_.soils) {
      if (soil.has_uneven_weight()) objection_ = "soil of one weight only";
    }
    if (objection_.empty()) check_curve();
    if (objection_.empty()) check_sight();
    if (objection_.empty()) check_held();
    if (objection_.empty()) dissipate();
    result.objection = objection_;
    if (!objection_.empty()) return result;
    for (const Piece& piece : pieces_) work(piece);
    if (!(live_ > 0.0)) {
      result.objection = "the live loads hold it back";
      return result;
    }
    result.multiplier = (dissipation_ - dead_) / live_;
    result.dissipation = dissipation_ / live_;
    return result;
  }

 private:
  void check_curve() {
    constexpr double rounding = 1e-9;
    const auto& arcs = block_.arcs;
    if (arcs.empty()) objection_ = "no curve";
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      if (!(arcs[i].upper > arcs[i].lower) || !(arcs[i].radius > 0.0) || arcs[i].growth < 0.0) {
        objection_ = "an arc that is none";
        return;
      }
      if (i + 1 < arcs.size() &&
          (arcs[i + 1].upper != arcs[i].lower ||
           std::abs(arcs[i + 1].radius / at(arcs[i], arcs[i].lower) - 1.0) > rounding)) {
        objection_ = "arcs that do not meet";
        return;
      }
    }
    if (!arcs.empty() && upper() - lower() >= 2.0 * pi) objection_ = "more than a turn";
  }

  [[nodiscard]] double upper() const { return block_.arcs.front().upper; }
  [[nodiscard]] double lower() const { return block_.arcs.back().lower; }
  static double at(const problem::SpiralArc& arc, double angle) {
    return arc.radius * std::exp(arc.growth * (angle - arc.upper));
  }
  [[nodiscard]] const problem::SpiralArc& arc_at(double angle) const {
    for (const problem::SpiralArc& arc : block_.arcs) {
      if (angle >= arc.lower) return arc;
    }
    return block_.arcs.back();
  }
  [[nodiscard]] double radius_at(double angle) const { return at(arc_at(angle), angle); }
  static mesh::Point towards(double angle) { return {std::cos(angle), std::sin(angle)}; }
  static double cross(const mesh::Point& a, const mesh::Point& b) {
    return a.x() * b.y() - a.y() * b.x();
  }
  // Of a place, within the curve's angles if it can be.
  [[nodiscard]] double angle_of(const mesh::Point& place) const {
    double angle = std::atan2(place.y(), place.x());
    angle += 2.0 * pi * std::ceil((lower() - angle) / (2.0 * pi));
    return angle;
  }

  // Where the curve crosses the line of a piece. Along an arc, radius times the cosine from the
  // line's normal is monotone between angles where its derivative vanishes.
  [[nodiscard]] std::vector<double> crossings(const Piece& piece) const {
    const mesh::Point along = (piece.second - piece.first).normalized();
    const mesh::Point normal(-along.y(), along.x());
    const double offset = normal.dot(piece.first), from = std::atan2(normal.y(), normal.x());
    std::vector<double> found;
    for (const problem::SpiralArc& arc : block_.arcs) {
      const auto distance = [&](double angle) {
        return at(arc, angle) * std::cos(angle - from) - offset;
      };
      std::vector<double> ends{arc.lower};
      const double still = from + std::atan(arc.growth);
      for (double turn = still + pi * std::ceil((arc.lower - still) / pi); turn < arc.upper;
           turn += pi) {
        if (turn > arc.lower) ends.push_back(turn);
      }
      ends.push_back(arc.upper);
      for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        double low = ends[i], high = ends[i + 1];
        const bool rises = distance(low) < 0.0;
        if (rises == (distance(high) < 0.0)) continue;
        for (int k = 0; k < 200; ++k) {
          const double middle = (low + high) / 2.0;
          if (middle == low || middle == high) break;
          ((distance(middle) < 0.0) == rises ? low : high) = middle;
        }
        found.push_back((low + high) / 2.0);
      }
    }
    return found;
  }

  // No ground between the pole and the ends of the curve.
  void check_sight() {
    constexpr double touches = 1e-9;
    if (soil_at(mesh::Point(0.0, 0.0)) != nullptr) {
      objection_ = "the pole lies in the ground";
      return;
    }
    for (const double angle : {upper(), lower()}) {
      const mesh::Point end = radius_at(angle) * towards(angle);
      for (const Piece& piece : pieces_) {
        const mesh::Point along = piece.second - piece.first;
        const double size = cross(end, along);
        if (size == 0.0) continue;
        const double of_sight = cross(piece.first, along) / size;
        const double of_piece = cross(piece.first, end) / size;
        if (of_sight > 0.0 && of_sight < 1.0 - touches && of_piece >= 0.0 && of_piece <= 1.0) {
          objection_ = "ground between the pole and an end of the curve";
        }
      }
    }
  }

  [[nodiscard]] bool is_inside(const mesh::Point& place) const {
    constexpr double touches = 1e-9;
    const double angle = angle_of(place);
    return angle > lower() + touches && angle < upper() - touches &&
           place.norm() < (1.0 - touches) * radius_at(angle);
  }

  // A piece that is held has neither end in the block, and the curve does not cross it.
  void check_held() {
    constexpr double touches = 1e-9;
    for (const Piece& piece : pieces_) {
      if (piece.side == nullptr || (piece.side->normal == problem::Known::traction &&
                                    piece.side->tangential == problem::Known::traction)) {
        continue;
      }
      bool is_hit = is_inside(piece.first) || is_inside(piece.second);
      const mesh::Point along = piece.second - piece.first;
      for (const double angle : crossings(piece)) {
        const double share =
            (radius_at(angle) * towards(angle) - piece.first).dot(along) / along.squaredNorm();
        is_hit = is_hit || (share > touches && share < 1.0 - touches);
      }
      if (is_hit) objection_ = "side " + piece.side->name + " does not let it move";
    }
  }

  [[nodiscard]] const problem::Soil* soil_at(const mesh::Point& place) const {
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      const auto& corners = triangles_[t];
      bool is_in = true;
      for (std::size_t i = 0; i < 3; ++i) {
        const mesh::Point along = corners[(i + 1) % 3] - corners[i];
        is_in = is_in && cross(along, place - corners[i]) >= 0.0;
      }
      if (is_in) {
        return &problem_.soils[static_cast<std::size_t>(problem_.mesh.triangles[t].region)];
      }
    }
    return nullptr;
  }

  // Along the curve, soil by soil.
  void dissipate() {
    std::vector<double> ends{lower(), upper()};
    for (const problem::SpiralArc& arc : block_.arcs) ends.push_back(arc.lower);
    for (const Piece& piece : pieces_) {
      for (const double angle : crossings(piece)) ends.push_back(angle);
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      constexpr double rounding = 1e-9;
      if (ends[i + 1] - ends[i] < rounding * (upper() - lower())) continue;
      const double middle = (ends[i] + ends[i + 1]) / 2.0;
      const problem::Soil* soil = soil_at(radius_at(middle) * towards(middle));
      if (soil == nullptr) continue;  // outside of the ground nothing parts
      if (soil->varies() || soil->is_curved()) {
        objection_ = "soil of one cohesion only";
        return;
      }
      const double growth = std::tan(soil->friction_angle);
      if (std::abs(arc_at(middle).growth - growth) > 1e-12 * (1.0 + growth)) {
        objection_ = "the curve is not at the friction angle of its soil";
        return;
      }
      dissipation_ +=
          soil->cohesion * integral(ends[i], ends[i + 1], 2.0 * growth, [&](double angle) {
            const double radius = at(arc_at(middle), angle);
            return radius * radius;
          });
    }
  }

  // Loads of a piece: the first moments of the soil to its left, less that to its right, between it
  // and the pole, as far as it is in the block, by rays; and its tractions.
  void work(const Piece& piece) {
    std::vector<double> ends = crossings(piece);
    double first = std::atan2(piece.first.y(), piece.first.x());
    double turn = std::atan2(cross(piece.first, piece.second), piece.first.dot(piece.second));
    const double sign = turn < 0.0 ? -1.0 : 1.0;
    if (turn < 0.0) {
      first += turn;
      turn = -turn;
    }
    first += 2.0 * pi * std::ceil((lower() - first - turn) / (2.0 * pi));
    const double from = std::max(first, lower()), to = std::min(first + turn, upper());
    if (!(from < to)) return;
    for (const problem::SpiralArc& arc : block_.arcs) ends.push_back(arc.lower);
    ends.insert(ends.end(), {from, to});
    std::sort(ends.begin(), ends.end());
    const mesh::Point along = piece.second - piece.first;
    const double area = cross(piece.first, along);
    const auto distance = [&](double angle) { return area / cross(towards(angle), along); };
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      if (ends[i] < from || ends[i + 1] > to || !(ends[i] < ends[i + 1])) continue;
      const double middle = (ends[i] + ends[i + 1]) / 2.0;
      const problem::SpiralArc& arc = arc_at(middle);
      const bool is_in = distance(middle) < at(arc, middle);
      // Near the end of sight along the piece, its distance is steep.
      const double slant = std::abs(cross(towards(middle), along)) / along.norm();
      const auto moment = [&](double phase) {
        return sign *
               integral(ends[i], ends[i + 1], 3.0 * arc.growth + 3.0 / slant, [&](double angle) {
                 const double radius = is_in ? distance(angle) : at(arc, angle);
                 return radius * radius * radius * std::cos(angle - phase) / 3.0;
               });
      };
      weigh(piece, mesh::Point(moment(0.0), moment(pi / 2.0)));
      if (is_in && piece.side != nullptr) {
        const double begin = sign > 0.0 ? ends[i] : ends[i + 1];
        const double end = sign > 0.0 ? ends[i + 1] : ends[i];
        push(*piece.side, distance(begin) * towards(begin), distance(end) * towards(end));
      }
    }
  }

  // The velocity at (x, y) from the pole is (-y, x).
  void weigh(const Piece& piece, const mesh::Point& moment) {
    const double shear = block_.clockwise ? -1.0 : 1.0;  // as x is turned round
    const auto power = [&](const mesh::Point& pull) {
      return -shear * pull.x() * moment.y() + pull.y() * moment.x();
    };
    const double dead = power(problem_.pull), live = power(problem_.live_pull);
    dead_ += piece.left->unit_weight * dead;
    live_ += piece.left->live_unit_weight * live;
    if (piece.right == nullptr) return;
    dead_ -= piece.right->unit_weight * dead;
    live_ -= piece.right->live_unit_weight * live;
  }

  // Constant tractions on a linear velocity.
  void push(const problem::Boundary& side, const mesh::Point& first, const mesh::Point& second) {
    const mesh::Point along = second - first, outward(along.y(), -along.x());
    const mesh::Point middle = (first + second) / 2.0, velocity(-middle.y(), middle.x());
    const double shear = block_.clockwise ? -1.0 : 1.0;
    const double opens = outward.dot(velocity), slips = shear * along.dot(velocity);
    dead_ += side.normal_stress * opens + side.shear_stress * slips;
    live_ += side.live_normal_stress * opens + side.live_shear_stress * slips;
  }

  const problem::Problem& problem_;
  const problem::TurningBlock& block_;
  std::vector<Piece> pieces_;  // seen from the pole
  std::vector<std::array<mesh::Point, 3>> triangles_;
  std::string objection_;
  double dissipation_ = 0.0, dead_ = 0.0, live_ = 0.0;
};

}  // namespace

BlockCertificate certify_block(const problem::Problem& problem,
                               const problem::TurningBlock& block) {
  return Examination(problem, block).certificate();
}

}  // namespace limit::certificate
