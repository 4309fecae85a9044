#include "fpm/points.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "fpm/neighbour_search.hpp"
#include "place_text.hpp"
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

void check(const std::vector<Index>& particle, Index count) {
  for (const Index a : particle) {
    if (a < 0 || a >= count) {
      throw ShapeError("particle " + std::to_string(a) + " of " + std::to_string(count));
    }
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

namespace {

// Particles and mirror images around points.
template <int Dim>
class Surroundings {
 public:
  Surroundings(const ParticleSet<Dim>& particles, const Ghosts<Dim>& ghosts)
      : particles_(particles), ghosts_(ghosts), extended_(particles.size() + ghosts.size(), Dim) {
    extended_.topRows(particles.size()) = particles.position;
    ghosts.extend_positions(extended_.data(), particles.size(), extended_.rows());
    search_.emplace(extended_);
  }

  const Field<Dim>& positions() const { return extended_; }

  // Images of a support move as it does, not as particles alone: points are served without them.
  void within(const Vector<Dim>& centre, double radius, std::vector<Index>& found) const {
    search_->within(centre, radius, found);
    std::erase_if(found, [&](Index b) {
      return b >= particles_.size() && !ghosts_.by_symmetry(b - particles_.size());
    });
  }

  // Those of a particle's body among them.
  void within(const Vector<Dim>& centre, double radius, Index own,
              std::vector<Index>& found) const {
    within(centre, radius, found);
    if (particles_.body.empty()) return;
    std::erase_if(found, [&](Index b) { return body_of(b) != body_of(own); });
  }

  // The nearest particle, searched for in balls that grow from a radius.
  Index nearest(const Vector<Dim>& centre, double radius) const {
    const auto distance = [&](Index b) {
      return (extended_.row(b).transpose() - centre).squaredNorm();
    };
    std::vector<Index> found;
    constexpr int most_doublings = 60;
    for (int k = 0; found.empty(); ++k) {
      if (k > most_doublings) throw std::runtime_error("a point is near no particle");
      within(centre, std::ldexp(radius, k), found);
    }
    return source(*std::ranges::min_element(found, {}, distance));
  }

 private:
  Index source(Index b) const {
    return b < particles_.size() ? b : ghosts_.source(b - particles_.size());
  }
  Index body_of(Index b) const { return particles_.body[static_cast<std::size_t>(source(b))]; }

  const ParticleSet<Dim>& particles_;
  const Ghosts<Dim>& ghosts_;
  Field<Dim> extended_;
  std::optional<NeighbourSearch<Dim>> search_;
};

}  // namespace

template <int Dim>
PointOperator<Dim>::PointOperator(const ParticleSet<Dim>& particles, const Ghosts<Dim>& ghosts,
                                  const Field<Dim>& points, const RowOptions& options,
                                  const std::vector<Index>& own)
    : particle_count_(particles.size()) {
  require_size("particle volumes", particles.volume.size(), particles.size());
  check(options);
  if (!own.empty()) {
    require_size("particles of points", static_cast<Eigen::Index>(own.size()), points.rows());
    check(own, particles.size());
  }
  const bool all_alike = particles.body.empty() && particles.spacing.size() == 0;
  const Surroundings<Dim> around(particles, ghosts);
  const Field<Dim>& extended = around.positions();

  constexpr double growth = 1.05;
  // Boundary points at two to a spacing are a multiple of this from the particles of a lattice.
  const double grid = 0.25 * options.spacing;
  const double round_off = difference_round_off<Dim>(extended);
  std::vector<Index> found;
  Eigen::Matrix<double, Dim, Eigen::Dynamic> offset;
  for (Eigen::Index c = 0; c < points.rows(); ++c) {
    const Vector<Dim> centre = points.row(c).transpose();
    const Index particle = !own.empty() ? own[static_cast<std::size_t>(c)]
                           : all_alike  ? 0
                                        : around.nearest(centre, options.support_radius);
    const double narrowest = support_radius_of(particles, particle, options);
    double radius = narrowest;
    const auto search_within = [&] {
      around.within(centre, radius, particle, found);
      offset.resize(Dim, static_cast<Eigen::Index>(found.size()));
      for (std::size_t k = 0; k < found.size(); ++k) {
        offset.col(static_cast<Eigen::Index>(k)) =
            snapped<Dim>(extended.row(found[k]).transpose() - centre, grid, round_off);
      }
    };
    search_within();
    while (!append_point(particles, ghosts, found, offset, radius, options)) {
      radius *= growth;
      if (radius > options.max_enlargement * narrowest) {
        throw PoorNeighbourhood("point " + std::to_string(c) + " at " +
                                    text_of<Dim>(points.row(c)) +
                                    " m has no well-conditioned neighbourhood within " +
                                    text_of(options.max_enlargement) + " support radii",
                                static_cast<Index>(c));
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
  check(particle, particles.size());
  for (std::size_t c = 0; c < particle.size(); ++c) {
    points.row(static_cast<Eigen::Index>(c)) = particles.position.row(particle[c]);
  }
  PointOperator result(particles, ghosts, points, options, particle);
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
