#include "jfnk/gmres.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace jfnk {
namespace {

constexpr double rounding_unit = std::numeric_limits<double>::epsilon();

// A sweep of classical Gram-Schmidt is repeated where the vector shrinks by more than this: with a
// lower bound errors in the orthogonality would grow from column to column (Daniel et al. 1976).
// What is left of its length is known by Pythagoras otherwise.
constexpr double reorthogonalise_below = 0.7;

// After the second sweep what remains of a vector inside the space is a few rounding units of it.
constexpr double breakdown_ratio = 100.0 * rounding_unit;

// The same where the columns before it are rounded to single precision.
constexpr double single_breakdown_ratio = 10.0 * std::numeric_limits<float>::epsilon();

// A cycle that keeps more than this of the residual is taken for stagnation.
constexpr double stagnation_ratio = 0.999;

bool all_zero(const Vector& x) {
  return (x.array() == 0.0).all();
}

}  // namespace

std::vector<std::string> validate(const GmresOptions& options) {
  std::vector<std::string> messages;
  if (options.restart < 1) messages.push_back("restart must be at least 1");
  if (options.max_iterations < 1) messages.push_back("max_iterations must be at least 1");
  if (!(options.relative_tolerance >= 0.0 && options.relative_tolerance < 1.0)) {
    messages.push_back("relative_tolerance must be in [0, 1)");
  }
  if (!(options.absolute_tolerance >= 0.0 && std::isfinite(options.absolute_tolerance))) {
    messages.push_back("absolute_tolerance must be finite and not negative");
  }
  return messages;
}

void Gmres::resize(Eigen::Index n, const GmresOptions& options, bool preconditioned) {
  const Eigen::Index dimension = options.global_size > 0 ? options.global_size : n;
  const auto columns = static_cast<std::size_t>(
      std::min<Eigen::Index>({dimension, options.restart, options.max_iterations}));
  // Grown as columns are built: most solves need few.
  basis_.resize(columns + 1, n, options.single_precision);
  preconditioned_.resize(options.flexible && preconditioned ? columns : 0, n,
                         options.single_precision);
  work_.resize(n);
  next_.resize(n);
  direction_.resize(preconditioned ? n : 0);
  const auto m = static_cast<Eigen::Index>(columns);
  sums_.resize(m + 2);
  list_.reserve(columns + 2);
  triangle_.resize(m + 1, m);
  cosines_.resize(m);
  sines_.resize(m);
  rhs_.resize(m + 1);
  coefficients_.resize(m + 1);
  descent_.resize(m);
  path_.resize(m);
}

GmresResult Gmres::solve(const OperatorRef& A, const Vector& b, Vector& x,
                         const GmresOptions& options, const PreconditionerRef& P,
                         const InnerProductRef& product) {
  if (b.size() != x.size()) {
    throw std::invalid_argument("jfnk::Gmres: b has size " + std::to_string(b.size()) +
                                ", x has size " + std::to_string(x.size()));
  }
  if (const auto messages = validate(options); !messages.empty()) {
    throw std::invalid_argument("jfnk::Gmres: " + messages.front());
  }
  resize(b.size(), options, !P.is_identity());
  preconditioner_applications_ = 0;
  can_shorten_ = false;
  flexible_ = options.flexible && !P.is_identity();

  GmresResult result;
  const double b_norm = product.norm(b);
  const double target = std::max(options.absolute_tolerance, options.relative_tolerance * b_norm);
  Vector& r = next_;
  const bool zero_guess = all_zero(x);
  Evaluation first = Evaluation::ok;
  if (zero_guess) {
    r = b;
  } else {
    first = A(x, work_);
    r = b - work_;
  }
  residual_norm_ = product.norm(r);
  if (first != Evaluation::ok || !std::isfinite(residual_norm_)) {
    result.status =
        first == Evaluation::stop ? KrylovStatus::stopped : KrylovStatus::operator_failed;
    result.residual_norm = residual_norm_;
    return result;
  }

  result.status = KrylovStatus::max_iterations;
  if (residual_norm_ <= target || residual_norm_ == 0.0) result.status = KrylovStatus::converged;
  bool ended = result.status == KrylovStatus::converged;
  while (!ended && result.iterations < options.max_iterations) {
    const double before = residual_norm_;
    const Cycle cycle =
        run_cycle(A, P, product, options, options.max_iterations - result.iterations, target);
    result.iterations += cycle.columns;
    columns_ = cycle.columns;
    solve_triangle(columns_);
    add_combination(columns_, coefficients_, P, product, x);
    if (result.iterations == cycle.columns) length_ = coefficients_.head(columns_).norm();
    can_shorten_ = zero_guess && result.iterations == cycle.columns && columns_ > 0;
    result.status = cycle.status;
    ended = cycle.ended;
    if (!ended && residual_norm_ > stagnation_ratio * before) {
      result.status = KrylovStatus::stagnated;
      ended = true;
    }
    if (!ended && result.iterations < options.max_iterations) {
      residual_from_recurrence(cycle.columns, product);
    }
  }
  result.residual_norm = residual_norm_;
  result.relative_residual = b_norm > 0.0 ? residual_norm_ / b_norm : 0.0;
  return result;
}

// Builds columns from next_ = r until the target, the restart length, the cap or a failure.
Gmres::Cycle Gmres::run_cycle(const OperatorRef& A, const PreconditionerRef& P,
                              const InnerProductRef& product, const GmresOptions& options,
                              int allowed, double target) {
  Cycle cycle;
  const int columns = std::min(allowed, static_cast<int>(triangle_.cols()));
  product.pass(next_.size(), 2, [&](Rows rows) { rows.of(next_) /= residual_norm_; });
  basis_.assign(0, 1.0, next_, product);
  rhs_.setZero();
  rhs_[0] = residual_norm_;
  for (int k = 0; k < columns; ++k) {
    const auto column = static_cast<std::size_t>(k);
    const Vector* input = &basis_.view(column, work_, product);
    if (!P.is_identity()) {
      P.apply(*input, direction_);
      ++preconditioner_applications_;
      if (options.flexible) preconditioned_.assign(column, 1.0, direction_, product);
      input = &direction_;
    }
    const Evaluation outcome = A(*input, next_);
    double before = 0.0;
    double after = 0.0;
    if (outcome == Evaluation::ok) after = orthogonalise(k, product, before);
    if (outcome != Evaluation::ok || !std::isfinite(before)) {
      cycle.ended = true;
      cycle.status =
          outcome == Evaluation::stop ? KrylovStatus::stopped : KrylovStatus::operator_failed;
      return cycle;
    }
    basis_.assign(column + 1, 1.0, next_, product);
    const bool exhausted =
        after <= (basis_.is_single() ? single_breakdown_ratio : breakdown_ratio) * before;
    rotate_column(k, exhausted ? 0.0 : after);
    cycle.columns = k + 1;
    residual_norm_ = std::abs(rhs_[k + 1]);
    if (residual_norm_ <= target || exhausted) {
      cycle.ended = true;
      const double rest = 10.0 * rounding_unit * rhs_.head(k + 1).norm();
      cycle.status = residual_norm_ <= std::max(target, rest) ? KrylovStatus::converged
                                                              : KrylovStatus::breakdown;
      return cycle;
    }
  }
  return cycle;
}

const detail::ColumnList& Gmres::first_of(const detail::ColumnStore& store, int count) {
  list_.clear();
  for (int j = 0; j < count; ++j) list_.add(store, static_cast<std::size_t>(j));
  return list_;
}

// Classical Gram-Schmidt of next_ against the columns before it, with coefficients to
// triangle_: all inner products of a sweep and the square of the vector are one sum, and the rest
// is scaled to length one as it is formed. Returns the length it had; not finite: `before` is not.
double Gmres::orthogonalise(int k, const InnerProductRef& product, double& before) {
  Vector& w = next_;
  double scale = 1.0;  // of w over what it was
  double shrunk = 1.0;
  triangle_.col(k).setZero();
  const auto look = [&] {
    (void)first_of(basis_, k + 1);
    if (!basis_.is_single()) list_.add(w);
    list_.dots(product, w, sums_.data());
    if (basis_.is_single()) sums_[k + 1] = product.dot(w, w);
    return sums_[k + 1];
  };
  double square = look();
  before = std::sqrt(square);
  if (std::isnan(square)) return square;
  if (!InnerProductRef::is_safe_square(square)) {
    before = product.norm(w);
    if (!(before > 0.0 && std::isfinite(before))) return before;
    scale = std::ldexp(1.0, std::ilogb(before));  // leaves the digits as they are
    w /= scale;
    square = look();
  }
  for (int sweep = 0; sweep < 2; ++sweep) {
    if (!(square > 0.0)) return 0.0;
    const double length = std::sqrt(square);
    const double rest = square - sums_.head(k + 1).squaredNorm();
    const bool known = rest > reorthogonalise_below * reorthogonalise_below * square;
    const double after = known ? std::sqrt(rest) : length;
    triangle_.col(k).head(k + 1) += (scale * shrunk) * sums_.head(k + 1);
    sums_.head(k + 1) *= -1.0 / after;
    first_of(basis_, k + 1).combine(product, 1.0 / after, sums_.data(), w);
    shrunk *= after;
    if (known) return scale * shrunk;
    // What is left is too small a part to be known by its square: look again.
    if (sweep == 0) square = look();
  }
  const double left = product.norm(w);
  if (left > 0.0) w /= left;
  return scale * shrunk * left;
}

std::size_t Gmres::bytes() const {
  const Eigen::Index numbers = work_.size() + direction_.size() + next_.size() + triangle_.size();
  return static_cast<std::size_t>(numbers) * sizeof(double) + basis_.bytes() +
         preconditioned_.bytes();
}

// Brings the new column of the Hessenberg matrix to triangular form by Givens rotations.
void Gmres::rotate_column(int k, double subdiagonal) {
  for (int j = 0; j < k; ++j) {
    const double upper = triangle_(j, k);
    const double lower = triangle_(j + 1, k);
    triangle_(j, k) = cosines_[j] * upper + sines_[j] * lower;
    triangle_(j + 1, k) = cosines_[j] * lower - sines_[j] * upper;
  }
  const double scale = triangle_.col(k).head(k + 1).cwiseAbs().maxCoeff();
  const double diagonal = triangle_(k, k);
  const double length = std::hypot(diagonal, subdiagonal);
  if (length <= breakdown_ratio * scale || length == 0.0) {
    // A maps this direction into the span of the others: it cannot lower the residual.
    triangle_(k, k) = 0.0;
    cosines_[k] = 0.0;
    sines_[k] = 1.0;
    rhs_[k + 1] = -rhs_[k];
    rhs_[k] = 0.0;
    return;
  }
  cosines_[k] = diagonal / length;
  sines_[k] = subdiagonal / length;
  triangle_(k, k) = length;
  rhs_[k + 1] = -sines_[k] * rhs_[k];
  rhs_[k] *= cosines_[k];
}

// The triangular system solved backwards into coefficients_; null columns get no weight.
void Gmres::solve_triangle(int columns) {
  for (int i = columns - 1; i >= 0; --i) {
    double sum = rhs_[i];
    for (int j = i + 1; j < columns; ++j) sum -= triangle_(i, j) * coefficients_[j];
    coefficients_[i] = triangle_(i, i) == 0.0 ? 0.0 : sum / triangle_(i, i);
  }
}

// x += P V y (or Z y).
void Gmres::add_combination(int columns, const Eigen::VectorXd& coefficients,
                            const PreconditionerRef& P, const InnerProductRef& product, Vector& x) {
  if (columns == 0) return;
  if (flexible_ || P.is_identity()) {
    first_of(flexible_ ? preconditioned_ : basis_, columns)
        .combine(product, 1.0, coefficients.data(), x);
    return;
  }
  first_of(basis_, columns).combine(product, 0.0, coefficients.data(), work_);
  P.apply(work_, direction_);
  ++preconditioner_applications_;
  x += direction_;
}

// Column j of Q = V G^T into the basis, where G are the rotations; work_ holds v_j as it was, next_
// will hold v_{j+1}.
void Gmres::rotate_basis(int j) {
  const auto at = static_cast<std::size_t>(j);
  basis_.copy_to(at + 1, next_);
  basis_.rotate(at, cosines_[j], sines_[j]);
}

// z_j such that A z_j is column j, from v_j in work_.
const Vector& Gmres::column_of_space(int j, const PreconditionerRef& P) {
  if (flexible_) return preconditioned_.view(static_cast<std::size_t>(j), direction_);
  if (P.is_identity()) return work_;
  P.apply(work_, direction_);
  ++preconditioner_applications_;
  return direction_;
}

double Gmres::shorten(double length, const PreconditionerRef& P, Vector& x,
                      const InnerProductRef& product) {
  const int k = columns_;
  double steepness = 0.0;
  for (int j = 0; j < k; ++j) {
    descent_[j] = triangle_.col(j).head(j + 1).dot(rhs_.head(j + 1));
    steepness += descent_[j] * descent_[j];
  }
  double curvature = 0.0;
  for (int i = 0; i < k; ++i) {
    double sum = 0.0;
    for (int j = i; j < k; ++j) sum += triangle_(i, j) * descent_[j];
    curvature += sum * sum;
  }
  const double reach = curvature > 0.0 ? steepness / curvature : 0.0;  // of the lowest point
  const double reach_length = reach * std::sqrt(steepness);
  double weight = 0.0;  // of the solution
  double descent_weight = reach;
  if (length >= length_) {
    weight = 1.0;
    descent_weight = 0.0;
  } else if (reach_length >= length) {
    descent_weight = length / std::sqrt(steepness);
  } else {
    // ||reach d + t (y - reach d)|| = length.
    double along = 0.0;
    double square = 0.0;
    for (int j = 0; j < k; ++j) {
      const double chord = coefficients_[j] - reach * descent_[j];
      along += chord * reach * descent_[j];
      square += chord * chord;
    }
    const double rest = length * length - reach_length * reach_length;
    weight = rest / (along + std::sqrt(along * along + square * rest));
    descent_weight = (1.0 - weight) * reach;
  }
  double distance = residual_norm_ * residual_norm_;
  for (int j = 0; j < k; ++j) path_[j] = weight * coefficients_[j] + descent_weight * descent_[j];
  for (int i = 0; i < k; ++i) {
    double sum = rhs_[i];
    for (int j = i; j < k; ++j) sum -= triangle_(i, j) * path_[j];
    distance += sum * sum;
  }
  x.setZero();
  add_combination(k, path_, P, product, x);
  return std::sqrt(distance);
}

// r = V Q^T (0, ..., 0, rhs[m]): the Arnoldi relation gives the new residual without applying A.
void Gmres::residual_from_recurrence(int columns, const InnerProductRef& product) {
  coefficients_.setZero();
  coefficients_[columns] = rhs_[columns];
  for (int j = columns - 1; j >= 0; --j) {
    const double upper = coefficients_[j];
    const double lower = coefficients_[j + 1];
    coefficients_[j] = cosines_[j] * upper - sines_[j] * lower;
    coefficients_[j + 1] = sines_[j] * upper + cosines_[j] * lower;
  }
  first_of(basis_, columns + 1).combine(product, 0.0, coefficients_.data(), next_);
}

}  // namespace jfnk
