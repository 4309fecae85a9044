#include "fpm/ghosts.hpp"

#include <set>
#include <stdexcept>
#include <string>

namespace fpm {

template <int Dim>
GhostPlane<Dim> symmetry_plane(int axis, double position) {
  GhostPlane<Dim> plane;
  plane.axis = axis;
  plane.position = position;
  plane.symmetry = true;
  if (axis >= 0 && axis < Dim) plane.held[static_cast<std::size_t>(axis)] = true;
  return plane;
}

template <int Dim>
Ghosts<Dim>::Ghosts(const Field<Dim>& position, const std::vector<GhostPlane<Dim>>& planes,
                    const Eigen::VectorXd& reach)
    : planes_(planes) {
  require_size("reaches", reach.size(), position.rows());
  constexpr double round_off = 1e-9;
  slack_ = reach.size() > 0 ? round_off * reach.minCoeff() : 0.0;
  // Where a ghost is, by reflection alone: reflected * position of its source + shift.
  std::vector<Vector<Dim>> reflected, shift;
  for (std::size_t p = 0; p < planes.size(); ++p) {
    const GhostPlane<Dim>& plane = planes[p];
    const int axis = plane.axis;
    if (axis < 0 || axis >= Dim) {
      throw std::invalid_argument("plane of images: axis " + std::to_string(axis) +
                                  " in a space of dimension " + std::to_string(Dim));
    }
    Vector<Dim> turn, factor;
    for (int i = 0; i < Dim; ++i) {
      const bool held = plane.held[static_cast<std::size_t>(i)];
      turn[i] = held ? -1.0 : 1.0;
      factor[i] = held ? 2.0 : 0.0;
    }
    // The image of a particle, or of the ghost `parent`.
    const auto image = [&](Index source, const Vector<Dim>& sign, const Vector<Dim>& flip,
                           const Vector<Dim>& moved, Index parent) {
      const Vector<Dim> x = flip.cwiseProduct(position.row(source).transpose()) + moved;
      const double distance = std::abs(x[axis] - plane.position);
      if (distance >= reach[source] || distance <= slack_ ||
          !within(plane, x, Vector<Dim>::Zero())) {
        return;
      }
      source_.push_back(source);
      sign_.push_back(turn.cwiseProduct(sign));
      reflected.push_back(flip);
      reflected.back()[axis] = -flip[axis];
      shift.push_back(moved);
      shift.back()[axis] = 2.0 * plane.position - moved[axis];
      if (parent >= 0) {
        for (std::size_t k = share_begin_[static_cast<std::size_t>(parent)];
             k < share_begin_[static_cast<std::size_t>(parent) + 1]; ++k) {
          const Share inherited = share_[k];
          share_.push_back({inherited.plane, turn.cwiseProduct(inherited.factor), inherited.side});
        }
      }
      share_.push_back({p, factor, x[axis] < plane.position ? -1.0 : 1.0});
      share_begin_.push_back(share_.size());
    };
    const auto before = size();
    for (Index a = 0; a < position.rows(); ++a) {
      image(a, Vector<Dim>::Ones(), Vector<Dim>::Ones(), Vector<Dim>::Zero(), -1);
    }
    for (Index g = 0; g < before; ++g) {
      const auto k = static_cast<std::size_t>(g);
      image(source_[k], Vector<Dim>(sign_[k]), Vector<Dim>(reflected[k]), Vector<Dim>(shift[k]), g);
    }
  }
  // A ghost moves by its signs from where reflection puts it.
  offset_ = std::move(shift);
  for (Index g = 0; g < size(); ++g) {
    const auto k = static_cast<std::size_t>(g);
    const Vector<Dim> turned = reflected[k] - sign_[k];
    offset_[k] += turned.cwiseProduct(position.row(source_[k]).transpose());
  }
}

template <int Dim>
std::span<const typename Ghosts<Dim>::Share> Ghosts<Dim>::shares(Index g) const {
  const std::size_t begin = share_begin_[static_cast<std::size_t>(g)];
  return {share_.data() + begin, share_begin_[static_cast<std::size_t>(g) + 1] - begin};
}

template <int Dim>
bool Ghosts<Dim>::within(const GhostPlane<Dim>& plane, const Vector<Dim>& x,
                         const Vector<Dim>& motion) const {
  for (int i = 0; i < Dim; ++i) {
    if (i == plane.axis) continue;
    const double at = x[i] - motion[i];
    if (at < plane.range_min[i] - slack_ || at > plane.range_max[i] + slack_) return false;
  }
  return true;
}

template <int Dim>
std::vector<Index> Ghosts<Dim>::sources_of(std::size_t plane) const {
  std::set<Index> sources;
  for (Index g = 0; g < size(); ++g) {
    for (const Share& share : shares(g)) {
      if (share.plane == plane) sources.insert(source(g));
    }
  }
  return {sources.begin(), sources.end()};
}

template <int Dim>
bool Ghosts<Dim>::by_symmetry(Index g) const {
  for (const Share& share : shares(g)) {
    if (!planes_[share.plane].symmetry) return false;
  }
  return true;
}

template <int Dim>
bool Ghosts<Dim>::made_by(Index g, const std::vector<char>& some) const {
  return std::ranges::all_of(shares(g), [&](const Share& share) { return some[share.plane] != 0; });
}

template <int Dim>
bool Ghosts<Dim>::visible_from(const Vector<Dim>& x, Index g,
                               const std::vector<Vector<Dim>>& motion) const {
  for (const Share& share : shares(g)) {
    const Vector<Dim> moved = motion.empty() ? Vector<Dim>::Zero() : motion[share.plane];
    if (!within(planes_[share.plane], x, moved)) return false;
  }
  return true;
}

template <int Dim>
bool Ghosts<Dim>::stands_for(const Vector<Dim>& x, Index g,
                             const std::vector<Vector<Dim>>& motion) const {
  for (const Share& share : shares(g)) {
    const GhostPlane<Dim>& plane = planes_[share.plane];
    if (!plane.has_range()) continue;
    const Vector<Dim> moved = motion.empty() ? Vector<Dim>::Zero() : motion[share.plane];
    const double beyond = x[plane.axis] - plane.position - moved[plane.axis];
    if (beyond * share.side <= 0.0 || !within(plane, x, moved)) return false;
  }
  return true;
}

template <int Dim>
Field<Dim> Ghosts<Dim>::of_motion(const std::vector<Vector<Dim>>& motion) const {
  require_size("motions of planes", static_cast<Eigen::Index>(motion.size()),
               static_cast<Eigen::Index>(planes_.size()));
  Field<Dim> moved = Field<Dim>::Zero(size(), Dim);
  for (Index g = 0; g < size(); ++g) {
    for (const Share& share : shares(g)) {
      moved.row(g) += share.factor.cwiseProduct(motion[share.plane]).transpose();
    }
  }
  return moved;
}

template <int Dim>
void Ghosts<Dim>::plane_forces(const double* extended, Eigen::Index n, Eigen::Index stride,
                               std::vector<Vector<Dim>>& force) const {
  force.assign(planes_.size(), Vector<Dim>::Zero());
  for (Index g = 0; g < size(); ++g) {
    for (const Share& share : shares(g)) {
      for (int i = 0; i < Dim; ++i) {
        force[share.plane][i] += share.factor[i] * extended[i * stride + n + g];
      }
    }
  }
}

template <int Dim>
void Ghosts<Dim>::add_reactions(std::size_t plane, const double* extended, Eigen::Index n,
                                Eigen::Index stride, Field<Dim>& reaction) const {
  for (Index g = 0; g < size(); ++g) {
    for (const Share& share : shares(g)) {
      if (share.plane != plane) continue;
      for (int i = 0; i < Dim; ++i) {
        reaction(source(g), i) += share.factor[i] * extended[i * stride + n + g];
      }
    }
  }
}

template <int Dim>
void Ghosts<Dim>::extend_positions(double* extended, Eigen::Index n, Eigen::Index stride) const {
  for (Index g = 0; g < size(); ++g) {
    const auto k = static_cast<std::size_t>(g);
    for (int i = 0; i < Dim; ++i) {
      extended[i * stride + n + g] =
          sign_[k][i] * extended[i * stride + source_[k]] + offset_[k][i];
    }
  }
}

template <int Dim>
void Ghosts<Dim>::extend_vectors(double* extended, Eigen::Index n, Eigen::Index stride) const {
  for (Index g = 0; g < size(); ++g) {
    const auto k = static_cast<std::size_t>(g);
    for (int i = 0; i < Dim; ++i) {
      extended[i * stride + n + g] = sign_[k][i] * extended[i * stride + source_[k]];
    }
  }
}

template <int Dim>
void Ghosts<Dim>::fold_forces(double* extended, Eigen::Index n, Eigen::Index stride) const {
  for (Index g = 0; g < size(); ++g) {
    const auto k = static_cast<std::size_t>(g);
    for (int i = 0; i < Dim; ++i) {
      extended[i * stride + source_[k]] += sign_[k][i] * extended[i * stride + n + g];
    }
  }
}

template GhostPlane<2> symmetry_plane<2>(int, double);
template GhostPlane<3> symmetry_plane<3>(int, double);
template class Ghosts<2>;
template class Ghosts<3>;

}  // namespace fpm
