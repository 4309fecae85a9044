#include "model/cut_body.hpp"

#include <algorithm>
#include <cmath>
#include <set>

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

// Cuts a joint into pieces as long as the cells beside it are wide.
std::vector<double> joint_cuts(const shape::Joint& joint, const fpm::Cells<2>& cells) {
  const Place along = joint.to - joint.from;
  const double length = along.norm();
  std::vector<double> cuts{0.0};
  while (cuts.back() < length) {
    const double next = cuts.back() + 0.5 * cells.lattice().spacing;
    const fpm::Index cell = cells.containing(joint.from + std::min(1.0, next / length) * along);
    cuts.push_back(cuts.back() + (cell < 0 ? cells.lattice().spacing : cells.width(cell)));
  }
  // Stretched or shrunk to its length, whichever is less.
  if (cuts.size() > 2 && cuts.back() - length > length - cuts[cuts.size() - 2]) cuts.pop_back();
  for (double& cut : cuts) cut /= cuts.back();
  return cuts;
}

// Of two regions one of which is not there the joint is surface.
std::vector<SurfacePiece<2>> exposed(const shape::Body& body, const CutCells& cut,
                                     const fpm::Cells<2>& cells, const std::vector<char>& present) {
  std::vector<SurfacePiece<2>> pieces;
  for (const shape::Joint& joint : body.joints()) {
    const bool left = present[static_cast<std::size_t>(joint.left)] != 0;
    if (left == (present[static_cast<std::size_t>(joint.right)] != 0)) continue;
    const int region = left ? joint.left : joint.right;
    const Place from = left ? joint.from : joint.to, to = left ? joint.to : joint.from;
    const Place within = left_of(from, to) * (inward * cells.lattice().spacing);
    const auto cuts = joint_cuts(joint, cells);
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
  for (const shape::Joint& joint : body.joints()) {
    if (present[static_cast<std::size_t>(joint.left)] == 0 ||
        present[static_cast<std::size_t>(joint.right)] == 0) {
      continue;
    }
    const Place along = joint.to - joint.from;
    const Place left = left_of(joint.from, joint.to) * (inward * cells.lattice().spacing);
    const auto cuts = joint_cuts(joint, cells);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const Place middle = joint.from + 0.5 * (cuts[k] + cuts[k + 1]) * along;
      pieces.push_back({joint.from + cuts[k] * along, joint.from + cuts[k + 1] * along,
                        cut.particle_at(middle + left, joint.left, cells),
                        cut.particle_at(middle - left, joint.right, cells)});
    }
  }
  return pieces;
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
