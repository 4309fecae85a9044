#include "model/cut_prisms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "model/cut_body.hpp"
#include "model/prism_faces.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

using Place = Eigen::Vector3d;

// A layer through which the sections of all cells are the same.
struct Slab {
  fpm::Index finest = 0;         // of its lowest finest cells, along z
  double low = 0.0, high = 0.0;  // [m]

  double middle() const { return 0.5 * (low + high); }
  double height() const { return high - low; }
};

std::vector<Slab> slabs_of(const fpm::Cells<3>& cells) {
  std::map<fpm::Index, double> floors;
  double top = cells.lattice().min[2];
  for (fpm::Index a = 0; a < cells.size(); ++a) {
    floors.emplace(cells.place(a)[2], cells.lower(a)[2]);
    top = std::max(top, cells.upper(a)[2]);
  }
  std::vector<Slab> slabs;
  for (const auto& [finest, low] : floors) {
    if (!slabs.empty()) slabs.back().high = low;
    slabs.push_back({finest, low, top});
  }
  return slabs;
}

// The cells that a slab goes through, in the plane.
fpm::Cells<2> section_of(const fpm::Cells<3>& cells, const Slab& slab) {
  const fpm::LatticeOptions<3>& whole = cells.lattice();
  fpm::LatticeOptions<2> lattice;
  lattice.min = whole.min.head<2>();
  lattice.max = whole.max.head<2>();
  lattice.spacing = whole.spacing;
  lattice.layout = whole.layout;
  return {lattice, [&](const Eigen::Vector2d& lower, const Eigen::Vector2d& /*upper*/) {
            const Eigen::Vector2d finest = (lower - lattice.min) / lattice.spacing;
            const fpm::Cells<3>::Place place(static_cast<fpm::Index>(std::lround(finest.x())),
                                             static_cast<fpm::Index>(std::lround(finest.y())),
                                             slab.finest);
            return cells.width(cells.holding(place));
          }};
}

// Pieces of a wall or of a joint that are one but for the slabs they are in.
class Columns {
 public:
  using Key = std::array<double, 4>;

  /// Where an equal piece of the slab below is among `pieces`; a new one if there is none.
  template <class Piece, class Owner>
  Piece& find(const Owner& owner, const Eigen::Vector2d& from, const Eigen::Vector2d& to,
              std::vector<Piece>& pieces) {
    const auto [at, is_new] = index_.try_emplace(
        {owner.first, owner.second, {from.x(), from.y(), to.x(), to.y()}}, pieces.size());
    if (is_new) pieces.emplace_back();
    return pieces[at->second];
  }

 private:
  std::map<std::tuple<fpm::Index, fpm::Index, Key>, std::size_t> index_;
};

// Puts a piece on top of what there is of it, if anything.
template <class Piece>
void stack(const Piece& piece, Piece& column) {
  const double below = column.area, sum = below + piece.area;
  const Place middle = below == 0.0
                           ? piece.middle
                           : Place((below * column.middle + piece.area * piece.middle) / sum);
  if constexpr (requires { piece.edges; }) {
    const Place height = column.edges[1] + piece.edges[1];
    column = piece;
    column.edges[1] = height;
  } else {
    column = piece;
  }
  column.middle = middle;
  column.area = sum;
}

// Of particles numbered as the cells of the box: those without a cell of their own have none.
struct Shares {
  Eigen::VectorXd volume;
  fpm::Field<3> moment;          // about the origin
  std::vector<int> material;     // -1 where there is no particle
  std::vector<fpm::Index> heir;  // of cells, as Cells::restricted takes them
  std::vector<SurfacePiece<3>> surface;
  std::vector<JointPiece<3>> joints;
  std::set<std::pair<fpm::Index, fpm::Index>> meeting;
  Columns walls, faces;
};

// The cell in space of a section's cell.
fpm::Index cell_of(const fpm::Cells<3>& cells, const fpm::Cells<2>::Place& place,
                   const Slab& slab) {
  return cells.holding(fpm::Cells<3>::Place(place.x(), place.y(), slab.finest));
}

void add_walls(const Model<2>& section, const std::vector<fpm::Index>& cell, const Slab& slab,
               Shares& shares) {
  for (const SurfacePiece<2>& piece : section.surface) {
    SurfacePiece<3> wall = prism_wall(piece, slab.middle(), slab.height());
    wall.particle = cell[static_cast<std::size_t>(piece.particle)];
    // A face of the box may be one of the scene's sides, too; no piece is of two.
    const fpm::Index kind = (piece.side + 2) * 8 + piece.face + 1;
    stack(wall,
          shares.walls.find(std::pair(wall.particle, kind), piece.from, piece.to, shares.surface));
  }
  for (const JointPiece<2>& joint : section.joints) {
    JointPiece<3> face = prism_joint(joint, slab.middle(), slab.height());
    face.first = cell[static_cast<std::size_t>(joint.first)];
    face.second = cell[static_cast<std::size_t>(joint.second)];
    stack(face, shares.faces.find(std::pair(face.first, face.second), joint.from, joint.to,
                                  shares.joints));
  }
}

void add_end(const Model<2>& section, const std::vector<fpm::Index>& cell, double z, int face,
             Shares& shares) {
  for (fpm::Index b = 0; b < section.cells.size(); ++b) {
    shares.surface.push_back(prism_end(section, b, z, face));
    shares.surface.back().particle = cell[static_cast<std::size_t>(b)];
  }
}

// What a slab adds to the particles that it goes through.
// @return the cell in space of each particle of the section
std::vector<fpm::Index> add_slab(const Model<2>& section, const fpm::Cells<2>& whole,
                                 const fpm::Cells<3>& cells, const Slab& slab, Shares& shares) {
  std::vector<fpm::Index> cell;
  for (fpm::Index b = 0; b < section.cells.size(); ++b) {
    const fpm::Index a = cell_of(cells, section.cells.place(b), slab);
    const auto k = static_cast<std::size_t>(a);
    const double volume = section.particles.volume[b] * slab.height();
    shares.volume[a] += volume;
    shares.moment.row(a).head<2>() += volume * section.particles.position.row(b);
    shares.moment(a, 2) += volume * slab.middle();
    shares.material[k] = static_cast<int>(section.material[static_cast<std::size_t>(b)]);
    shares.heir[k] = a;
    cell.push_back(a);
  }
  for (fpm::Index b = 0; b < whole.size(); ++b) {
    const fpm::Index a = cell_of(cells, whole.place(b), slab);
    if (shares.heir[static_cast<std::size_t>(a)] >= 0) continue;
    const fpm::Index by = section.cells.holding(whole.place(b));
    if (by >= 0) shares.heir[static_cast<std::size_t>(a)] = cell[static_cast<std::size_t>(by)];
  }
  for (const auto& [first, second] : section.meeting) {
    shares.meeting.emplace(cell[static_cast<std::size_t>(first)],
                           cell[static_cast<std::size_t>(second)]);
  }
  add_walls(section, cell, slab, shares);
  return cell;
}

// From numbers of the box's cells to those of the particles.
void take_particles(Shares& shares, Model<3>& model) {
  const fpm::Cells<3> whole = model.cells;
  model.cells = whole.restricted(shares.heir);
  model.particles = fpm::make_particles(model.cells);
  std::vector<fpm::Index> particle(static_cast<std::size_t>(whole.size()), -1);
  for (fpm::Index b = 0; b < model.cells.size(); ++b) {
    const fpm::Index a = whole.holding(model.cells.place(b));
    particle[static_cast<std::size_t>(a)] = b;
    model.material.push_back(
        static_cast<MaterialIndex>(shares.material[static_cast<std::size_t>(a)]));
    const double cell = std::pow(model.cells.width(b), 3), volume = shares.volume[a];
    const Place place = shares.moment.row(a).transpose() / volume;
    // A whole cell keeps its digits.
    if (std::abs(volume - cell) <= 1e-12 * cell &&
        (place - model.cells.site(b)).norm() <= 1e-9 * model.spacing) {
      continue;
    }
    model.particles.volume[b] = volume;
    model.particles.position.row(b) = place.transpose();
  }
  const auto renumber = [&](fpm::Index& a) { a = particle[static_cast<std::size_t>(a)]; };
  model.surface = std::move(shares.surface);
  for (SurfacePiece<3>& piece : model.surface) renumber(piece.particle);
  model.joints = std::move(shares.joints);
  for (JointPiece<3>& joint : model.joints) {
    renumber(joint.first);
    renumber(joint.second);
  }
  for (auto [first, second] : shares.meeting) {
    renumber(first);
    renumber(second);
    model.meeting.emplace_back(first, second);
  }
}

}  // namespace

void cut_prisms(const scene::Scene& scene, Model<3>& model) {
  const fpm::Cells<3>& cells = model.cells;
  const auto n = static_cast<std::size_t>(cells.size());
  Shares shares;
  shares.volume = Eigen::VectorXd::Zero(cells.size());
  shares.moment = fpm::Field<3>::Zero(cells.size(), 3);
  shares.material.assign(n, -1);
  shares.heir.assign(n, -1);
  const std::vector<Slab> slabs = slabs_of(cells);
  for (const Slab& slab : slabs) {
    Model<2> section;
    section.spacing = model.spacing;
    section.cells = section_of(cells, slab);
    const fpm::Cells<2> whole = section.cells;
    section.particles = fpm::make_particles(section.cells);
    cut_body(scene, section);
    const std::vector<fpm::Index> cell = add_slab(section, whole, cells, slab, shares);
    if (&slab == &slabs.front()) add_end(section, cell, slab.low, 4, shares);
    if (&slab == &slabs.back()) add_end(section, cell, slab.high, 5, shares);
  }
  take_particles(shares, model);
}

}  // namespace model
