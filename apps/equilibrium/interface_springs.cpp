#include "equilibrium/interface_springs.hpp"

#include <Eigen/QR>
#include <stdexcept>
#include <vector>

#include "equilibrium/held_directions.hpp"

namespace equilibrium {
namespace {

// A column for each motion in which some plate is free: the gaps it makes in the springs, which are
// those of all points one after the other.
template <int Dim>
Eigen::MatrixXd motions_of_plates(const model::Model<Dim>& model, Eigen::Index springs) {
  Eigen::MatrixXd motions(springs, 0);
  Eigen::Index spring = 0;
  for (const model::Interface<Dim>& interface : model.interfaces) {
    constexpr int all = model::Plate<Dim>::motions;
    Eigen::MatrixXd of_plate = Eigen::MatrixXd::Zero(springs, all);
    for (fpm::Index c = 0; c < interface.faces.points.size(); ++c) {
      const auto directions = held_directions(interface, c);
      if (interface.plate) {
        const fpm::Vector<Dim> place = interface.faces.points.position.row(c).transpose();
        of_plate.middleRows(spring, directions.cols()) =
            directions.transpose() * interface.plate->modes(place);
      }
      spring += directions.cols();
    }
    for (int i = 0; interface.plate && i < all; ++i) {
      if (!interface.plate->free[static_cast<std::size_t>(i)]) continue;
      motions.conservativeResize(Eigen::NoChange, motions.cols() + 1);
      motions.rightCols(1) = of_plate.col(i);
    }
  }
  return motions;
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
  motions_ = motions_of_plates<Dim>(model, rows);
  if (motions_.cols() == 0) return;
  response_ = factor_->solve(motions_);
  release_ = (motions_.transpose() * response_).completeOrthogonalDecomposition().pseudoInverse();
}

template <int Dim>
void InterfaceSprings<Dim>::correct(Eigen::VectorXd& z) {
  gaps_.noalias() = gap_ * z;
  gaps_ = factor_->solve(gaps_);
  if (motions_.cols() > 0) gaps_ -= response_ * (release_ * (motions_.transpose() * gaps_));
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
