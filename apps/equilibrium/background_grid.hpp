#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

#include "equilibrium/coarse_factor.hpp"
#include "model/model.hpp"

namespace equilibrium {

/// The elastic body on a background grid of bilinear (trilinear) elements integrated at the
/// particles, factorised: the coarse level of the preconditioner. The grid of graded particles is
/// graded as they are.
template <int Dim>
class BackgroundGrid {
 public:
  /// No grid: nothing but `empty` and `bytes` may be called.
  BackgroundGrid() = default;
  /// @param grid_over_spacing  width of an element over the spacing of the particles in it, rounded
  ///   so that whole elements fill the box, or down to a power of two, but 2, where they are graded
  /// @throws std::runtime_error if the factorisation fails (a body without support)
  BackgroundGrid(const model::Model<Dim>& model, double grid_over_spacing);

  bool empty() const { return free_nodes_ == 0; }

  /// A_c^-1 P^T r, with r taken as 0 at prescribed unknowns; in single precision.
  void solve(const Eigen::VectorXd& r);
  /// Adds P times the last solution to z at one particle.
  void add_solution(Eigen::Index particle, Eigen::VectorXd& z) const {
    const Eigen::Index n = corner_.cols();
    for (int p = 0; p < 1 << Dim; ++p) {
      const double w = weight_(p, particle);
      for (int i = 0; i < Dim; ++i) {
        z[i * n + particle] += w * coarse_[corner_(p, particle) * Dim + i];
      }
    }
  }

  std::size_t bytes() const;

 private:
  // A hanging node moves by shares of others' displacements.
  struct Dependence {
    fpm::Index node, parent;
    double share;
  };
  void index_by_nodes(fpm::Index nodes);
  void restrict_loads(const Eigen::VectorXd& r);
  template <class Mesh>
  void build(const model::Model<Dim>& model, const Mesh& mesh);
  template <class Mesh>
  std::vector<Eigen::Triplet<double>> grid_stiffness(const model::Model<Dim>& model,
                                                     const Mesh& mesh);
  Eigen::VectorXd node_moduli(const model::Model<Dim>& model, fpm::Index nodes) const;
  template <class Mesh>
  void add_grid_supports(const model::Model<Dim>& model, const Mesh& mesh,
                         std::vector<Eigen::Triplet<double>>& entries) const;

  std::vector<char> prescribed_;
  fpm::Index free_nodes_ = 0;
  std::vector<Dependence> dependences_;
  Eigen::Matrix<fpm::Index, 1 << Dim, Eigen::Dynamic> corner_;  // of each particle's cell
  Eigen::Matrix<float, 1 << Dim, Eigen::Dynamic> weight_;       // interpolation
  // The same by nodes, particles ascending: the loads of node k are those of the places
  // [begin_[k], begin_[k + 1]), each (particle << Dim) + corner.
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> place_;
  CoarseFactor factor_;
  Eigen::VectorXd coarse_;
  Eigen::VectorXf coarse_single_;
};

}  // namespace equilibrium
