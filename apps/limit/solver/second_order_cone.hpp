#pragma once

#include <Eigen/Core>

namespace limit::solver {

/// The cone { u : u0 >= sqrt(u1^2 + u2^2) } and its Jordan algebra (Alizadeh & Goldfarb 2003).
namespace second_order_cone {

/// (u0, -u1, -u2)
[[nodiscard]] Eigen::Vector3d reflected(const Eigen::Vector3d& u);
/// u0^2 - u1^2 - u2^2; positive inside, zero on the boundary.
[[nodiscard]] double determinant(const Eigen::Vector3d& u);
/// The Jordan product, u.v and u0 v + v0 u.
[[nodiscard]] Eigen::Vector3d product(const Eigen::Vector3d& u, const Eigen::Vector3d& v);
/// The x of product(u, x) = v, for u inside.
[[nodiscard]] Eigen::Vector3d quotient(const Eigen::Vector3d& v, const Eigen::Vector3d& u);
/// The largest step for which u + step x direction stays in the cone, for u inside; may be
/// infinite.
[[nodiscard]] double largest_step(const Eigen::Vector3d& u, const Eigen::Vector3d& direction);

/// The scaling point of u and z inside the cone (Nesterov & Todd 1998): the symmetric matrix W with
/// W z = W^-1 u. All in closed form: the inverse of a computed matrix would lose its digits, as its
/// condition grows beyond any bound where u and z near the boundary.
struct Scaling {
  Scaling(const Eigen::Vector3d& u, const Eigen::Vector3d& z);

  [[nodiscard]] Eigen::Vector3d times(const Eigen::Vector3d& x) const;          // W x
  [[nodiscard]] Eigen::Vector3d inverse_times(const Eigen::Vector3d& x) const;  // W^-1 x
  [[nodiscard]] Eigen::Matrix3d squared() const;                                // W^2
  [[nodiscard]] Eigen::Matrix3d inverse_squared() const;                        // W^-2
  /// Inverse of the lower right 2 x 2 block of W^-2.
  [[nodiscard]] Eigen::Matrix2d disc_inverse() const;
  /// The symmetric root of that.
  [[nodiscard]] Eigen::Matrix2d disc_root() const;

  Eigen::Vector3d point;  // W z = W^-1 u

 private:
  double size_;           // W = size (2 root root' - J), J = diag(1, -1, -1)
  Eigen::Vector3d axis_;  // of determinant 1; W^2 = size^2 (2 axis axis' - J)
  Eigen::Vector3d root_;
};

}  // namespace second_order_cone

}  // namespace limit::solver
