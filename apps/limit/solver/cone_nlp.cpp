#include "limit/solver/cone_nlp.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace limit::solver {

namespace {

using Ipopt::Index;
using Ipopt::Number;

// Ipopt's convention for "no bound".
constexpr double unbounded = 2e19;

// Derivatives of a function of (p, d, t): gradient, and the lower triangle pp dp dd tp td tt.
struct Derivatives {
  double value = 0.0;
  double p = 0.0, d = 0.0, t = 0.0;
  std::array<double, 6> second{};
};

Derivatives ratio_form(const programme::YieldCone& cone, double p, double d, double t) {
  const double s = cone.strength - cone.slope * p, b = cone.slope;
  const double r = d * d + t * t;
  return {r / s - s,
          b * r / (s * s) + b,
          2 * d / s,
          2 * t / s,
          {2 * r * b * b / (s * s * s), 2 * d * b / (s * s), 2 / s, 2 * t * b / (s * s), 0, 2 / s}};
}

Derivatives quadratic_form(const programme::YieldCone& cone, double p, double d, double t) {
  const double s = cone.strength - cone.slope * p, b = cone.slope;
  return {d * d + t * t - s * s, 2 * b * s, 2 * d, 2 * t, {-2 * b * b, 0, 2, 0, 0, 2}};
}

// -log(s^2 - d^2 - t^2); the value is not a number outside the cone.
Derivatives log_barrier(const programme::YieldCone& cone, double p, double d, double t) {
  const Derivatives f = quadratic_form(cone, p, d, t);
  const double q = -f.value;
  const bool inside = q > 0.0 && cone.strength - cone.slope * p > 0.0;
  const auto curve = [&](double second, double first, double other) {
    return second / q + first * other / (q * q);
  };
  return {inside ? -std::log(q) : std::numeric_limits<double>::quiet_NaN(),
          f.p / q,
          f.d / q,
          f.t / q,
          {curve(f.second[0], f.p, f.p), curve(0, f.d, f.p), curve(f.second[2], f.d, f.d),
           curve(0, f.t, f.p), curve(0, f.t, f.d), curve(f.second[5], f.t, f.t)}};
}

Derivatives row(ConeForm form, const programme::YieldCone& cone, const Number* x) {
  return form == ConeForm::inequality ? ratio_form(cone, x[0], x[1], x[2])
                                      : quadratic_form(cone, x[0], x[1], x[2]);
}

}  // namespace

ConeNlp::ConeNlp(const programme::ConeProgram& program, ConeForm form)
    : form_(form),
      program_(program),
      point_(program_.start),
      dual_(Eigen::VectorXd::Zero(program_.equations.rows())) {}

bool ConeNlp::get_nlp_info(Index& n, Index& m, Index& jacobian_entries, Index& hessian_entries,
                           IndexStyleEnum& style) {
  const auto cones = static_cast<Index>(program_.cones.size());
  n = static_cast<Index>(program_.cost.size());
  m = static_cast<Index>(program_.equations.rows()) + (has_rows() ? cones : 0);
  jacobian_entries =
      static_cast<Index>(program_.equations.nonZeros()) + (has_rows() ? 3 * cones : 0);
  hessian_entries = 6 * cones;
  style = C_STYLE;
  return true;
}

bool ConeNlp::get_bounds_info(Index n, Number* lower, Number* upper, Index m,
                              Number* constraint_lower, Number* constraint_upper) {
  std::fill_n(lower, n, -unbounded);
  std::fill_n(upper, n, unbounded);
  for (std::size_t k = 0; k < program_.cones.size(); ++k) {
    if (has_rows() && program_.cones[k].slope > 0.0)
      upper[3 * k] = program_.cones[k].strength / program_.cones[k].slope;
  }
  const auto equations = static_cast<Index>(program_.equations.rows());
  for (Index i = 0; i < m; ++i) {
    constraint_lower[i] = i < equations ? program_.right_side[i] : -unbounded;
    constraint_upper[i] = i < equations ? program_.right_side[i] : 0.0;
  }
  return true;
}

bool ConeNlp::get_starting_point(Index n, bool, Number* x, bool, Number*, Number*, Index m,
                                 bool init_lambda, Number* lambda) {
  std::copy_n(point_.data(), n, x);
  if (init_lambda) {
    std::fill_n(lambda, m, 0.0);
    std::copy_n(dual_.data(), std::min<Index>(m, static_cast<Index>(dual_.size())), lambda);
  }
  return true;
}

bool ConeNlp::eval_f(Index n, const Number* x, bool, Number& value) {
  value = program_.cost.dot(Eigen::Map<const Eigen::VectorXd>(x, n));
  if (form_ != ConeForm::barrier) return true;
  for (std::size_t k = 0; k < program_.cones.size(); ++k) {
    value += barrier * log_barrier(program_.cones[k], x[3 * k], x[3 * k + 1], x[3 * k + 2]).value;
  }
  return std::isfinite(value);
}

bool ConeNlp::eval_grad_f(Index n, const Number* x, bool, Number* gradient) {
  std::copy_n(program_.cost.data(), n, gradient);
  if (form_ != ConeForm::barrier) return true;
  for (std::size_t k = 0; k < program_.cones.size(); ++k) {
    const Derivatives f = log_barrier(program_.cones[k], x[3 * k], x[3 * k + 1], x[3 * k + 2]);
    gradient[3 * k] += barrier * f.p;
    gradient[3 * k + 1] += barrier * f.d;
    gradient[3 * k + 2] += barrier * f.t;
  }
  return true;
}

bool ConeNlp::eval_g(Index n, const Number* x, bool, Index, Number* values) {
  const Eigen::Index equations = program_.equations.rows();
  Eigen::Map<Eigen::VectorXd>(values, equations) =
      program_.equations * Eigen::Map<const Eigen::VectorXd>(x, n);
  if (!has_rows()) return true;
  for (std::size_t k = 0; k < program_.cones.size(); ++k) {
    const double value = row(form_, program_.cones[k], x + 3 * k).value;
    if (!std::isfinite(value)) return false;
    values[static_cast<std::size_t>(equations) + k] = value;
  }
  return true;
}

bool ConeNlp::eval_jac_g(Index, const Number* x, bool, Index, Index, Index* rows, Index* columns,
                         Number* values) {
  std::size_t at = 0;
  const auto put = [&](Eigen::Index i, Eigen::Index j, double value) {
    if (values == nullptr) {
      rows[at] = static_cast<Index>(i);
      columns[at] = static_cast<Index>(j);
    } else {
      values[at] = value;
    }
    ++at;
  };
  for (Eigen::Index i = 0; i < program_.equations.rows(); ++i) {
    for (decltype(program_.equations)::InnerIterator entry(program_.equations, i); entry; ++entry) {
      put(i, entry.col(), entry.value());
    }
  }
  if (!has_rows()) return true;
  for (std::size_t k = 0; k < program_.cones.size(); ++k) {
    const Derivatives f =
        values == nullptr ? Derivatives{} : row(form_, program_.cones[k], x + 3 * k);
    const auto i = program_.equations.rows() + static_cast<Eigen::Index>(k);
    const auto j = 3 * static_cast<Eigen::Index>(k);
    put(i, j, f.p);
    put(i, j + 1, f.d);
    put(i, j + 2, f.t);
  }
  return true;
}

bool ConeNlp::eval_h(Index, const Number* x, bool, Number objective_factor, Index,
                     const Number* lambda, bool, Index, Index* rows, Index* columns,
                     Number* values) {
  constexpr std::array<Index, 6> row_of{0, 1, 1, 2, 2, 2}, column_of{0, 0, 1, 0, 1, 2};
  for (std::size_t k = 0; k < program_.cones.size(); ++k) {
    Derivatives f;
    double weight = 0.0;
    if (values != nullptr && has_rows()) {
      f = row(form_, program_.cones[k], x + 3 * k);
      weight = lambda[static_cast<std::size_t>(program_.equations.rows()) + k];
    } else if (values != nullptr) {
      f = log_barrier(program_.cones[k], x[3 * k], x[3 * k + 1], x[3 * k + 2]);
      weight = objective_factor * barrier;
    }
    for (std::size_t i = 0; i < 6; ++i) {
      if (values == nullptr) {
        rows[6 * k + i] = static_cast<Index>(3 * k) + row_of[i];
        columns[6 * k + i] = static_cast<Index>(3 * k) + column_of[i];
      } else {
        values[6 * k + i] = weight * f.second[i];
      }
    }
  }
  return true;
}

void ConeNlp::finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number*,
                                const Number*, Index, const Number*, const Number* lambda, Number,
                                const Ipopt::IpoptData*, Ipopt::IpoptCalculatedQuantities*) {
  point_ = Eigen::Map<const Eigen::VectorXd>(x, n);
  dual_ = Eigen::Map<const Eigen::VectorXd>(lambda, program_.equations.rows());
}

}  // namespace limit::solver
