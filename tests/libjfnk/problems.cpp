#include "problems.hpp"

#include <algorithm>
#include <cmath>

namespace jfnk_test {

Sparse laplacian(int m) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < m; ++i) {
      const int row = j * m + i;
      entries.emplace_back(row, row, 4.0);
      if (i > 0) entries.emplace_back(row, row - 1, -1.0);
      if (i + 1 < m) entries.emplace_back(row, row + 1, -1.0);
      if (j > 0) entries.emplace_back(row, row - m, -1.0);
      if (j + 1 < m) entries.emplace_back(row, row + m, -1.0);
    }
  }
  Sparse matrix(m * m, m * m);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Bratu::Bratu(int m, double lambda)
    : m_(m), weight_(lambda / ((m + 1.0) * (m + 1.0))), laplacian_(laplacian(m)) {}

void Bratu::operator()(const Vector& u, Vector& r) const {
  r.noalias() = laplacian_ * u;
  r.array() -= weight_ * u.array().exp();
}

void BratuWithJacobian::linearise(const Vector& u) {
  slope_ = weight_ * u.array().exp();
}

void BratuWithJacobian::apply_jacobian(const Vector& v, Vector& Jv) const {
  Jv.noalias() = laplacian_ * v;
  Jv.array() -= slope_.array() * v.array();
}

Evaluation HEquation::operator()(const Vector& u, Vector& r) const {
  for (int i = 0; i < n_; ++i) {
    const double mu_i = (i + 0.5) / n_;
    double sum = 0.0;
    for (int j = 0; j < n_; ++j) {
      const double mu_j = (j + 0.5) / n_;
      sum += mu_i / (mu_i + mu_j) * u[j];
    }
    const double denominator = 1.0 - 0.5 * c_ / n_ * sum;
    if (denominator <= 0.0) return Evaluation::out_of_domain;
    r[i] = u[i] - 1.0 / denominator;
  }
  return Evaluation::ok;
}

void Rosenbrock::operator()(const Vector& u, Vector& r) const {
  for (Eigen::Index i = 0; i + 1 < u.size(); i += 2) {
    r[i] = 10.0 * (u[i + 1] - u[i] * u[i]);
    r[i + 1] = 1.0 - u[i];
  }
}

void PowellSingular::operator()(const Vector& u, Vector& r) const {
  r[0] = u[0] + 10.0 * u[1];
  r[1] = std::sqrt(5.0) * (u[2] - u[3]);
  r[2] = (u[1] - 2.0 * u[2]) * (u[1] - 2.0 * u[2]);
  r[3] = std::sqrt(10.0) * (u[0] - u[3]) * (u[0] - u[3]);
}

PlasticTruss::PlasticTruss(int columns, int rows, double yield, double hardening)
    : columns_(columns), rows_(rows), yield_(yield), hardening_(hardening) {
  const int nodes = (columns + 1) * (rows + 1);
  index_.assign(2 * static_cast<std::size_t>(nodes), 0);
  for (int node = 0; node < nodes; ++node) {
    const int row = node / (columns + 1);
    for (int axis = 0; axis < 2; ++axis) {
      const auto k = static_cast<std::size_t>(2 * node + axis);
      if (row == 0) {
        index_[k] = -1;
      } else if (row == rows) {
        index_[k] = axis == 0 ? -2 : -1;
      } else {
        index_[k] = free_++;
      }
    }
  }
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const int node = j * (columns + 1) + i;
      if (i < columns) add_bar(node, node + 1);
      if (j < rows) add_bar(node, node + columns + 1);
      if (i < columns && j < rows) add_bar(node, node + columns + 2);
      if (i > 0 && j < rows) add_bar(node, node + columns);
    }
  }
}

void PlasticTruss::add_bar(int a, int b) {
  const int width = columns_ + 1;
  const double dx = b % width - a % width;
  const double dy = b / width - a / width;
  const double length = std::hypot(dx, dy);
  bars_.push_back({a, b, dx / length, dy / length, length, 0.0});
}

double PlasticTruss::displacement(const Vector& u, int node, int axis) const {
  const int k = index_[static_cast<std::size_t>(2 * node + axis)];
  return k >= 0 ? u[k] : (k == -2 ? push_ : 0.0);
}

double PlasticTruss::strain(const Vector& u, const Bar& bar) const {
  const double dx = displacement(u, bar.b, 0) - displacement(u, bar.a, 0);
  const double dy = displacement(u, bar.b, 1) - displacement(u, bar.a, 1);
  return (bar.nx * dx + bar.ny * dy) / bar.length;
}

Evaluation PlasticTruss::operator()(const Vector& u, Vector& r) {
  r.setZero();
  double reaction = 0.0;
  for (const Bar& bar : bars_) {
    const double elastic = strain(u, bar) - bar.plastic;
    const double yielded = std::clamp(elastic, -yield_, yield_);
    const double force = yielded + hardening_ * (elastic - yielded);
    const double f[2] = {force * bar.nx, force * bar.ny};
    for (int axis = 0; axis < 2; ++axis) {
      const int a = index_[static_cast<std::size_t>(2 * bar.a + axis)];
      const int b = index_[static_cast<std::size_t>(2 * bar.b + axis)];
      if (a >= 0) r[a] -= f[axis];
      if (b >= 0) r[b] += f[axis];
      if (a < 0 || b < 0) reaction += f[axis] * f[axis];
    }
  }
  reaction_norm_ = std::sqrt(reaction);
  return Evaluation::ok;
}

int PlasticTruss::accept(const Vector& u) {
  int yielded = 0;
  for (Bar& bar : bars_) {
    const double elastic = strain(u, bar) - bar.plastic;
    const double force = std::clamp(elastic, -yield_, yield_);
    if (force != elastic) ++yielded;
    bar.plastic += elastic - force;
  }
  return yielded;
}

Sparse PlasticTruss::elastic_stiffness() const {
  std::vector<Eigen::Triplet<double>> entries;
  for (const Bar& bar : bars_) {
    const double n[2] = {bar.nx, bar.ny};
    for (int s = 0; s < 4; ++s) {
      for (int t = 0; t < 4; ++t) {
        const int i = index_[static_cast<std::size_t>(2 * (s < 2 ? bar.a : bar.b) + s % 2)];
        const int j = index_[static_cast<std::size_t>(2 * (t < 2 ? bar.a : bar.b) + t % 2)];
        if (i < 0 || j < 0) continue;
        const double sign = (s < 2) == (t < 2) ? 1.0 : -1.0;
        entries.emplace_back(i, j, sign * n[s % 2] * n[t % 2] / bar.length);
      }
    }
  }
  Sparse matrix(free_, free_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace jfnk_test
