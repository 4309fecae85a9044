#include <cmath>
#include <numbers>

#include "problem.hpp"

namespace peers {
namespace {

bool rosenbrock(const Vector& x, Vector& r) {
  for (Eigen::Index i = 0; i + 1 < x.size(); i += 2) {
    r[i] = 10.0 * (x[i + 1] - x[i] * x[i]);
    r[i + 1] = 1.0 - x[i];
  }
  return true;
}

bool powell_singular(const Vector& x, Vector& r) {
  for (Eigen::Index i = 0; i + 3 < x.size(); i += 4) {
    r[i] = x[i] + 10.0 * x[i + 1];
    r[i + 1] = std::sqrt(5.0) * (x[i + 2] - x[i + 3]);
    r[i + 2] = (x[i + 1] - 2.0 * x[i + 2]) * (x[i + 1] - 2.0 * x[i + 2]);
    r[i + 3] = std::sqrt(10.0) * (x[i] - x[i + 3]) * (x[i] - x[i + 3]);
  }
  return true;
}

bool powell_badly_scaled(const Vector& x, Vector& r) {
  r[0] = 1e4 * x[0] * x[1] - 1.0;
  r[1] = std::exp(-x[0]) + std::exp(-x[1]) - 1.0001;
  return true;
}

bool freudenstein_roth(const Vector& x, Vector& r) {
  r[0] = -13.0 + x[0] + ((5.0 - x[1]) * x[1] - 2.0) * x[1];
  r[1] = -29.0 + x[0] + ((x[1] + 1.0) * x[1] - 14.0) * x[1];
  return true;
}

bool helical_valley(const Vector& x, Vector& r) {
  double angle = std::atan(x[1] / x[0]) / (2.0 * std::numbers::pi);
  if (x[0] == 0.0) angle = x[1] >= 0.0 ? 0.25 : -0.25;
  if (x[0] < 0.0) angle += 0.5;
  r[0] = 10.0 * (x[2] - 10.0 * angle);
  r[1] = 10.0 * (std::hypot(x[0], x[1]) - 1.0);
  r[2] = x[2];
  return true;
}

bool wood(const Vector& x, Vector& r) {
  const double a = x[1] - x[0] * x[0];
  const double b = x[3] - x[2] * x[2];
  r[0] = -200.0 * x[0] * a - (1.0 - x[0]);
  r[1] = 200.0 * a + 20.2 * (x[1] - 1.0) + 19.8 * (x[3] - 1.0);
  r[2] = -180.0 * x[2] * b - (1.0 - x[2]);
  r[3] = 180.0 * b + 20.2 * (x[3] - 1.0) + 19.8 * (x[1] - 1.0);
  return true;
}

bool broyden_tridiagonal(const Vector& x, Vector& r) {
  const Eigen::Index n = x.size();
  for (Eigen::Index i = 0; i < n; ++i) {
    r[i] = (3.0 - 2.0 * x[i]) * x[i] + 1.0 - (i > 0 ? x[i - 1] : 0.0) -
           (i + 1 < n ? 2.0 * x[i + 1] : 0.0);
  }
  return true;
}

bool broyden_banded(const Vector& x, Vector& r) {
  const Eigen::Index n = x.size();
  for (Eigen::Index i = 0; i < n; ++i) {
    r[i] = x[i] * (2.0 + 5.0 * x[i] * x[i]) + 1.0;
    for (Eigen::Index j = std::max<Eigen::Index>(0, i - 5); j <= std::min(n - 1, i + 1); ++j) {
      if (j != i) r[i] -= x[j] * (1.0 + x[j]);
    }
  }
  return true;
}

bool boundary_value(const Vector& x, Vector& r) {
  const Eigen::Index n = x.size();
  const double h = 1.0 / (static_cast<double>(n) + 1.0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = static_cast<double>(i + 1) * h;
    r[i] = 2.0 * x[i] - (i > 0 ? x[i - 1] : 0.0) - (i + 1 < n ? x[i + 1] : 0.0) +
           0.5 * h * h * std::pow(x[i] + t + 1.0, 3);
  }
  return true;
}

bool integral_equation(const Vector& x, Vector& r) {
  const Eigen::Index n = x.size();
  const double h = 1.0 / (static_cast<double>(n) + 1.0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t = static_cast<double>(i + 1) * h;
    double sum = 0.0;
    for (Eigen::Index j = 0; j < n; ++j) {
      const double s = static_cast<double>(j + 1) * h;
      sum += (j <= i ? (1.0 - t) * s : t * (1.0 - s)) * std::pow(x[j] + s + 1.0, 3);
    }
    r[i] = x[i] + 0.5 * h * sum;
  }
  return true;
}

bool trigonometric(const Vector& x, Vector& r) {
  const auto n = static_cast<double>(x.size());
  const double sum = x.array().cos().sum();
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    r[i] = n - sum + static_cast<double>(i + 1) * (1.0 - std::cos(x[i])) - std::sin(x[i]);
  }
  return true;
}

bool brown_almost_linear(const Vector& x, Vector& r) {
  const auto n = static_cast<double>(x.size());
  r = x.array() + x.sum() - (n + 1.0);
  r[x.size() - 1] = x.prod() - 1.0;
  return true;
}

bool variably_dimensioned(const Vector& x, Vector& r) {
  double sum = 0.0;
  for (Eigen::Index j = 0; j < x.size(); ++j) sum += static_cast<double>(j + 1) * (x[j] - 1.0);
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    r[k] = x[k] - 1.0 + static_cast<double>(k + 1) * sum * (1.0 + 2.0 * sum * sum);
  }
  return true;
}

bool chebyquad(const Vector& x, Vector& r) {
  const Eigen::Index n = x.size();
  r.setZero();
  for (Eigen::Index j = 0; j < n; ++j) {
    double before = 1.0;
    double now = 2.0 * x[j] - 1.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      r[i] += now;
      const double next = 2.0 * (2.0 * x[j] - 1.0) * now - before;
      before = now;
      now = next;
    }
  }
  r /= static_cast<double>(n);
  for (Eigen::Index i = 1; i < n; i += 2) {
    const auto k = static_cast<double>(i + 1);
    r[i] += 1.0 / (k * k - 1.0);
  }
  return true;
}

Vector repeated(std::initializer_list<double> values, int times) {
  return vector(values).replicate(times, 1);
}

Vector t_times_t_minus_one(Eigen::Index n) {
  const Vector t = Vector::LinSpaced(n, 1.0, static_cast<double>(n)) / (static_cast<double>(n) + 1);
  return t.array() * (t.array() - 1.0);
}

}  // namespace

void add_classics(std::vector<Problem>& problems) {
  problems.push_back({"Rosenbrock 100", true, repeated({-1.2, 1.0}, 50), rosenbrock});
  problems.push_back(
      {"Powell singular", false, repeated({3.0, -1.0, 0.0, 1.0}, 5), powell_singular});
  problems.push_back({"Powell badly scaled", true, vector({0.0, 1.0}), powell_badly_scaled});
  problems.push_back({"Freudenstein-Roth", false, vector({6.0, 5.0}), freudenstein_roth});
  problems.push_back({"helical valley", true, vector({-1.0, 0.0, 0.0}), helical_valley});
  problems.push_back({"Wood", false, vector({-3.0, -1.0, -3.0, -1.0}), wood});
  problems.push_back(
      {"Broyden tridiagonal", true, Vector::Constant(100, -1.0), broyden_tridiagonal});
  problems.push_back({"Broyden banded", false, Vector::Constant(100, -1.0), broyden_banded});
  problems.push_back({"boundary value", true, t_times_t_minus_one(50), boundary_value});
  problems.push_back({"integral equation", false, t_times_t_minus_one(50), integral_equation});
  problems.push_back({"trigonometric", true, Vector::Constant(10, 0.1), trigonometric});
  problems.push_back(
      {"Brown almost linear", false, Vector::Constant(10, 0.5), brown_almost_linear});
  problems.push_back(
      {"variably dimensioned", true, Vector::LinSpaced(10, 0.9, 0.0), variably_dimensioned});
  problems.push_back({"Chebyquad 7", false, Vector::LinSpaced(7, 0.125, 0.875), chebyquad});
}

}  // namespace peers
