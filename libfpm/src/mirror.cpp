#include "fpm/mirror.hpp"

namespace fpm {

template <int Dim>
MirrorGhosts<Dim>::MirrorGhosts(const Field<Dim>& position,
                                const std::vector<SymmetryPlane>& planes, double reach) {
  constexpr double on_plane = 1e-9;
  for (const SymmetryPlane& plane : planes) {
    if (plane.axis < 0 || plane.axis >= Dim) {
      throw std::invalid_argument("symmetry plane: axis " + std::to_string(plane.axis) +
                                  " in a space of dimension " + std::to_string(Dim));
    }
    const auto image = [&](Index source, const Vector<Dim>& sign, const Vector<Dim>& offset) {
      const double x = sign[plane.axis] * position(source, plane.axis) + offset[plane.axis];
      const double distance = std::abs(x - plane.position);
      if (distance >= reach || distance <= on_plane * reach) return;
      source_.push_back(source);
      sign_.push_back(sign);
      sign_.back()[plane.axis] = -sign[plane.axis];
      offset_.push_back(offset);
      offset_.back()[plane.axis] = 2.0 * plane.position - offset[plane.axis];
    };
    const std::size_t before = source_.size();
    for (Index a = 0; a < position.rows(); ++a) {
      image(a, Vector<Dim>::Ones(), Vector<Dim>::Zero());
    }
    for (std::size_t g = 0; g < before; ++g) {
      image(source_[g], Vector<Dim>(sign_[g]), Vector<Dim>(offset_[g]));
    }
  }
}

template <int Dim>
void MirrorGhosts<Dim>::extend_positions(double* extended, Eigen::Index n,
                                         Eigen::Index stride) const {
  for (Index g = 0; g < size(); ++g) {
    const auto k = static_cast<std::size_t>(g);
    for (int i = 0; i < Dim; ++i) {
      extended[i * stride + n + g] =
          sign_[k][i] * extended[i * stride + source_[k]] + offset_[k][i];
    }
  }
}

template <int Dim>
void MirrorGhosts<Dim>::extend_vectors(double* extended, Eigen::Index n,
                                       Eigen::Index stride) const {
  for (Index g = 0; g < size(); ++g) {
    const auto k = static_cast<std::size_t>(g);
    for (int i = 0; i < Dim; ++i) {
      extended[i * stride + n + g] = sign_[k][i] * extended[i * stride + source_[k]];
    }
  }
}

template <int Dim>
void MirrorGhosts<Dim>::fold_forces(double* extended, Eigen::Index n, Eigen::Index stride) const {
  for (Index g = 0; g < size(); ++g) {
    const auto k = static_cast<std::size_t>(g);
    for (int i = 0; i < Dim; ++i) {
      extended[i * stride + source_[k]] += sign_[k][i] * extended[i * stride + n + g];
    }
  }
}

template class MirrorGhosts<2>;
template class MirrorGhosts<3>;

}  // namespace fpm
