#include <cmath>
#include <cstdio>
#include <fpm/fpm.hpp>

// An elastic block, 4 m x 2 m in plane strain, pulled at both ends. Two planes of symmetry leave
// its upper right quarter and hold it in place; its particles lie irregularly.
int main() {
  using namespace fpm;
  const double young = 1e6, nu = 0.3, pull = 2e3;  // [Pa], [-], [Pa]
  const LatticeOptions<2> box{.max = {2.0, 1.0}, .spacing = 0.1, .jitter = 0.2};
  const RowOptions options{.support_radius = 2.4 * box.spacing, .spacing = box.spacing};

  const ParticleSet<2> set = make_lattice(box);
  const Ghosts<2> ghosts(set.position, {symmetry_plane<2>(0, 0.0), symmetry_plane<2>(1, 0.0)},
                         options.max_enlargement * options.support_radius);
  const Rows<2> rows(set, ghosts, options);
  const Index n = set.size();

  // Boundary points on the two free faces, and the operator that is consistent with them.
  const BoundaryQuadratureOptions<2> faces{.max = box.max, .spacing = box.spacing};
  const auto points = boundary_quadrature(faces, {{0, true}, {1, true}});
  const PointOperator<2> at_points(set, ghosts, points.position, options);
  const auto correction = consistency_correction(rows, ghosts, area_vectors(at_points, points));
  const MomentOperator<2> op(rows, ghosts, {}, correction);

  // f = W^T V sigma(W u): gather gradients, apply Hooke's law, scatter forces.
  const double mu = young / (2.0 + 2.0 * nu), lambda = 2.0 * mu * nu / (1.0 - 2.0 * nu);
  Eigen::VectorXd extended(op.stride() * 2), force(op.stride() * 2);
  Eigen::MatrixXd moments(op.block_stride, 4), stress(op.stride(), 4);
  const auto internal_force = [&](const Field<2>& u) {
    op.extend(u.data(), extended.data());
    for (Index block = 0; block < op.block_count(); ++block) {
      op.gather(block, extended.data(), moments.data());
      for (Index r = 0; r < op.block_size(block); ++r) {
        const Index a = op.block_first(block) + r;
        const Tensor<2> gradient = moments.row(r).reshaped(2, 2);
        const Tensor<2> strain = 0.5 * (gradient + gradient.transpose());
        const Tensor<2> sigma = lambda * strain.trace() * Tensor<2>::Identity() + 2.0 * mu * strain;
        stress.row(a) = set.volume[a] * sigma.reshaped().transpose();
      }
    }
    op.scatter(stress.data(), nullptr, nullptr, force.data());
    return Field<2>(force.reshaped(op.stride(), 2).topRows(n));
  };

  // Conjugate gradients on f_int(u) = f_ext: tractions on the right face.
  Field<2> traction = Field<2>::Zero(points.size(), 2);
  traction.col(0) = pull * points.normal.col(0);
  Field<2> u = Field<2>::Zero(n, 2), residual = u;
  add_traction(at_points, points, traction, residual);
  Field<2> direction = residual;
  double norm = residual.squaredNorm();
  const double target = 1e-20 * norm;
  for (int k = 0; k < 2000 && norm > target; ++k) {
    const Field<2> change = internal_force(direction);
    const double step = norm / direction.cwiseProduct(change).sum();
    u += step * direction;
    residual -= step * change;
    const double next = residual.squaredNorm();
    direction = residual + next / norm * direction;
    norm = next;
  }

  // Uniform extension is reproduced exactly, whatever the particles.
  Field<2> exact = set.position;
  exact.col(0) *= pull * (1.0 - nu * nu) / young;
  exact.col(1) *= -pull * nu * (1.0 + nu) / young;
  const double error = (u - exact).norm() / exact.norm();
  std::printf("%d particles, relative error %.1e\n", n, error);
  return error < 1e-6 ? 0 : 1;
}
