#include "equilibrium/interface_springs.hpp"

#include <stdexcept>
#include <vector>

namespace equilibrium {
namespace {

// The directions in which a point is held, columns: across the face, then along it if it sticks.
template <int Dim>
Eigen::Matrix<double, Dim, Eigen::Dynamic> held_directions(const model::Interface<Dim>& interface,
                                                           fpm::Index point) {
  const fpm::Vector<Dim> normal = interface.faces.points.normal.row(point).transpose();
  if (!constitutive::sticks(interface.law)) return normal;
  return normal.householderQr().householderQ();
}

}  // namespace

template <int Dim>
InterfaceSprings<Dim>::InterfaceSprings(const model::Model<Dim>& model,
                                        const Blocks& block_inverse) {
  const Eigen::Index n = model.size();
  std::vector<Eigen::Triplet<double>> gaps;
  std::vector<double> compliance;
  for (const model::Interface<Dim>& interface : model.interfaces) {
    for (fpm::Index c = 0; c < interface.faces.points.size(); ++c) {
      const auto directions = held_directions(interface, c);
      const double stiffness = interface.stiffness[c] * interface.faces.points.weight[c];
      for (Eigen::Index d = 0; d < directions.cols(); ++d) {
        const auto row = static_cast<Eigen::Index>(compliance.size());
        const auto add = [&](double side) {
          return [&, side](fpm::Index a, double value, const fpm::Vector<Dim>& sign) {
            for (int i = 0; i < Dim; ++i) {
              const Eigen::Index k = i * n + a;
              const double entry = side * value * sign[i] * directions(i, d);
              if (entry == 0.0 || model.prescribed[static_cast<std::size_t>(k)] != 0) continue;
              gaps.emplace_back(row, k, entry);
            }
          };
        };
        interface.faces.first.for_each_value(c, add(-1.0));
        if (!interface.is_rigid()) interface.faces.second.for_each_value(c, add(1.0));
        compliance.push_back(1.0 / (d > 0 ? interface.law.shear_stiffness * stiffness : stiffness));
      }
    }
  }
  const auto rows = static_cast<Eigen::Index>(compliance.size());
  gap_.resize(rows, n * Dim);
  gap_.setFromTriplets(gaps.begin(), gaps.end());

  std::vector<Eigen::Triplet<double>> blocks;
  for (Eigen::Index a = 0; a < n; ++a) {
    const Eigen::Map<const fpm::Tensor<Dim>> inverse(block_inverse.col(a).data());
    for (int i = 0; i < Dim; ++i) {
      for (int j = 0; j < Dim; ++j) blocks.emplace_back(i * n + a, j * n + a, inverse(i, j));
    }
  }
  Sparse inverse(n * Dim, n * Dim);
  inverse.setFromTriplets(blocks.begin(), blocks.end());
  spread_ = inverse * Sparse(gap_.transpose());

  Eigen::SparseMatrix<double> flexibility = gap_ * spread_;
  for (Eigen::Index k = 0; k < rows; ++k) {
    flexibility.coeffRef(k, k) += compliance[static_cast<std::size_t>(k)];
  }
  auto factor = std::make_shared<Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>>(flexibility);
  if (factor->info() != Eigen::Success) {
    throw std::runtime_error("the springs of the interfaces could not be factorised");
  }
  factor_ = std::move(factor);
  gaps_.resize(rows);
}

template <int Dim>
void InterfaceSprings<Dim>::correct(Eigen::VectorXd& z) {
  gaps_.noalias() = gap_ * z;
  gaps_ = factor_->solve(gaps_);
  z.noalias() -= spread_ * gaps_;
}

template <int Dim>
std::size_t InterfaceSprings<Dim>::bytes() const {
  if (empty()) return 0;
  constexpr std::size_t entry = sizeof(double) + sizeof(int);
  const auto entries =
      gap_.nonZeros() + spread_.nonZeros() + factor_->matrixL().nestedExpression().nonZeros();
  return entry * static_cast<std::size_t>(entries);
}

template class InterfaceSprings<2>;
template class InterfaceSprings<3>;

}  // namespace equilibrium
