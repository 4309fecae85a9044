#include "equilibrium/background_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "equilibrium/box_mesh.hpp"
#include "equilibrium/elastic_block.hpp"
#include "equilibrium/tree_mesh.hpp"
#include "fpm/threads.hpp"

namespace equilibrium {
namespace {

constexpr double penalty_factor = 10.0;  // times E, on the grid, for prescribed unknowns

// The unknowns of the free nodes, from one end of the body's longest extent to the other, and
// along its shorter ones where they are as far.
template <class Mesh>
std::vector<int> sorted_along(const Mesh& mesh) {
  const fpm::Index nodes = mesh.free_nodes();
  using Place = decltype(mesh.place(0));
  constexpr int dim = Place::SizeAtCompileTime;
  Place low = mesh.place(0), high = low;
  for (fpm::Index node = 1; node < nodes; ++node) {
    low = low.cwiseMin(mesh.place(node));
    high = high.cwiseMax(mesh.place(node));
  }
  std::array<int, dim> axes{};
  std::iota(axes.begin(), axes.end(), 0);
  const Place extent = high - low;
  std::ranges::sort(axes, [&](int i, int j) { return extent[i] > extent[j]; });
  std::vector<fpm::Index> order(static_cast<std::size_t>(nodes));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, [&](fpm::Index a, fpm::Index b) {
    const Place p = mesh.place(a), q = mesh.place(b);
    for (const int i : axes) {
      if (p[i] != q[i]) return p[i] < q[i];
    }
    return false;
  });
  std::vector<int> unknowns;
  for (const fpm::Index node : order) {
    for (int i = 0; i < dim; ++i) unknowns.push_back(node * dim + i);
  }
  return unknowns;
}

// Whether images behind a plane hold the body where a piece of its surface on a face of the box is.
template <int Dim>
bool holds(const fpm::GhostPlane<Dim>& plane, int face, const fpm::Vector<Dim>& place,
           const model::Model<Dim>& model) {
  const double middle = 0.5 * (model.box_min[plane.axis] + model.box_max[plane.axis]);
  if (face != 2 * plane.axis + (plane.position > middle ? 1 : 0)) return false;
  for (int i = 0; i < Dim; ++i) {
    if (i != plane.axis && (place[i] < plane.range_min[i] || place[i] > plane.range_max[i])) {
      return false;
    }
  }
  return true;
}

}  // namespace

template <int Dim>
BackgroundGrid<Dim>::BackgroundGrid(const model::Model<Dim>& model, double grid_over_spacing)
    : prescribed_(model.prescribed) {
  const bool behind = model.background.size() > 0;
  const fpm::Cells<Dim>& cells = behind ? model.background : model.cells;
  if (cells.graded()) {
    const int levels = std::max(1, static_cast<int>(std::floor(std::log2(grid_over_spacing))));
    build(model, TreeMesh<Dim>(cells.coarsened(levels)));
  } else {
    build(model, BoxMesh<Dim>(model, grid_over_spacing * model.spacing));
  }
}

template <int Dim>
template <class Mesh>
void BackgroundGrid<Dim>::build(const model::Model<Dim>& model, const Mesh& mesh) {
  free_nodes_ = mesh.free_nodes();
  std::vector<Eigen::Triplet<double>> entries = grid_stiffness(model, mesh);
  add_grid_supports(model, mesh, entries);
  mesh.eliminate(entries);
  const auto size = static_cast<int>(free_nodes_ * Dim);
  // Grid nodes that no particle sees keep a row of their own.
  for (int k = 0; k < size; ++k) entries.emplace_back(k, k, 0.0);
  Eigen::SparseMatrix<double> stiffness(size, size);
  stiffness.setFromTriplets(entries.begin(), entries.end());
  stiffness.diagonal().array() += 1e-10 * stiffness.diagonal().maxCoeff();
  factor_ = CoarseFactor(stiffness, sorted_along(mesh));
  coarse_.resize(mesh.nodes() * Dim);
  index_by_nodes(mesh.nodes());
  coarse_single_.resize(size);
  mesh.for_each_dependence([&](fpm::Index node, fpm::Index parent, double share) {
    dependences_.push_back({node, parent, share});
  });
}

// The stiffest of the materials that each node's particles are of.
template <int Dim>
Eigen::VectorXd BackgroundGrid<Dim>::node_moduli(const model::Model<Dim>& model,
                                                 fpm::Index nodes) const {
  Eigen::VectorXd modulus = Eigen::VectorXd::Zero(nodes);
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    const double own = model.youngs_modulus_of(a);
    for (const fpm::Index node : corner_.col(a)) modulus[node] = std::max(modulus[node], own);
  }
  return modulus;
}

// Planes of images hold the nodes on them, penalty supports those of their points;
// a stiffness far above the body's would cost the single-precision factor its digits.
template <int Dim>
template <class Mesh>
void BackgroundGrid<Dim>::add_grid_supports(const model::Model<Dim>& model, const Mesh& mesh,
                                            std::vector<Eigen::Triplet<double>>& entries) const {
  const Eigen::VectorXd most = penalty_factor *
                               std::pow(model.particles.volume.maxCoeff(), 1.0 - 2.0 / Dim) *
                               node_moduli(model, mesh.nodes());
  // Behind elements the grid ends where it will: their own faces are held instead (below).
  const bool behind = model.background.size() > 0;
  for (const fpm::GhostPlane<Dim>& plane : model.ghosts.planes()) {
    for (fpm::Index node = 0; node < mesh.nodes(); ++node) {
      if (behind || !mesh.is_on(plane, node)) continue;
      for (int i = 0; i < Dim; ++i) {
        if (plane.held[static_cast<std::size_t>(i)]) {
          entries.emplace_back(node * Dim + i, node * Dim + i, most[node]);
        }
      }
    }
  }
  // `holds(i)`: whether the spring acts along axis i.
  const auto add_spring = [&](const Eigen::Matrix<double, 1, Dim>& place, double stiffness,
                              auto&& holds) {
    const GridPoint<Dim> at = mesh.at(place);
    for (const fpm::Index node : at.nodes) stiffness = std::min(stiffness, most[node]);
    for (int i = 0; i < Dim; ++i) {
      if (!holds(i)) continue;
      for (int p = 0; p < at.corners; ++p) {
        for (int q = 0; q < at.corners; ++q) {
          entries.emplace_back(at.nodes[p] * Dim + i, at.nodes[q] * Dim + i,
                               stiffness * at.values[p] * at.values[q]);
        }
      }
    }
  };
  for (const model::SurfacePiece<Dim>& piece : model.surface) {
    if (!behind || piece.face < 0) continue;
    const fpm::Vector<Dim> middle = model::middle_of(piece);
    for (const fpm::GhostPlane<Dim>& plane : model.ghosts.planes()) {
      if (!holds(plane, piece.face, middle, model)) continue;
      add_spring(middle.transpose(), std::numeric_limits<double>::infinity(),
                 [&](int i) { return plane.held[static_cast<std::size_t>(i)]; });
    }
  }
  for (const model::Interface<Dim>& interface : model.interfaces) {
    if (!interface.is_rigid()) continue;  // two bodies are one on the grid
    const auto& points = interface.faces.points;
    const bool sticks = constitutive::sticks(interface.law);
    for (fpm::Index c = 0; c < points.size(); ++c) {
      add_spring(points.position.row(c), interface.stiffness[c] * points.weight[c], [&](int i) {
        const bool gives = interface.plate && interface.plate->free[static_cast<std::size_t>(i)];
        return !gives && (sticks || points.normal(c, i) != 0.0);
      });
    }
  }
  for (const model::PenaltySupport<Dim>& support : model.penalty_supports) {
    for (fpm::Index c = 0; c < support.points.size(); ++c) {
      add_spring(support.points.position.row(c), support.options.penalty * support.points.weight[c],
                 [&](int i) { return support.options.prescribed[static_cast<std::size_t>(i)]; });
    }
  }
}

// Elastic stiffness of the grid by quadrature over the particles, whose interpolation is kept.
template <int Dim>
template <class Mesh>
std::vector<Eigen::Triplet<double>> BackgroundGrid<Dim>::grid_stiffness(
    const model::Model<Dim>& model, const Mesh& mesh) {
  constexpr int corners = GridPoint<Dim>::corners;
  const Eigen::Index n = model.size();
  corner_.resize(corners, n);
  weight_.resize(corners, n);
  typename Mesh::Stiffness stiffness(mesh);
  for (Eigen::Index a = 0; a < n; ++a) {
    const Eigen::Matrix<double, 1, Dim> place = model.particles.position.row(a);
    const GridPoint<Dim> own = mesh.at(place);
    corner_.col(a) = own.nodes;
    weight_.col(a) = own.values.template cast<float>();
    const constitutive::ElasticModuli m = moduli_of(model, a);
    const auto add_point = [&](const GridPoint<Dim>& at, double share) {
      const double volume = share * model.particles.volume[a];
      const double penalty = share * penalty_factor * model.youngs_modulus_of(a) *
                             std::pow(model.particles.volume[a], 1.0 - 2.0 / Dim);
      for (int p = 0; p < corners; ++p) {
        for (int q = 0; q < corners; ++q) {
          fpm::Tensor<Dim> block =
              volume * elastic_block<Dim>(m, fpm::Vector<Dim>(at.gradients.col(p)),
                                          fpm::Vector<Dim>(at.gradients.col(q)));
          for (int i = 0; i < Dim; ++i) {
            if (prescribed_[static_cast<std::size_t>(i * n + a)] != 0) {
              block(i, i) += penalty * at.values[p] * at.values[q];
            }
          }
          stiffness.add(at, p, q, block);
        }
      }
    };
    mesh.for_each_quadrature_point(own, place, model.spacing_at(a), add_point);
  }
  return stiffness.entries();
}

template <int Dim>
void BackgroundGrid<Dim>::index_by_nodes(fpm::Index nodes) {
  begin_.assign(static_cast<std::size_t>(nodes) + 1, 0);
  for (Eigen::Index k = 0; k < corner_.size(); ++k) {
    ++begin_[static_cast<std::size_t>(corner_.data()[k]) + 1];
  }
  for (std::size_t k = 1; k < begin_.size(); ++k) begin_[k] += begin_[k - 1];
  place_.resize(static_cast<std::size_t>(corner_.size()));
  std::vector<std::size_t> at(begin_.begin(), begin_.end() - 1);
  for (Eigen::Index k = 0; k < corner_.size(); ++k) {
    place_[at[static_cast<std::size_t>(corner_.data()[k])]++] = static_cast<std::uint32_t>(k);
  }
}

// coarse_ = P^T r. Each node adds up its loads in the order of the particles, whatever the threads.
template <int Dim>
void BackgroundGrid<Dim>::restrict_loads(const Eigen::VectorXd& r) {
  const Eigen::Index n = corner_.cols();
  const auto nodes = static_cast<fpm::Index>(begin_.size()) - 1;
  constexpr fpm::Index per_block = 32;
  fpm::for_each_row(nodes, per_block, [&](fpm::Index node) {
    fpm::Vector<Dim> sum = fpm::Vector<Dim>::Zero();
    const auto end = begin_[static_cast<std::size_t>(node) + 1];
    for (auto k = begin_[static_cast<std::size_t>(node)]; k < end; ++k) {
      const double weight = weight_.data()[place_[k]];
      const Eigen::Index a = place_[k] >> Dim;
      for (int i = 0; i < Dim; ++i) {
        const bool given = prescribed_[static_cast<std::size_t>(i * n + a)] != 0;
        sum[i] += weight * (given ? 0.0 : r[i * n + a]);
      }
    }
    coarse_.template segment<Dim>(node * Dim) = sum;
  });
}

template <int Dim>
void BackgroundGrid<Dim>::solve(const Eigen::VectorXd& r) {
  restrict_loads(r);
  for (const Dependence& each : dependences_) {
    for (int i = 0; i < Dim; ++i) {
      coarse_[each.parent * Dim + i] += each.share * coarse_[each.node * Dim + i];
    }
  }
  const auto free = coarse_.head(coarse_single_.size());
  // Scaled, so that the range of single precision is never left whatever the units.
  const double scale = free.cwiseAbs().maxCoeff();
  if (!(scale > 0.0) || !std::isfinite(scale)) {
    coarse_.setZero();
    return;
  }
  coarse_single_.noalias() = (free / scale).template cast<float>();
  factor_.solve(coarse_single_);
  coarse_.head(coarse_single_.size()) = coarse_single_.template cast<double>() * scale;
  for (const Dependence& each : dependences_)
    coarse_.template segment<Dim>(each.node * Dim).setZero();
  for (const Dependence& each : dependences_) {
    for (int i = 0; i < Dim; ++i) {
      coarse_[each.node * Dim + i] += each.share * coarse_[each.parent * Dim + i];
    }
  }
}

template <int Dim>
std::size_t BackgroundGrid<Dim>::bytes() const {
  const auto bytes_of = [](const auto& m) {
    return static_cast<std::size_t>(m.size()) * sizeof(*m.data());
  };
  return bytes_of(corner_) + begin_.size() * sizeof(std::size_t) +
         place_.size() * sizeof(std::uint32_t) + dependences_.size() * sizeof(Dependence) +
         bytes_of(weight_) + bytes_of(coarse_) + bytes_of(coarse_single_) + prescribed_.size() +
         factor_.bytes();
}

template class BackgroundGrid<2>;
template class BackgroundGrid<3>;

}  // namespace equilibrium
