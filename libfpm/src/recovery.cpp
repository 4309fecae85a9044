#include "fpm/recovery.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fpm/threads.hpp"

namespace fpm {
namespace {

template <int Dim>
std::vector<GhostPlane<Dim>> mirrors_among(const std::vector<GhostPlane<Dim>>& planes) {
  std::vector<GhostPlane<Dim>> mirrors;
  std::copy_if(planes.begin(), planes.end(), std::back_inserter(mirrors),
               [](const GhostPlane<Dim>& plane) { return plane.symmetry; });
  return mirrors;
}

/// A particle or a mirror image of one.
template <int Dim>
struct Member {
  Vector<Dim> position;
  double volume;
  double value;
  Index body;
};

// [m] Radius of a particle's neighbourhood: the options' is that of the finest spacing.
template <int Dim>
Eigen::VectorXd radii(const ParticleSet<Dim>& particles, double radius) {
  if (particles.spacing.size() == 0) {
    return Eigen::VectorXd::Constant(particles.size(), radius);
  }
  require_size("spacings", particles.spacing.size(), particles.size());
  return radius * (particles.spacing / particles.spacing.minCoeff());
}

/// Members sorted into the cells of a grid, for one pass over each neighbourhood of a radius known
/// beforehand: there is no list to be made, as a search in a tree would.
template <int Dim>
class Grid {
 public:
  Grid(std::vector<Member<Dim>> members, double radius) : members_(std::move(members)) {
    lower_.setConstant(std::numeric_limits<double>::infinity());
    Vector<Dim> upper = -lower_;
    for (const auto& m : members_) {
      lower_ = lower_.cwiseMin(m.position);
      upper = upper.cwiseMax(m.position);
    }
    // Half a radius; wider where a particle far off would ask for more cells than there are
    // members.
    cell_ = 0.5 * radius;
    const double most = 8.0 * static_cast<double>(members_.size()) + 64.0;
    const auto counted = [&] {
      return (((upper - lower_) / cell_).array().floor() + 1.0).matrix().eval();
    };
    while (counted().prod() > most) cell_ *= 2.0;
    count_ = counted().template cast<Index>();
    std::vector<Index> cell(members_.size()), order(members_.size());
    for (std::size_t k = 0; k < cell.size(); ++k) cell[k] = flat(place(members_[k].position));
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](Index k) { return cell[static_cast<std::size_t>(k)]; });
    begin_.assign(static_cast<std::size_t>(count_.prod()) + 1, 0);
    for (const Index c : cell) ++begin_[static_cast<std::size_t>(c) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<Member<Dim>> sorted;
    sorted.reserve(members_.size());
    for (const Index k : order) sorted.push_back(members_[static_cast<std::size_t>(k)]);
    members_ = std::move(sorted);
  }

  /// Every member of the cells that a ball touches, in an order that the members alone decide.
  template <class Visitor>
  void around(const Vector<Dim>& centre, double radius, Visitor&& visit) const {
    const Place low = place(centre.array() - radius), high = place(centre.array() + radius);
    const Index last_layer = Dim == 3 ? high[Dim - 1] : 0;
    for (Index z = Dim == 3 ? low[Dim - 1] : 0; z <= last_layer; ++z) {
      for (Index y = low[1]; y <= high[1]; ++y) {
        Place first = low, last = high;
        first[1] = last[1] = y;
        if constexpr (Dim == 3) first[2] = last[2] = z;
        // The cells of a line along x lie one behind the other.
        const auto end = begin_[static_cast<std::size_t>(flat(last)) + 1];
        for (auto k = begin_[static_cast<std::size_t>(flat(first))]; k < end; ++k) {
          visit(members_[static_cast<std::size_t>(k)]);
        }
      }
    }
  }

 private:
  using Place = Eigen::Matrix<Index, Dim, 1>;

  Place place(const Vector<Dim>& x) const {
    Place p;
    for (int i = 0; i < Dim; ++i) {
      const double at = std::floor((x[i] - lower_[i]) / cell_);
      p[i] = static_cast<Index>(std::clamp(at, 0.0, static_cast<double>(count_[i] - 1)));
    }
    return p;
  }
  Index flat(const Place& p) const {
    Index k = p[Dim - 1];
    for (int i = Dim - 2; i >= 0; --i) k = k * count_[i] + p[i];
    return k;
  }

  std::vector<Member<Dim>> members_;
  Vector<Dim> lower_;
  double cell_ = 0.0;
  Place count_;
  std::vector<Index> begin_;
};

template <int Dim>
std::vector<Member<Dim>> members_of(const ParticleSet<Dim>& particles,
                                    const Eigen::Ref<const Eigen::VectorXd>& field,
                                    const std::vector<GhostPlane<Dim>>& planes, double reach) {
  const Ghosts<Dim> images(particles.position, mirrors_among(planes), reach);
  const Index n = particles.size();
  Field<Dim> position(n + images.size(), Dim);
  position.topRows(n) = particles.position;
  images.extend_positions(position.data(), n, position.rows());
  std::vector<Member<Dim>> members;
  members.reserve(static_cast<std::size_t>(position.rows()));
  for (Index b = 0; b < static_cast<Index>(position.rows()); ++b) {
    const Index source = b < n ? b : images.source(b - n);
    members.push_back(
        {position.row(b).transpose(), particles.volume[source], field[source],
         particles.body.empty() ? 0 : particles.body[static_cast<std::size_t>(source)]});
  }
  return members;
}

// Measured from the particle's own place and value, so that a constant is kept to the last bit;
// directions without extent are left out of the fit.
template <int Dim>
double fitted(const Grid<Dim>& grid, const Member<Dim>& own, Kernel kernel, double radius) {
  double total = 0.0, mean = 0.0;
  Vector<Dim> centre = Vector<Dim>::Zero(), moment = Vector<Dim>::Zero();
  Tensor<Dim> spread = Tensor<Dim>::Zero();
  const double square = radius * radius;
  grid.around(own.position, radius, [&](const Member<Dim>& other) {
    const Vector<Dim> x = other.position - own.position;
    const double distance = x.squaredNorm();
    if (distance >= square || other.body != own.body) return;
    const double weight = other.volume * evaluate(kernel, std::sqrt(distance), radius).value;
    const double difference = other.value - own.value;
    total += weight;
    mean += weight * difference;
    centre += weight * x;
    moment += (weight * difference) * x;
    spread += (weight * x) * x.transpose();
  });
  mean /= total;
  centre /= total;
  moment = moment / total - mean * centre;
  spread = spread / total - centre * centre.transpose();
  const Eigen::SelfAdjointEigenSolver<Tensor<Dim>> axes(spread);
  constexpr double no_extent = 0.01;  // of the particle's own, squared
  const double least = no_extent * std::pow(own.volume, 2.0 / Dim);
  double value = own.value + mean;
  for (int i = 0; i < Dim; ++i) {
    if (axes.eigenvalues()[i] < least) continue;
    const Vector<Dim> axis = axes.eigenvectors().col(i);
    value -= axis.dot(moment) * axis.dot(centre) / axes.eigenvalues()[i];
  }
  return value;
}

}  // namespace

template <int Dim>
Eigen::VectorXd recover(const ParticleSet<Dim>& particles,
                        const Eigen::Ref<const Eigen::VectorXd>& field,
                        const std::vector<GhostPlane<Dim>>& planes,
                        const RecoveryOptions& options) {
  require_size("particle volumes", particles.volume.size(), particles.size());
  require_size("field to recover", field.size(), particles.size());
  if (!particles.body.empty()) {
    require_size("bodies", static_cast<Eigen::Index>(particles.body.size()), particles.size());
  }
  if (!(options.radius > 0.0)) throw std::invalid_argument("the radius must be positive");
  if (particles.size() == 0) return {};
  const Eigen::VectorXd radius = radii(particles, options.radius);
  const auto members = members_of(particles, field, planes, radius.maxCoeff());
  const Grid<Dim> grid(members, options.radius);
  Eigen::VectorXd recovered(particles.size());
  constexpr Index per_block = 32;
  for_each_row(particles.size(), per_block, [&](Index a) {
    recovered[a] = fitted(grid, members[static_cast<std::size_t>(a)], options.kernel, radius[a]);
  });
  return recovered;
}

template Eigen::VectorXd recover<2>(const ParticleSet<2>&, const Eigen::Ref<const Eigen::VectorXd>&,
                                    const std::vector<GhostPlane<2>>&, const RecoveryOptions&);
template Eigen::VectorXd recover<3>(const ParticleSet<3>&, const Eigen::Ref<const Eigen::VectorXd>&,
                                    const std::vector<GhostPlane<3>>&, const RecoveryOptions&);

}  // namespace fpm
