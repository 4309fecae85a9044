#include "fpm/points.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <stdexcept>
#include <string>

#include "fpm/neighbour_search.hpp"
#include "snap.hpp"

namespace fpm {
namespace {

void check(const RowOptions& options) {
  if (!(options.support_radius > 0.0)) {
    throw std::invalid_argument("the support radius must be positive");
  }
  if (!(options.max_enlargement >= 1.0)) {
    throw std::invalid_argument("the largest enlargement of a support must be at least 1");
  }
}

}  // namespace

// Appends the weights of one point unless its moment matrix is poor. Lengths are scaled by R, so
// that the condition number means something; it does not depend on the scale of the volumes.
template <int Dim>
bool PointOperator<Dim>::append_point(const ParticleSet<Dim>& particles, const Ghosts<Dim>& ghosts,
                                      const std::vector<Index>& found,
                                      const Eigen::Matrix<double, Dim, Eigen::Dynamic>& offset,
                                      double radius, const RowOptions& options) {
  if (static_cast<int>(found.size()) < Dim + 2) return false;
  using Basis = Eigen::Matrix<double, Dim + 1, 1>;
  using MomentMatrix = Eigen::Matrix<double, Dim + 1, Dim + 1>;
  const Index n = particles.size();
  const auto source = [&](Index b) { return b < n ? b : ghosts.source(b - n); };
  const auto weighted_kernel = [&](Index b, const Vector<Dim>& x) {
    const double r = x.norm();
    const KernelValue w = evaluate(options.kernel, r * radius, radius);
    Basis q;
    q[0] = w.value;
    const double slope = r > 0.0 ? -w.derivative * radius / r : 0.0;
    q.template tail<Dim>() = slope * x;
    return Basis(particles.volume[source(b)] * q);
  };

  MomentMatrix moment = MomentMatrix::Zero();
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Vector<Dim> x = offset.col(static_cast<Eigen::Index>(k)) / radius;
    Basis p;
    p << 1.0, x;
    moment += weighted_kernel(found[k], x) * p.transpose();
  }
  const MomentMatrix inverse = moment.inverse();
  const double condition =
      moment.cwiseAbs().colwise().sum().maxCoeff() * inverse.cwiseAbs().colwise().sum().maxCoeff();
  if (!(condition <= options.max_condition)) return false;  // so that a NaN is refused

  for (std::size_t k = 0; k < found.size(); ++k) {
    const Index b = found[k];
    const Vector<Dim> x = offset.col(static_cast<Eigen::Index>(k)) / radius;
    const Basis h = inverse * weighted_kernel(b, x);
    Vector<Dim> sign = Vector<Dim>::Ones();
    if (b >= n) {
      for (int i = 0; i < Dim; ++i) sign[i] = ghosts.sign(b - n, i);
    }
    entries_.push_back({source(b), h[0], h.template tail<Dim>() / radius, sign});
  }
  return true;
}

template <int Dim>
PointOperator<Dim>::PointOperator(const ParticleSet<Dim>& particles, const Ghosts<Dim>& ghosts,
                                  const Field<Dim>& points, const RowOptions& options,
                                  const std::vector<Index>& body)
    : particle_count_(particles.size()) {
  require_size("particle volumes", particles.volume.size(), particles.size());
  check(options);
  if (!body.empty()) {
    require_size("bodies of points", static_cast<Eigen::Index>(body.size()), points.rows());
  }
  Field<Dim> extended(particles.size() + ghosts.size(), Dim);
  extended.topRows(particles.size()) = particles.position;
  ghosts.extend_positions(extended.data(), particles.size(), extended.rows());
  const NeighbourSearch<Dim> search(extended);
  // Images of a support move as it does, not as particles alone: points are served without them.
  const auto around = [&](Index c, const Vector<Dim>& centre, double radius,
                          std::vector<Index>& found) {
    search.within(centre, radius, found);
    std::erase_if(found, [&](Index b) {
      return b >= particles.size() && !ghosts.by_symmetry(b - particles.size());
    });
    if (particles.body.empty() || found.empty()) return;
    const auto body_of = [&](Index b) {
      const Index particle = b < particles.size() ? b : ghosts.source(b - particles.size());
      return particles.body[static_cast<std::size_t>(particle)];
    };
    const auto distance = [&](Index b) {
      return (extended.row(b).transpose() - centre).squaredNorm();
    };
    const Index own = body.empty() ? body_of(*std::ranges::min_element(found, {}, distance))
                                   : body[static_cast<std::size_t>(c)];
    std::erase_if(found, [&](Index b) { return body_of(b) != own; });
  };

  constexpr double growth = 1.05;
  // Boundary points at two to a spacing are a multiple of this from the particles of a lattice.
  const double grid = 0.25 * options.spacing;
  const double round_off = difference_round_off<Dim>(extended);
  std::vector<Index> found;
  Eigen::Matrix<double, Dim, Eigen::Dynamic> offset;
  for (Eigen::Index c = 0; c < points.rows(); ++c) {
    const Vector<Dim> centre = points.row(c).transpose();
    double radius = options.support_radius;
    const auto search_within = [&] {
      around(static_cast<Index>(c), centre, radius, found);
      offset.resize(Dim, static_cast<Eigen::Index>(found.size()));
      for (std::size_t k = 0; k < found.size(); ++k) {
        offset.col(static_cast<Eigen::Index>(k)) =
            snapped<Dim>(extended.row(found[k]).transpose() - centre, grid, round_off);
      }
    };
    search_within();
    while (!append_point(particles, ghosts, found, offset, radius, options)) {
      radius *= growth;
      if (radius > options.max_enlargement * options.support_radius) {
        throw std::runtime_error("point " + std::to_string(c) + " has no well-conditioned " +
                                 "neighbourhood within " + std::to_string(options.max_enlargement) +
                                 " support radii");
      }
      search_within();
    }
    offset_.push_back(entries_.size());
    support_radius_.push_back(radius);
  }
}

template <int Dim>
PointOperator<Dim> PointOperator<Dim>::at_particles(const ParticleSet<Dim>& particles,
                                                    const Ghosts<Dim>& ghosts,
                                                    const std::vector<Index>& particle,
                                                    const RowOptions& options) {
  Field<Dim> points(static_cast<Eigen::Index>(particle.size()), Dim);
  for (std::size_t c = 0; c < particle.size(); ++c) {
    if (particle[c] < 0 || particle[c] >= particles.size()) {
      throw ShapeError("particle " + std::to_string(particle[c]) + " of " +
                       std::to_string(particles.size()));
    }
    points.row(static_cast<Eigen::Index>(c)) = particles.position.row(particle[c]);
  }
  std::vector<Index> body;
  for (const Index a : particle) {
    if (!particles.body.empty()) body.push_back(particles.body[static_cast<std::size_t>(a)]);
  }
  PointOperator result(particles, ghosts, points, options, body);
  for (std::size_t c = 0; c < particle.size(); ++c) {
    bool own = true;  // its images, if any, follow it
    for (std::size_t k = result.offset_[c]; k < result.offset_[c + 1]; ++k) {
      Entry& entry = result.entries_[k];
      entry.value = own && entry.particle == particle[c] ? 1.0 : 0.0;
      if (entry.value != 0.0) own = false;
    }
  }
  return result;
}

template <int Dim>
Vector<Dim> PointOperator<Dim>::value(Index point, const FieldView<Dim>& field) const {
  Vector<Dim> sum = Vector<Dim>::Zero();
  for_each_entry(point, [&](const Entry& entry) { sum += entry.value * entry.image(field); });
  return sum;
}

template <int Dim>
double PointOperator<Dim>::scalar_value(Index point,
                                        const Eigen::Ref<const Eigen::VectorXd>& field) const {
  double sum = 0.0;
  for_each_entry(point, [&](const Entry& entry) { sum += entry.value * field[entry.particle]; });
  return sum;
}

// The weights sum to zero, so the differences from any one neighbour may stand for the values.
template <int Dim>
Tensor<Dim> PointOperator<Dim>::gradient(Index point, const FieldView<Dim>& field) const {
  const Vector<Dim> level = entries_[offset_[static_cast<std::size_t>(point)]].image(field);
  Tensor<Dim> sum = Tensor<Dim>::Zero();
  for_each_entry(point, [&](const Entry& entry) {
    sum += (entry.image(field) - level) * entry.gradient.transpose();
  });
  return sum;
}

template <int Dim>
void PointOperator<Dim>::add_transposed_value(Index point, const Vector<Dim>& point_force,
                                              FieldTarget<Dim> force) const {
  for_each_entry(point, [&](const Entry& entry) {
    force.row(entry.particle) += entry.value * entry.sign.cwiseProduct(point_force).transpose();
  });
}

template <int Dim>
void PointOperator<Dim>::values(const FieldView<Dim>& field, FieldTarget<Dim> result) const {
  require_size("field", field.rows(), particle_count_);
  require_size("values at points", result.rows(), size());
  for (Index c = 0; c < size(); ++c) result.row(c) = value(c, field).transpose();
}

template <int Dim>
void PointOperator<Dim>::gradients(const FieldView<Dim>& field,
                                   FieldTarget<Dim * Dim> result) const {
  require_size("field", field.rows(), particle_count_);
  require_size("gradients at points", result.rows(), size());
  for (Index c = 0; c < size(); ++c) {
    const Tensor<Dim> g = gradient(c, field);
    for (int k = 0; k < Dim * Dim; ++k) result(c, k) = g(k % Dim, k / Dim);
  }
}

template <int Dim>
void PointOperator<Dim>::add_transposed_values(const FieldView<Dim>& point_forces,
                                               FieldTarget<Dim> force) const {
  require_size("point forces", point_forces.rows(), size());
  require_size("force", force.rows(), particle_count_);
  for (Index c = 0; c < size(); ++c) {
    add_transposed_value(c, point_forces.row(c).transpose(), force);
  }
}

template class PointOperator<2>;
template class PointOperator<3>;

}  // namespace fpm
