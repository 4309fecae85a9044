#include "limit/solver/augmented_system.hpp"

namespace limit::solver {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using second_order_cone::Scaling;

namespace {

// Makes up for equations that depend on each other, as a lower bound's do; iterative refinement
// takes it out again.
constexpr double least = 1e-10;

Matrix3d root_of(const Scaling& scaling, const Vector3d& form) {
  Matrix3d root = Matrix3d::Zero();
  if (form[0] > 0.0) {
    for (Index j = 0; j < 3; ++j) root.col(j) = scaling.times(Vector3d::Unit(j));
    return form.cwiseInverse().asDiagonal() * root;
  }
  root(0, 0) = 1.0;
  root.bottomRightCorner<2, 2>() = scaling.disc_root();
  return root;
}

}  // namespace

AugmentedSystem::AugmentedSystem(const ScaledProgram& program, const std::vector<ConeBlock>& blocks)
    : program_(program), blocks_(blocks), roots_(program.cones.size()) {
  const auto size = static_cast<int>(program.equations.cols());
  const int all = size + static_cast<int>(program.equations.rows());
  std::vector<int> rows, columns;
  for (int i = 0; i < all; ++i) {
    rows.push_back(i);
    columns.push_back(i);
  }
  for (const ConeBlock& block : blocks) {
    for (Index j = 0; j < block.coefficients.cols(); ++j) {
      for (const Index row : block.rows) {
        rows.push_back(size + static_cast<int>(row));
        columns.push_back(static_cast<int>(block.first + j));
      }
    }
  }
  values_.resize(rows.size());
  factors_ = std::make_unique<SparseFactors>(SparseFactors::Kind::indefinite, all, rows, columns);
}

bool AugmentedSystem::factorise(const std::vector<Scaling>& scalings) {
  const auto size = static_cast<std::size_t>(program_.equations.cols());
  const std::size_t all = size + static_cast<std::size_t>(program_.equations.rows());
  std::fill_n(values_.begin(), size, 1.0);
  std::fill_n(values_.begin() + static_cast<std::ptrdiff_t>(size), all - size, -least);
  auto entry = values_.begin() + static_cast<std::ptrdiff_t>(all);
  for (std::size_t q = 0; q < blocks_.size(); ++q) {
    const ConeBlock& block = blocks_[q];
    Eigen::MatrixXd coefficients = block.coefficients;
    const auto first = static_cast<std::size_t>(block.first);
    if (q < roots_.size()) {
      const Vector3d form = slack_form(program_.cones[q]);
      roots_[q] = root_of(scalings[q], form);
      coefficients *= roots_[q];
      if (form[0] == 0.0) values_[first] = 0.0;
    } else {
      values_[first] = 0.0;
    }
    for (const double value : coefficients.reshaped()) *entry++ = value;
  }
  return factors_->factorise(values_);
}

NewtonSolution AugmentedSystem::solve(const VectorXd& first, const VectorXd& second) const {
  VectorXd all = VectorXd::Zero(first.size() + second.size());
  all.tail(second.size()) = second;
  const auto cones = static_cast<Index>(roots_.size());
  for (Index k = 0; k < cones; ++k) {
    all.segment<3>(3 * k) =
        roots_[static_cast<std::size_t>(k)].transpose() * first.segment<3>(3 * k);
  }
  for (std::size_t q = roots_.size(); q < blocks_.size(); ++q) {
    all[blocks_[q].first] = first[blocks_[q].first];
  }
  factors_->solve(all);
  NewtonSolution solution{all.head(first.size()), all.tail(second.size())};
  for (Index k = 0; k < cones; ++k) {
    solution.x.segment<3>(3 * k) = roots_[static_cast<std::size_t>(k)] * all.segment<3>(3 * k);
  }
  return solution;
}

}  // namespace limit::solver
