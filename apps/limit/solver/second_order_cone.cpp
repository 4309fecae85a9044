#include "limit/solver/second_order_cone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limit::solver::second_order_cone {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d reflected(const Vector3d& u) {
  return {u[0], -u[1], -u[2]};
}

double determinant(const Vector3d& u) {
  const double radius = std::hypot(u[1], u[2]);
  return (u[0] - radius) * (u[0] + radius);
}

Vector3d product(const Vector3d& u, const Vector3d& v) {
  return {u.dot(v), u[0] * v[1] + v[0] * u[1], u[0] * v[2] + v[0] * u[2]};
}

Vector3d quotient(const Vector3d& v, const Vector3d& u) {
  const double first = reflected(u).dot(v) / determinant(u);
  return {first, (v[1] - first * u[1]) / u[0], (v[2] - first * u[2]) / u[0]};
}

double largest_step(const Vector3d& u, const Vector3d& direction) {
  // The smallest positive root of determinant(u + step direction), or where u0 vanishes.
  double step = std::numeric_limits<double>::infinity();
  const double a = determinant(direction), b = reflected(u).dot(direction), c = determinant(u);
  const double discriminant = b * b - a * c;
  if (discriminant >= 0.0) {
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    for (const double root : {q / a, c / q}) {
      if (root > 0.0) step = std::min(step, root);
    }
  }
  return direction[0] < 0.0 ? std::min(step, -u[0] / direction[0]) : step;
}

namespace {

Vector3d reflection_times(const Vector3d& v, const Vector3d& x) {
  return 2.0 * v.dot(x) * v - reflected(x);
}

Matrix3d reflection(const Vector3d& v) {
  return 2.0 * v * v.transpose() - Matrix3d(Vector3d(1, -1, -1).asDiagonal());
}

}  // namespace

Scaling::Scaling(const Vector3d& u, const Vector3d& z) {
  const double of_u = std::sqrt(determinant(u)), of_z = std::sqrt(determinant(z));
  const Vector3d unit_u = u / of_u, unit_z = z / of_z;
  axis_ = (unit_u + reflected(unit_z)) / std::sqrt(2.0 * (1.0 + unit_u.dot(unit_z)));
  axis_[0] = std::sqrt(1.0 + axis_.tail<2>().squaredNorm());  // of determinant 1 to the last digit
  root_ = (axis_ + Vector3d::UnitX()) / std::sqrt(2.0 * (axis_[0] + 1.0));
  size_ = std::sqrt(of_u / of_z);
  point = times(z);
}

Vector3d Scaling::times(const Vector3d& x) const {
  return size_ * reflection_times(root_, x);
}

Vector3d Scaling::inverse_times(const Vector3d& x) const {
  return reflection_times(reflected(root_), x) / size_;
}

Matrix3d Scaling::squared() const {
  return size_ * size_ * reflection(axis_);
}

Matrix3d Scaling::inverse_squared() const {
  return reflection(reflected(axis_)) / (size_ * size_);
}

Eigen::Matrix2d Scaling::disc_inverse() const {
  const Eigen::Vector2d radial = axis_.tail<2>();
  return size_ * size_ *
         (Eigen::Matrix2d::Identity() -
          2.0 / (1.0 + 2.0 * radial.squaredNorm()) * radial * radial.transpose());
}

Eigen::Matrix2d Scaling::disc_root() const {
  const Eigen::Vector2d radial = axis_.tail<2>();
  const double stretch = std::sqrt(1.0 + 2.0 * radial.squaredNorm());
  return size_ * (Eigen::Matrix2d::Identity() -
                  2.0 / (stretch * (stretch + 1.0)) * radial * radial.transpose());
}

}  // namespace limit::solver::second_order_cone
