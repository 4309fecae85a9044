#pragma once

#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "limit/problem/problem.hpp"
#include "limit/problem/turning_block.hpp"

namespace limit::block {

/// Where a curve leaves the ground downhill: a place on a piece of the outline, and which way it
/// comes from there.
struct LowEnd {
  std::size_t piece = 0;
  double share = 0.0;   // of the piece, 0 <= share < 1
  double turn = 0.0;    // [rad] from the piece's direction into the ground, 0 < turn < pi
  double radius = 1.0;  // > 0, from the pole
};

/// A piece of outline, the ground to the left of first -> second.
struct OutlinePiece {
  mesh::Point first{0.0, 0.0}, second{0.0, 0.0};
  bool is_free = false;    // nothing holds it
  bool is_corner = false;  // at its first end the outline turns, or soil or load change
};

/// The ground of a problem as what spirals run through, triangle by triangle. All of its blocks
/// turn counterclockwise; those that turn the other way are the mirror image's.
class BlockGround {
 public:
  /// @param least_length  of a block, from end to end; the powers of much smaller ones than their
  ///     radii would be nothing but rounding
  BlockGround(problem::Problem problem, double least_length);

  /// The same ground with other strengths.
  void set_soils(const std::vector<problem::Soil>& soils);

  [[nodiscard]] const std::vector<OutlinePiece>& outline() const { return pieces_; }

  /// The multiplier of the live loads at which the block over the spiral from there fails: its
  /// dissipation less the power of the dead loads, over that of the live ones. Infinite if the
  /// spiral does not come back to free outline, or the live loads hold the block back.
  [[nodiscard]] double multiplier(const LowEnd& end);
  /// The block of the last spiral whose multiplier is finite.
  [[nodiscard]] problem::TurningBlock last() const { return {pole_, false, arcs_}; }

 private:
  // A side of a triangle: inside is where normal . x > offset.
  struct Facet {
    mesh::Point normal{0.0, 0.0};
    double offset = 0.0, angle = 0.0;  // of the normal
    int across = -1;                   // triangle; -1: outline
    int piece = -1;                    // of the outline
    int seam = -1;                     // between soils of different weights
  };
  struct Facets {
    std::array<Facet, 3> sides;
    int region = 0;
  };
  struct Piece {
    int triangle = 0, boundary = 0, next = -1;
    std::vector<int> around;  // triangles that meet at its first end
  };
  struct Seam {
    mesh::Point first{0.0, 0.0}, second{0.0, 0.0};
    int left = 0, right = 0;  // regions
  };
  struct Crossing {
    int seam = 0;
    mesh::Point place{0.0, 0.0};
  };
  // Powers at unit angular velocity, and the dissipation.
  struct Powers {
    double dead = 0.0, live = 0.0, dissipation = 0.0;
  };

  void add_edges(const std::vector<mesh::Edge>& edges);
  void link_pieces();
  [[nodiscard]] const problem::Soil& soil(int region) const {
    return problem_.soils[static_cast<std::size_t>(region)];
  }
  [[nodiscard]] std::optional<int> triangle_from(const LowEnd& end, const mesh::Point& place,
                                                 const mesh::Point& back) const;
  [[nodiscard]] std::pair<const Facet*, double> way_out(const Facets& triangle, double angle,
                                                        double radius, double growth) const;
  [[nodiscard]] std::optional<int> follow(int triangle, double angle, double radius);
  void add_arc(double upper, double lower, double radius, int region);
  [[nodiscard]] bool add_outline(std::size_t from, const mesh::Point& low, std::size_t to,
                                 const mesh::Point& high);
  [[nodiscard]] bool is_seen_from_pole(std::size_t from, const mesh::Point& low, std::size_t to,
                                       const mesh::Point& high) const;
  void add_seams();
  [[nodiscard]] bool is_in_block(const mesh::Point& place) const;
  void add_weight(const problem::Soil& soil, const mesh::Point& moment, double sign);

  problem::Problem problem_;
  double least_length_;
  std::vector<double> growth_;  // tan(phi) by region
  std::vector<Facets> triangles_;
  std::vector<OutlinePiece> pieces_;
  std::vector<Piece> links_;
  std::vector<Seam> seams_;
  // Of the spiral being followed.
  mesh::Point pole_{0.0, 0.0};
  std::vector<problem::SpiralArc> arcs_;
  std::vector<Crossing> crossings_;
  Powers powers_;
};

/// The problem seen in a mirror, x becoming -x.
[[nodiscard]] problem::Problem mirrored(problem::Problem problem);

}  // namespace limit::block
