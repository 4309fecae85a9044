#pragma once

#include <Eigen/QR>
#include <optional>
#include <utility>
#include <vector>

#include "constitutive/material.hpp"
#include "constitutive/tensor.hpp"
#include "model/model.hpp"
#include "model/state.hpp"
#include "model/wall_points.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// A stress as it is seen behind a mirror.
/// @param sign  of each component of a vector there
template <int Dim>
constitutive::StressVector<Dim> behind_mirror(constitutive::StressVector<Dim> stress,
                                              const fpm::Vector<Dim>& sign);

/// Stress on a wall whose traction is known, of ground that is elastic there.
///
/// Rows that a wall cuts see strain, and so stress, to first order alone, while displacements are
/// of second order. So the displacement around a point of the wall is taken as the cubic function u
/// that fits what the particles moved by, u_a, and the tractions t of the wall around it best,
///   sum_a w_a V_a / h^d |u(x_a) - u_a|^2 / R^2
///     + beta sum_c w_c A_c / h^(d-1) |(s0 + D grad u(x_c)) n - t|^2 / E^2,
/// and the stress at the point is s0 + D grad u, with s0 that before the first step. What is linear
/// in space comes out as it is.
/// Departure: not in Chen, Huang & Lyamin 2020 (share/doc/decisions/wall-stress.md).
template <int Dim>
class WallStress {
 public:
  /// Nothing, if a wall around the point is held, meets another body or has a corner that points
  /// inwards, if there is another material or too little of the body around it, or if stress does
  /// not follow from the strain since the beginning: pore water, ground that stages place, Cam
  /// clay, strength that is divided.
  /// @param model  must outlive it
  /// @param particles  whose bodies are those that may serve one another
  /// @param foot  the point
  /// @param own  particle whose body the point is of
  static std::optional<WallStress> at(const scene::Scene& scene, const Model<Dim>& model,
                                      const std::vector<WallPoint<Dim>>& walls,
                                      const fpm::ParticleSet<Dim>& particles, const Foot<Dim>& foot,
                                      fpm::Index own);

  /// The stress [Pa] at the point, in place of what the particles' own says there. Where the ground
  /// is yielding it is that of its strength (yielding_on_wall); where it has yielded, strains are
  /// large, a thin body is bent or the fit does not bear the tractions it is a part of the way from
  /// the latter to the former, or the latter. Never beyond yield.
  [[nodiscard]] constitutive::StressVector<Dim> of(
      const State<Dim>& state, const constitutive::StressVector<Dim>& interpolated) const;

 private:
  static constexpr int stress_rows = constitutive::stress_size<Dim>;
  using Stress = constitutive::StressVector<Dim>;

  struct Served {
    fpm::Index particle;
    fpm::Vector<Dim> sign;  // of each component of what is behind a mirror
    double weight;          // of its row of the fit
  };
  struct Wall {
    fpm::Vector<Dim> normal, constant, growing;
    Stress initial;
    double weight;
    bool is_beside;  // next to the point
  };
  [[nodiscard]] fpm::Vector<Dim> borne_by(const Wall& wall, double load, double left_over) const;
  [[nodiscard]] Eigen::VectorXd wanted(const State<Dim>& state, double left_over) const;
  [[nodiscard]] Stress yielding(const State<Dim>& state, constitutive::PointState<Dim> here,
                                const fpm::Vector<Dim>& bears, const Stress& stress,
                                double known) const;
  [[nodiscard]] double jump_of_pressure(const State<Dim>& state) const;
  [[nodiscard]] double yielded(const State<Dim>& state, const Stress& stress) const;
  [[nodiscard]] double small(const State<Dim>& state, const Eigen::VectorXd& coefficients) const;
  [[nodiscard]] double unbalanced(const State<Dim>& state, const Stress& stress) const;
  [[nodiscard]] double share(const State<Dim>& state, const Stress& stress,
                             const Eigen::VectorXd& coefficients) const;
  [[nodiscard]] double explained(const State<Dim>& state, const Eigen::VectorXd& right) const;
  bool take_particles(const fpm::ParticleSet<Dim>& particles, const std::vector<char>& mirrors,
                      const fpm::Vector<Dim>& point, std::vector<fpm::Vector<Dim>>& places);
  bool take_walls(const std::vector<WallPoint<Dim>>& walls, const fpm::ParticleSet<Dim>& particles,
                  const Foot<Dim>& foot, std::vector<fpm::Vector<Dim>>& on);
  void take_thickness(const std::vector<WallPoint<Dim>>& walls,
                      const fpm::ParticleSet<Dim>& particles, const Foot<Dim>& foot);
  [[nodiscard]] Stress added_to(const State<Dim>& state, fpm::Index a) const;
  [[nodiscard]] double unbent(const State<Dim>& state) const;
  void take_initial(const std::vector<fpm::Vector<Dim>>& places,
                    const std::vector<fpm::Vector<Dim>>& on);
  void factor(const std::vector<fpm::Vector<Dim>>& places, const std::vector<fpm::Vector<Dim>>& on);

  const Model<Dim>* model_ = nullptr;
  fpm::Index own_ = 0;
  fpm::Index across_ = -1;               // of a thin body, that next to the wall across
  fpm::Vector<Dim> normal_;              // outward, unit
  double spacing_ = 0.0, radius_ = 0.0;  // [m]
  double area_ = 0.0;                    // [m^(Dim-1)] of the wall around
  double fades_ = 1.0;
  double fits_ = 1.0;  // which part of the initial stress a linear function bears
  bool begins_at_rest_ = true;
  Eigen::Matrix<double, stress_rows, stress_rows> stiffness_;
  double modulus_ = 1.0;  // [Pa]
  Stress initial_ = Stress::Zero();
  std::vector<Served> served_;
  // Of them, those next to the point, and how much each counts.
  std::vector<std::pair<std::size_t, double>> beside_;
  std::vector<Wall> walls_;
  std::size_t nearest_ = 0;  // of them, that the point is on
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> fit_;
};

}  // namespace model
