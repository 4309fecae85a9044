#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "block.hpp"
#include "fourth_set.hpp"
#include "grid.hpp"

namespace peers {
namespace {

/// Stress of a von Mises material of Young's modulus and yield stress 1 that hardens by 0.01 of the
/// modulus, stretched from rest in plane strain (radial return, Simo & Hughes 1998); strains are
/// thus in units of that of yield.
Eigen::Matrix2d von_mises(const Eigen::Matrix2d& H) {
  constexpr double hardening = 0.01;
  const double yield = std::sqrt(2.0 / 3.0);
  const double volume = H.trace();
  Eigen::Matrix2d deviator = shear_modulus * (H + H.transpose());
  deviator.diagonal().array() -= 2.0 / 3.0 * shear_modulus * volume;
  const double along = deviator.trace();  // the negative of its third diagonal component
  const double size = std::sqrt(deviator.squaredNorm() + along * along);
  if (size > yield) {
    const double flow = (size - yield) / (2.0 * shear_modulus + 2.0 / 3.0 * hardening);
    deviator *= 1.0 - 2.0 * shear_modulus * flow / size;
  }
  deviator.diagonal().array() += (lame + 2.0 / 3.0 * shear_modulus) * volume;
  return deviator;
}

/// A quarter of an elastoplastic strip with two notches that leave half of its width, pulled by its
/// end in one step (Nagtegaal, Parks & Rice 1974, Comput. Methods Appl. Mech. Eng. 4, 153).
Problem notched_strip(const char* name, int rows, double pull) {
  const Block block{rows};
  const int width = block.columns() + 1;
  std::vector<Eigen::Index> index;  // of unknowns, 2 per node; negative: held, or pulled above
  Eigen::Index unknowns = 0;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i < width; ++i) {
      const bool held_along_x = i == width - 1;
      const bool held_along_y = j == rows || (j == 0 && i >= rows);
      index.push_back(held_along_x ? -1 : unknowns++);
      index.push_back(held_along_y ? -1 : unknowns++);
    }
  }
  return {name, false, Vector::Zero(unknowns), [=](const Vector& u, Vector& r) {
            const auto of = [&](int i, int j, int axis) {
              return index[static_cast<std::size_t>(2 * (j * width + i) + axis)];
            };
            const auto at = [&](int i, int j) -> Eigen::Vector2d {
              const Eigen::Index x = of(i, j, 0), y = of(i, j, 1);
              return {x < 0 ? 0.0 : u[x], y < 0 ? (j == rows ? pull : 0.0) : u[y]};
            };
            const auto stress = [](const Eigen::Matrix2d& H, Eigen::Matrix2d& P) {
              P = von_mises(H);
              return true;
            };
            r.setZero();
            return add_forces(block, at, stress, [&](int i, int j, const Eigen::Vector2d& force) {
              for (int axis = 0; axis < 2; ++axis) {
                if (of(i, j, axis) >= 0) r[of(i, j, axis)] += force[axis];
              }
            });
          }};
}

/// A net of cables on the frame z = (x^2 - y^2) / 4, |x|, |y| <= 1, stretched by 0.1 % where it is
/// built on that surface. Wind lifts every node of one half, so that some of the cables that hang
/// there go slack: these have no stiffness. Forces over that of a stretched cable, displacements
/// over the size of a mesh. (Buchholdt 1985, An Introduction to Cable Roof Structures.)
Problem cable_net(const char* name, int m, double uplift) {
  constexpr double strain = 0.001;
  const Grid grid{m};
  const auto place = [=](int i, int j) -> Eigen::Vector3d {
    const double half = 0.5 * (m + 1);
    const double x = i + 1 - half;
    const double y = j + 1 - half;
    return {x, y, 0.25 * (x * x - y * y) / half};
  };
  return {name, false, Vector::Zero(3 * m * m), [=](const Vector& u, Vector& r) {
            const auto at = [&](int i, int j) -> Eigen::Vector3d {
              if (!grid.inside(i, j)) return place(i, j);
              return place(i, j) + u.segment<3>(3 * grid.at(i, j));
            };
            const auto force = [&](int i, int j, int di, int dj) -> Eigen::Vector3d {
              const Eigen::Vector3d cable = at(i + di, j + dj) - at(i, j);
              const double length = cable.norm();
              const double rest = (place(i + di, j + dj) - place(i, j)).norm() / (1.0 + strain);
              return std::max(0.0, length / rest - 1.0) / (strain * length) * cable;
            };
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              const Eigen::Vector3d wind(0.0, 0.0, 2 * i < m - 1 ? uplift : 0.0);
              r.segment<3>(3 * k) = -wind - force(i, j, 1, 0) - force(i, j, -1, 0) -
                                    force(i, j, 0, 1) - force(i, j, 0, -1);
            });
            return true;
          }};
}

}  // namespace

/// A membrane that is pushed up in one half and down in the other between two sloped walls:
/// the middle one of u - ceiling, -Laplace(u) - f and u - floor is zero; times h^2 the second
/// (Kinderlehrer & Stampacchia 1980, with two obstacles).
Problem two_walls(const char* name, int m) {
  const Grid grid{m};
  const double h = grid.h();
  return {name, false, Vector::Zero(m * m), [=](const Vector& u, Vector& r) {
            for_each_node(grid, [&](int i, int j, Eigen::Index k) {
              const double y = (j + 1) * h;
              const double f = 20.0 * std::sin(2.0 * std::numbers::pi * (i + 1) * h);
              const double load = grid.minus_laplacian(u, i, j) - h * h * f;
              const double ceiling = 0.05 + 0.2 * y;
              const double floor = 0.2 * y - 0.25;
              r[k] = std::max(u[k] - ceiling, std::min(u[k] - floor, load));
            });
            return true;
          }};
}

void add_fourth_mechanics(std::vector<Problem>& problems) {
  problems.push_back(notched_strip("notched strip", 8, 3.0));
  problems.push_back(cable_net("cable net", 9, 1.5));
  problems.push_back(two_walls("two walls", 24));
}

}  // namespace peers
