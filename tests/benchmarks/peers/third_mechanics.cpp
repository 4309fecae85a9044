#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "block.hpp"
#include "grid.hpp"
#include "third_set.hpp"

namespace peers {
namespace {

/// A cantilever of bars in a triangular lattice, clamped to the left, whose right end is pushed
/// down and brought back: both steps are one system, the plastic strains after the first taken from
/// its displacements. Bars of stiffness 1 harden kinematically by 0.05 of it, so that each step is
/// the least of a strictly convex function.
class Lattice {
 public:
  Lattice(int columns, int rows) : columns_(columns) {
    // By beam theory the outer bars at the clamp are strained to four times their yield strain.
    const double half_depth = 0.25 * std::sqrt(3.0) * rows;
    push_ = 4.0 * yield * columns * columns / (3.0 * half_depth);
    for (int j = 0; j <= rows; ++j) {
      for (int i = 0; i <= columns; ++i) {
        for (int axis = 0; axis < 2; ++axis) {
          index_.push_back(i == 0 ? fixed : (i == columns && axis == 1 ? pushed : free_++));
        }
        if (i < columns) add_bar(i, j, i + 1, j);
        const int right = i + j % 2;  // upper neighbours; odd rows stand half a bar to the right
        if (j < rows && right <= columns) add_bar(i, j, right, j + 1);
        if (j < rows && right > 0) add_bar(i, j, right - 1, j + 1);
      }
    }
  }
  [[nodiscard]] int size() const { return 2 * free_; }

  void residual(const Vector& u, Vector& r) const {
    r.setZero();
    for (const Bar& bar : bars_) {
      double plastic = 0.0;
      for (int step = 0; step < 2; ++step) {
        const double strain = stretch(u, bar, step);
        const double trial = strain - plastic - hardening * plastic;
        plastic += (trial - std::clamp(trial, -yield, yield)) / (1.0 + hardening);
        for (int axis = 0; axis < 2; ++axis) {
          const double force = (strain - plastic) * bar.direction[axis];
          add(r, bar.a, axis, step, -force);
          add(r, bar.b, axis, step, force);
        }
      }
    }
  }

 private:
  static constexpr double yield = 1e-3;
  static constexpr double hardening = 0.05;
  static constexpr int fixed = -1;
  static constexpr int pushed = -2;
  struct Bar {
    int a;
    int b;
    std::array<double, 2> direction;
  };

  void add_bar(int i, int j, int ii, int jj) {
    const int width = columns_ + 1;
    const double x = ii - i + 0.5 * (jj % 2 - j % 2);
    const double y = 0.5 * std::sqrt(3.0) * (jj - j);
    bars_.push_back({j * width + i, jj * width + ii, {x, y}});
  }
  [[nodiscard]] int index(int node, int axis) const {
    return index_[static_cast<std::size_t>(2 * node + axis)];
  }
  [[nodiscard]] double displacement(const Vector& u, int node, int axis, int step) const {
    const int k = index(node, axis);
    if (k == pushed) return step == 0 ? -push_ : 0.0;
    return k == fixed ? 0.0 : u[step * free_ + k];
  }
  [[nodiscard]] double stretch(const Vector& u, const Bar& bar, int step) const {
    double sum = 0.0;
    for (int axis = 0; axis < 2; ++axis) {
      sum += bar.direction[axis] *
             (displacement(u, bar.b, axis, step) - displacement(u, bar.a, axis, step));
    }
    return sum;
  }
  void add(Vector& r, int node, int axis, int step, double force) const {
    const int k = index(node, axis);
    if (k >= 0) r[step * free_ + k] += force;
  }

  int columns_;
  double push_ = 0.0;
  int free_ = 0;
  std::vector<int> index_;  // 2 per node: unknown, fixed or pushed
  std::vector<Bar> bars_;
};

Problem lattice(const char* name, int columns, int rows) {
  const Lattice bars(columns, rows);
  return {name, false, Vector::Zero(bars.size()), [bars](const Vector& u, Vector& r) {
            bars.residual(u, r);
            return true;
          }};
}

/// An elastic block pressed on a rigid floor by its upper side and dragged along, with Coulomb
/// friction: displacements and forces of contact, by the augmented Lagrangian of Alart & Curnier
/// 1991 (Comput. Methods Appl. Mech. Eng. 92, 353), penalty 1.
Problem block_with_friction(const char* name, int rows, double friction) {
  const Block block{rows};
  const int width = block.columns() + 1;
  const Eigen::Index nodes = static_cast<Eigen::Index>(width) * rows;  // all but the upper side
  return {name, false, Vector::Zero(2 * (nodes + width)), [=](const Vector& u, Vector& r) {
            const auto at = [&](int i, int j) -> Eigen::Vector2d {
              if (j == rows) return {0.02, -0.02};
              return u.segment<2>(2 * (static_cast<Eigen::Index>(j) * width + i));
            };
            const auto stress = [](const Eigen::Matrix2d& H, Eigen::Matrix2d& P) {
              P = shear_modulus * (H + H.transpose());
              P.diagonal().array() += lame * H.trace();
              return true;
            };
            r.setZero();
            add_forces(block, at, stress, [&](int i, int j, const Eigen::Vector2d& force) {
              if (j < rows) r.segment<2>(2 * (static_cast<Eigen::Index>(j) * width + i)) += force;
            });
            for (int i = 0; i < width; ++i) {
              const Eigen::Vector2d contact = u.segment<2>(2 * (nodes + i));
              const Eigen::Vector2d augmented = contact - at(i, 0);
              const double pressure = std::max(0.0, augmented[1]);
              const double drag =
                  std::clamp(augmented[0], -friction * pressure, friction * pressure);
              r.segment<2>(2 * i) -= contact;
              r.segment<2>(2 * (nodes + i)) = contact - Eigen::Vector2d(drag, pressure);
            }
            return true;
          }};
}

/// A block of neo-Hookean rubber, stress mu (F - F^-T) + lambda log(J) F^-T, glued below and
/// pressed by dead loads on the middle half of its upper side (Bonet & Wood 2008):
/// without a value where a triangle is turned inside out.
Problem rubber(const char* name, int rows, double load) {
  const Block block{rows};
  const int width = block.columns() + 1;
  return {name, false, Vector::Zero(2 * width * rows), [=](const Vector& u, Vector& r) {
            const auto row = [&](int i, int j) {
              return 2 * (static_cast<Eigen::Index>(j - 1) * width + i);
            };
            const auto at = [&](int i, int j) -> Eigen::Vector2d {
              if (j == 0) return Eigen::Vector2d::Zero();
              return u.segment<2>(row(i, j));
            };
            const auto stress = [](const Eigen::Matrix2d& H, Eigen::Matrix2d& P) {
              const Eigen::Matrix2d F = Eigen::Matrix2d::Identity() + H;
              const double J = F.determinant();
              if (!(J > 0.0)) return false;
              const Eigen::Matrix2d inverse = F.inverse().transpose();
              P = shear_modulus * (F - inverse) + lame * std::log(J) * inverse;
              return true;
            };
            r.setZero();
            for (int i = 0; i < width; ++i) {
              const int from_middle = std::abs(2 * i - block.columns());
              const double share = from_middle < rows ? 1.0 : (from_middle == rows ? 0.5 : 0.0);
              r[row(i, rows) + 1] += share * load * block.h();
            }
            return add_forces(block, at, stress, [&](int i, int j, const Eigen::Vector2d& force) {
              if (j > 0) r.segment<2>(row(i, j)) += force;
            });
          }};
}

/// -div(grad u / sqrt(1 - |grad u|^2)) = f, the surface of given mean curvature in Minkowski's
/// space (Bartnik & Simon 1982, Commun. Math. Phys. 87, 131) and Born & Infeld's field of a charge;
/// linear triangles, u = 0 around; times h^2. Steeper than 1 it has no value; below, the least of a
/// strictly convex function.
Problem born_infeld(const char* name, int m, double charge) {
  const Grid grid{m};
  const double h = grid.h();
  return {name, false, Vector::Zero(m * m), [=](const Vector& u, Vector& r) {
            r.setConstant(-charge * h * h);
            const auto add = [&](int i, int j, double flux) {
              if (grid.inside(i, j)) r[grid.at(i, j)] += flux;
            };
            for (int j = -1; j < m; ++j) {
              for (int i = -1; i < m; ++i) {
                for (const int side : {1, -1}) {
                  const int a = side > 0 ? i : i + 1;
                  const int b = side > 0 ? j : j + 1;
                  const double x = grid.value(u, a + side, b) - grid.value(u, a, b);
                  const double y = grid.value(u, a, b + side) - grid.value(u, a, b);
                  const double room = 1.0 - (x * x + y * y) / (h * h);
                  if (!(room > 0.0)) return false;
                  const double weight = 0.5 / std::sqrt(room);
                  add(a + side, b, weight * x);
                  add(a, b + side, weight * y);
                  add(a, b, -weight * (x + y));
                }
              }
            }
            return true;
          }};
}

}  // namespace

void add_third_mechanics(std::vector<Problem>& problems) {
  problems.push_back(lattice("lattice, back again", 16, 4));
  problems.push_back(block_with_friction("block, friction", 8, 0.3));
  problems.push_back(rubber("rubber", 8, 0.3));
  problems.push_back(born_infeld("Born-Infeld", 20, 10.0));
}

}  // namespace peers
