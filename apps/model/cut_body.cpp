#include "model/cut_body.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "model/cut_cells.hpp"
#include "model/surface.hpp"
#include "scene/cutouts.hpp"
#include "scene/ground.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

using Place = Eigen::Vector2d;

// Parameters 0 ... 1 at which a segment crosses the lines of the finest cells, both ends included.
std::vector<double> crossings(const fpm::LatticeOptions<2>& lattice, const Place& from,
                              const Place& to) {
  std::set<double> at{0.0, 1.0};
  for (int i = 0; i < 2; ++i) {
    const double length = to[i] - from[i];
    if (std::abs(length) <= 1e-9 * lattice.spacing) continue;
    const double low = (std::min(from[i], to[i]) - lattice.min[i]) / lattice.spacing;
    const double high = (std::max(from[i], to[i]) - lattice.min[i]) / lattice.spacing;
    for (double line = std::ceil(low); line <= high; line += 1.0) {
      const double t = (lattice.min[i] + line * lattice.spacing - from[i]) / length;
      if (t > 0.0 && t < 1.0) at.insert(t);
    }
  }
  return {at.begin(), at.end()};
}

// Unit normal of a segment, to its left.
Place left_of(const Place& from, const Place& to) {
  const Place along = (to - from).normalized();
  return {-along.y(), along.x()};
}

constexpr double inward = 1e-6;  // spacings, to be on one side of a segment

// Cuts the segments of a surface where they pass from one cell to another.
std::vector<SurfacePiece<2>> pieces_of(const shape::Body& body, const CutCells& cut,
                                       const fpm::Cells<2>& cells,
                                       const std::vector<char>& present) {
  constexpr double sliver = 1e-9;  // spacings
  const auto& lattice = cells.lattice();
  std::vector<SurfacePiece<2>> pieces;
  for (const shape::SurfaceSegment& segment : body.surface()) {
    if (present[static_cast<std::size_t>(segment.region)] == 0) continue;
    const Place along = segment.to - segment.from;
    const Place left = left_of(segment.from, segment.to) * (inward * lattice.spacing);
    const auto cuts = crossings(lattice, segment.from, segment.to);
    bool first = true;
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      if ((cuts[k + 1] - cuts[k]) * along.norm() <= sliver * lattice.spacing) continue;
      const Place middle = segment.from + 0.5 * (cuts[k] + cuts[k + 1]) * along;
      const fpm::Index owner = cut.particle_at(middle + left, segment.region, cells);
      const Place end = segment.from + cuts[k + 1] * along;
      if (!first && pieces.back().particle == owner) {
        pieces.back().to = end;
        continue;
      }
      const Place begin = first ? segment.from : pieces.back().to;
      pieces.push_back({begin, end, owner, segment.cut, segment.side, segment.face});
      first = false;
    }
    if (!first) pieces.back().to = segment.to;
  }
  return pieces;
}

// Cuts a line into pieces as long as the cells beside it are wide.
std::vector<double> even_cuts(const Place& from, const Place& to, const fpm::Cells<2>& cells) {
  const Place along = to - from;
  const double length = along.norm();
  std::vector<double> cuts{0.0};
  while (cuts.back() < length) {
    const double next = cuts.back() + 0.5 * cells.lattice().spacing;
    const fpm::Index cell = cells.containing(from + std::min(1.0, next / length) * along);
    cuts.push_back(cuts.back() + (cell < 0 ? cells.lattice().spacing : cells.width(cell)));
  }
  // Stretched or shrunk to its length, whichever is less.
  if (cuts.size() > 2 && cuts.back() - length > length - cuts[cuts.size() - 2]) cuts.pop_back();
  for (double& cut : cuts) cut /= cuts.back();
  return cuts;
}

// The same of a joint, none of whose pieces changes hands: bodies would not close there.
// @param owners  of a place on it -> whose it is, comparable
template <class Owners>
std::vector<double> joint_cuts(const shape::Joint& joint, const fpm::Cells<2>& cells,
                               const Owners& owners) {
  constexpr double sliver = 1e-9;  // spacings
  const Place along = joint.to - joint.from;
  const auto lines = crossings(cells.lattice(), joint.from, joint.to);
  std::vector<double> ends{0.0};
  std::optional<decltype(owners(joint.from))> last;
  for (std::size_t k = 0; k + 1 < lines.size(); ++k) {
    if ((lines[k + 1] - lines[k]) * along.norm() <= sliver * cells.lattice().spacing) continue;
    const auto here = owners(joint.from + 0.5 * (lines[k] + lines[k + 1]) * along);
    if (last && *last != here) ends.push_back(lines[k]);
    last = here;
  }
  if (ends.size() == 1) return even_cuts(joint.from, joint.to, cells);
  ends.push_back(1.0);
  std::vector<double> cuts{0.0};
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const Place from = joint.from + ends[k] * along, to = joint.from + ends[k + 1] * along;
    for (const double cut : even_cuts(from, to, cells)) {
      if (cut > 0.0) cuts.push_back(ends[k] + cut * (ends[k + 1] - ends[k]));
    }
    cuts.back() = ends[k + 1];
  }
  return cuts;
}

int owner_region(fpm::Index particle, const std::vector<int>& regions) {
  return particle < 0 ? -1 : regions[static_cast<std::size_t>(particle)];
}

// Of two regions one of which is not there the joint is surface.
std::vector<SurfacePiece<2>> exposed(const shape::Body& body, const CutCells& cut,
                                     const fpm::Cells<2>& cells, const std::vector<char>& present) {
  std::vector<SurfacePiece<2>> pieces;
  const std::vector<int> regions = cut.regions(cells);
  for (const shape::Joint& joint : body.joints()) {
    const bool left = present[static_cast<std::size_t>(joint.left)] != 0;
    if (left == (present[static_cast<std::size_t>(joint.right)] != 0)) continue;
    const int region = left ? joint.left : joint.right;
    const Place from = left ? joint.from : joint.to, to = left ? joint.to : joint.from;
    const Place within = left_of(from, to) * (inward * cells.lattice().spacing);
    const auto cuts = joint_cuts({from, to, joint.left, joint.right}, cells, [&](const Place& at) {
      return owner_region(cut.particle_at(at + within, region, cells), regions);
    });
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const Place middle = from + 0.5 * (cuts[k] + cuts[k + 1]) * (to - from);
      SurfacePiece<2> piece{from + cuts[k] * (to - from), from + cuts[k + 1] * (to - from),
                            cut.particle_at(middle + within, region, cells)};
      piece.side = exposed_side;
      pieces.push_back(piece);
    }
  }
  return pieces;
}

std::vector<JointPiece<2>> joints_of(const shape::Body& body, const CutCells& cut,
                                     const fpm::Cells<2>& cells, const std::vector<char>& present) {
  std::vector<JointPiece<2>> pieces;
  const std::vector<int> regions = cut.regions(cells);
  for (const shape::Joint& joint : body.joints()) {
    if (present[static_cast<std::size_t>(joint.left)] == 0 ||
        present[static_cast<std::size_t>(joint.right)] == 0) {
      continue;
    }
    const Place along = joint.to - joint.from;
    const Place left = left_of(joint.from, joint.to) * (inward * cells.lattice().spacing);
    const auto cuts = joint_cuts(joint, cells, [&](const Place& at) {
      return std::pair(owner_region(cut.particle_at(at + left, joint.left, cells), regions),
                       owner_region(cut.particle_at(at - left, joint.right, cells), regions));
    });
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const Place middle = joint.from + 0.5 * (cuts[k] + cuts[k + 1]) * along;
      pieces.push_back({joint.from + cuts[k] * along, joint.from + cuts[k + 1] * along,
                        cut.particle_at(middle + left, joint.left, cells),
                        cut.particle_at(middle - left, joint.right, cells)});
    }
  }
  return pieces;
}

// A region's share of a cell that goes to another cell's particle: to one of the region, and the
// two are of one body; or, where its tip is less than particles wide, to one of its neighbour: then
// bodies meet in the midst of the region as well. Of a region that is not there nothing meets.
void hand_over(const shape::Body& body, const CutCells& cut, const fpm::Cells<2>& cells,
               const std::vector<char>& present, Model<2>& model) {
  constexpr double sliver = 1e-9;  // spacings
  const std::vector<int> regions = cut.regions(model.cells);
  cut.for_each_handed_over(model.cells, [&](fpm::Index a, fpm::Index b, int axis, int region,
                                            fpm::Index first, fpm::Index second) {
    if (present[static_cast<std::size_t>(region)] == 0) return;
    const bool is_first = cells.width(a) <= cells.width(b);
    const fpm::Index narrow = is_first ? a : b;
    Place low = cells.lower(narrow), high = cells.upper(narrow);
    (is_first ? low : high)[axis] = (is_first ? high : low)[axis];
    // With the first to the left.
    const Place from = axis == 0 ? low : high, to = axis == 0 ? high : low;
    const shape::Stretch within = body.along(from, to, region);
    if (within.length <= sliver * cells.lattice().spacing) return;
    if (owner_region(first, regions) == owner_region(second, regions)) {
      model.meeting.emplace_back(first, second);
      return;
    }
    const Place half = 0.5 * within.length * (to - from).normalized();
    model.joints.push_back({within.middle - half, within.middle + half, first, second});
  });
}

fpm::Index nearest_to(const Place& place, const fpm::Field<2>& position) {
  Eigen::Index nearest = 0;
  (position.rowwise() - place.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
  return static_cast<fpm::Index>(nearest);
}

// Pieces that lie on what belongs to no cell, by round-off, go to the nearest particle.
void find_owners(const fpm::Field<2>& position, std::vector<SurfacePiece<2>>& pieces) {
  for (SurfacePiece<2>& piece : pieces) {
    if (piece.particle >= 0) continue;
    const Place middle = 0.5 * (piece.from + piece.to);
    piece.particle = nearest_to(middle, position);
  }
}

// What has no owner lies on what belongs to no cell, by round-off.
void find_owners(const fpm::Field<2>& position, std::vector<JointPiece<2>>& pieces) {
  for (JointPiece<2>& piece : pieces) {
    const Place middle = 0.5 * (piece.from + piece.to);
    for (fpm::Index* particle : {&piece.first, &piece.second}) {
      if (*particle < 0) *particle = nearest_to(middle, position);
    }
  }
}

void cut_plane_body(const scene::Scene& scene, Model<2>& model) {
  const shape::Body body = scene::body_of(scene);
  const fpm::Cells<2> whole = model.cells;
  const CutCells cut(body, whole);
  std::vector<char> present(static_cast<std::size_t>(body.regions()), 1);
  for (std::size_t r = 0; r < scene.region.size(); ++r) present[r] = scene.region[r].present;
  model.cells = cut.standing(present);
  model.particles = fpm::make_particles(model.cells);
  Eigen::VectorXd area = Eigen::VectorXd::Zero(model.size());
  fpm::Field<2> moment = fpm::Field<2>::Zero(model.size(), 2);
  cut.for_each_share(model.cells, [&](fpm::Index b, double share, const Place& centroid) {
    area[b] += share;
    moment.row(b) += share * (centroid - model.cells.site(b)).transpose();
  });
  for (Eigen::Index b = 0; b < model.size(); ++b) {
    const double cell = std::pow(model.cells.width(static_cast<fpm::Index>(b)), 2);
    // A whole cell keeps its jitter, and its digits.
    if (moment.row(b).norm() <= 1e-12 * cell * model.spacing &&
        std::abs(area[b] - cell) <= 1e-12 * cell)
      continue;
    model.particles.volume[b] = area[b];
    model.particles.position.row(b) =
        model.cells.site(static_cast<fpm::Index>(b)).transpose() + moment.row(b) / area[b];
  }
  model.surface = pieces_of(body, cut, model.cells, present);
  for (const SurfacePiece<2>& piece : exposed(body, cut, model.cells, present)) {
    model.surface.push_back(piece);
  }
  find_owners(model.particles.position, model.surface);
  if (scene.region.empty()) return;
  model.joints = joints_of(body, cut, model.cells, present);
  hand_over(body, cut, whole, present, model);
  find_owners(model.particles.position, model.joints);
  for (const int region : cut.regions(model.cells)) {
    model.material.push_back(
        static_cast<MaterialIndex>(scene::material_of(scene, static_cast<std::size_t>(region))));
  }
}

}  // namespace

template <int Dim>
void cut_body(const scene::Scene& scene, Model<Dim>& model) {
  if constexpr (Dim == 2) cut_plane_body(scene, model);
}

template void cut_body<2>(const scene::Scene&, Model<2>&);
template void cut_body<3>(const scene::Scene&, Model<3>&);

}  // namespace model
