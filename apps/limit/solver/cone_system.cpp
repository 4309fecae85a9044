#include "limit/solver/cone_system.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace limit::solver {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using second_order_cone::Scaling;

namespace {

// Curvature given to free variables, and to the mean stress of soil of little friction: small
// against the cones', which are of order one at first.
constexpr double little = 1e-8;
// Added to the diagonal of A H^-1 A', in all and as a share of each entry: makes up for equations
// that depend on each other, as a lower bound's do, whose pivots are nothing but rounding. The
// share is that of rounding, too: the mean stresses of clay, free as they are, make entries of 1 /
// little, beside which a larger one would outweigh what stiffness is left, and the solution be
// lost.
constexpr double least = 1e-10, least_share = 1e-15;

// What may be left of the equations: less than the 1e-8 that end an interior point's descent.
constexpr double enough = 3e-9;

// Sine of a few degrees: below, the mean stress has hardly any curvature of its own.
constexpr double little_friction = 0.1;

// Of the curvature with `little` added in the mean stress. By the mean stress' complement, so that
// nothing cancels.
Matrix3d softened_inverse(const Scaling& scaling, double slope) {
  const Vector3d first = scaling.squared().col(0);
  const double mean = first[0] / (slope * slope);
  const double softened = mean / (1.0 + little * mean);
  const Eigen::Vector2d along = slope / first[0] * first.tail<2>();
  Matrix3d inverse;
  inverse(0, 0) = softened;
  inverse.bottomLeftCorner<2, 1>() = softened * along;
  inverse.topRightCorner<1, 2>() = softened * along.transpose();
  inverse.bottomRightCorner<2, 2>() = scaling.disc_inverse() + softened * along * along.transpose();
  return inverse;
}

}  // namespace

ConeSystem::ConeSystem(const ScaledProgram& program) : program_(program) {
  gather_blocks();
  set_border_apart();
  find_entries();
  curvature_.resize(program.cones.size());
  inverse_.resize(program.cones.size());
}

void ConeSystem::gather_blocks() {
  const Eigen::SparseMatrix<double> by_column = program_.equations;
  const auto cones = static_cast<Index>(program_.cones.size());
  for (Index first = 0; first < by_column.cols();) {
    const Index width = first < 3 * cones ? 3 : 1;
    ConeBlock block;
    block.first = first;
    for (Index j = first; j < first + width; ++j) {
      for (Eigen::SparseMatrix<double>::InnerIterator entry(by_column, j); entry; ++entry) {
        block.rows.push_back(entry.row());
      }
    }
    std::sort(block.rows.begin(), block.rows.end());
    block.rows.erase(std::unique(block.rows.begin(), block.rows.end()), block.rows.end());
    block.coefficients.setZero(static_cast<Index>(block.rows.size()), width);
    for (Index j = first; j < first + width; ++j) {
      for (Eigen::SparseMatrix<double>::InnerIterator entry(by_column, j); entry; ++entry) {
        const auto at = std::lower_bound(block.rows.begin(), block.rows.end(), entry.row());
        block.coefficients(at - block.rows.begin(), j - first) = entry.value();
      }
    }
    blocks_.push_back(std::move(block));
    first += width;
  }
}

void ConeSystem::set_border_apart() {
  constexpr double few = 100.0, small_share = 0.02;  // of the equations
  const double most = std::max(few, small_share * static_cast<double>(program_.equations.rows()));
  const auto free = blocks_.begin() + static_cast<std::ptrdiff_t>(program_.cones.size());
  const auto border = std::stable_partition(free, blocks_.end(), [&](const ConeBlock& block) {
    return static_cast<double>(block.rows.size()) <= most;
  });
  border_columns_.setZero(program_.equations.rows(), blocks_.end() - border);
  for (auto block = border; block != blocks_.end(); ++block) {
    for (std::size_t i = 0; i < block->rows.size(); ++i) {
      border_columns_(block->rows[i], block - border) =
          block->coefficients(static_cast<Index>(i), 0);
    }
    border_.push_back(block->first);
  }
  blocks_.erase(border, blocks_.end());
}

void ConeSystem::find_entries() {
  const auto size = static_cast<int>(program_.equations.rows());
  std::vector<std::pair<int, int>> pattern;
  const auto for_pairs = [&](const ConeBlock& block, const auto& what) {
    for (std::size_t i = 0; i < block.rows.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        what(std::pair(static_cast<int>(block.rows[i]), static_cast<int>(block.rows[j])));
      }
    }
  };
  for (int i = 0; i < size; ++i) pattern.emplace_back(i, i);
  for (const ConeBlock& block : blocks_) {
    for_pairs(block, [&](const auto& pair) { pattern.push_back(pair); });
  }
  std::sort(pattern.begin(), pattern.end());
  pattern.erase(std::unique(pattern.begin(), pattern.end()), pattern.end());
  const auto entry = [&](const std::pair<int, int>& pair) {
    return static_cast<std::size_t>(std::lower_bound(pattern.begin(), pattern.end(), pair) -
                                    pattern.begin());
  };
  for (int i = 0; i < size; ++i) diagonal_.push_back(entry({i, i}));
  for (ConeBlock& block : blocks_) {
    for_pairs(block, [&](const auto& pair) { block.entries.push_back(entry(pair)); });
  }
  std::vector<int> rows, columns;
  for (const auto& [row, column] : pattern) {
    rows.push_back(row);
    columns.push_back(column);
  }
  values_.resize(pattern.size());
  factors_ =
      std::make_unique<SparseFactors>(SparseFactors::Kind::positive_definite, size, rows, columns);
}

bool ConeSystem::factorise(const std::vector<Scaling>& scalings) {
  scalings_ = &scalings;
  if (!condense(scalings)) return augmented_ == nullptr && switch_to_augmented();
  solve_border();
  return true;
}

bool ConeSystem::switch_to_augmented() {
  augmented_ = std::make_unique<AugmentedSystem>(program_, blocks_);
  if (!augmented_->factorise(*scalings_)) return false;
  solve_border();
  return true;
}

bool ConeSystem::condense(const std::vector<Scaling>& scalings) {
  for (std::size_t k = 0; k < scalings.size(); ++k) {
    Matrix3d& inverse = inverse_[k];
    const Vector3d form = slack_form(program_.cones[k]);
    if (form[0] > 0.0) {
      curvature_[k] = form.asDiagonal() * scalings[k].inverse_squared() * form.asDiagonal();
      if (form[0] < little_friction) {
        inverse = softened_inverse(scalings[k], form[0]);
      } else {
        const Vector3d back = form.cwiseInverse();
        inverse = back.asDiagonal() * scalings[k].squared() * back.asDiagonal();
      }
    } else {
      curvature_[k].setZero();
      curvature_[k].bottomRightCorner<2, 2>() =
          scalings[k].inverse_squared().bottomRightCorner<2, 2>();
      inverse.setZero();
      inverse(0, 0) = 1.0 / little;
      inverse.bottomRightCorner<2, 2>() = scalings[k].disc_inverse();
    }
  }
  if (augmented_) return augmented_->factorise(scalings);
  std::fill(values_.begin(), values_.end(), 0.0);
  Eigen::MatrixXd softened;
  for (std::size_t q = 0; q < blocks_.size(); ++q) {
    const ConeBlock& block = blocks_[q];
    if (q < inverse_.size()) {
      softened.noalias() = block.coefficients * inverse_[q];
    } else {
      softened = block.coefficients / little;
    }
    auto entry = block.entries.begin();
    for (Index i = 0; i < block.coefficients.rows(); ++i) {
      for (Index j = 0; j <= i; ++j) {
        values_[*entry++] += softened.row(i).dot(block.coefficients.row(j));
      }
    }
  }
  for (const std::size_t entry : diagonal_) values_[entry] += least + least_share * values_[entry];
  return factors_->factorise(values_);
}

void ConeSystem::solve_border() {
  const VectorXd none = VectorXd::Zero(program_.equations.cols());
  border_solved_.resizeLike(border_columns_);
  for (Index j = 0; j < border_solved_.cols(); ++j) {
    border_solved_.col(j) = multipliers(none, -border_columns_.col(j));
  }
  if (!border_.empty()) border_part_.compute(border_columns_.transpose() * border_solved_);
}

VectorXd ConeSystem::curve(const VectorXd& x) const {
  VectorXd result = VectorXd::Zero(x.size());
  for (std::size_t k = 0; k < curvature_.size(); ++k) {
    const auto at = static_cast<Index>(3 * k);
    result.segment<3>(at) = curvature_[k] * x.segment<3>(at);
  }
  return result;
}

VectorXd ConeSystem::uncurve(const VectorXd& x) const {
  VectorXd result = x / little;
  for (std::size_t k = 0; k < inverse_.size(); ++k) {
    const auto at = static_cast<Index>(3 * k);
    result.segment<3>(at) = inverse_[k] * x.segment<3>(at);
  }
  for (const Index variable : border_) result[variable] = 0.0;
  return result;
}

VectorXd ConeSystem::multipliers(const VectorXd& first, const VectorXd& second) const {
  if (augmented_) return augmented_->solve(first, second).y;
  VectorXd y = program_.equations * uncurve(first) - second;
  factors_->solve(y);
  return y;
}

ConeSystem::Solution ConeSystem::solve_once(const VectorXd& first, const VectorXd& second) const {
  VectorXd y = multipliers(first, second);
  VectorXd border(static_cast<Index>(border_.size()));
  for (Index j = 0; j < border.size(); ++j) border[j] = first[border_[static_cast<std::size_t>(j)]];
  if (border.size() > 0) {
    border = border_part_.solve(border - border_columns_.transpose() * y);
    y += border_solved_ * border;
  }
  Solution solution;
  if (augmented_) {
    solution = augmented_->solve(first, second - border_columns_ * border);
  } else {
    solution.x = uncurve(first - program_.equations.transpose() * y);
    solution.y = std::move(y);
  }
  for (Index j = 0; j < border.size(); ++j) {
    solution.x[border_[static_cast<std::size_t>(j)]] = border[j];
  }
  return solution;
}

ConeSystem::Solution ConeSystem::left(const VectorXd& first, const VectorXd& second,
                                      const Solution& at) const {
  return {first - curve(at.x) - program_.equations.transpose() * at.y,
          second - program_.equations * at.x};
}

VectorXd ConeSystem::stiffness() const {
  VectorXd result = VectorXd::Ones(program_.equations.cols());
  for (std::size_t k = 0; k < curvature_.size(); ++k) {
    result.segment<3>(static_cast<Index>(3 * k)) += curvature_[k].diagonal();
  }
  return result;
}

ConeSystem::Solution ConeSystem::solve_refined(const VectorXd& first,
                                               const VectorXd& second) const {
  return refined(
      first, second,
      [&](const VectorXd& rest, const VectorXd& other) { return solve_once(rest, other); },
      [&](const Solution& at) { return left(first, second, at); }, stiffness());
}

ConeSystem::Solution ConeSystem::solve(const VectorXd& first, const VectorXd& second,
                                       bool must_hold) {
  Solution solution = solve_refined(first, second);
  if (augmented_ || !must_hold) return solution;
  const double off = left(first, second, solution).y.lpNorm<Eigen::Infinity>();
  if (off < enough) return solution;
  if (switch_to_augmented()) return solve_refined(first, second);
  return solution;
}

}  // namespace limit::solver
