#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "limit/algebra/equation_builder.hpp"
#include "limit/problem/bare_corners.hpp"
#include "limit/programme/parabola_cones.hpp"
#include "limit/programme/stress_forms.hpp"
#include "limit/programme/yield_cones.hpp"

namespace limit::programme {

/// Adds factor x a linear form in the (p, d, t) of a stress to the equation begun last.
void add_form(algebra::EquationBuilder& equations, Eigen::Index stress, const Form& form,
              double factor = 1.0);

/// The stresses of a lower bound: Bezier points with a cone each, the corners of all triangles and
/// then the middles of those whose weight is linear; and what else is known of them, in cones of
/// its own after these.
class StressPoints {
 public:
  /// A stress that is the sum of these, by first variables.
  using Shares = std::vector<std::pair<Eigen::Index, double>>;

  /// @param edges  of the problem's mesh
  StressPoints(const problem::Problem& problem, const Parabolas& parabolas,
               const std::vector<mesh::Edge>& edges);
  StressPoints(const StressPoints&) = delete;
  StressPoints& operator=(const StressPoints&) = delete;

  [[nodiscard]] const std::vector<YieldCone>& cones() const { return cones_; }
  [[nodiscard]] const std::vector<Eigen::Vector3d>& starts() const { return starts_; }
  [[nodiscard]] Eigen::Index multiplier() const {
    return 3 * static_cast<Eigen::Index>(cones_.size());
  }
  [[nodiscard]] Eigen::Index corner(int triangle, int node) const;
  /// The Bezier point of the middle of a side, from inside a triangle: one of its own or the mean
  /// of the ends'.
  [[nodiscard]] Shares middle(int triangle, const mesh::Edge& edge) const;
  /// First of the middles of the sides 01 12 20; -1: the stress is linear.
  [[nodiscard]] Eigen::Index middles(std::size_t triangle) const { return middles_[triangle]; }
  [[nodiscard]] bool is_quadratic(int triangle) const {
    return triangle >= 0 && middles_[static_cast<std::size_t>(triangle)] >= 0;
  }
  /// Where soil without tension bears along a face only, or nothing; else none.
  [[nodiscard]] const problem::BareCorner* bare(Eigen::Index stress) const {
    return bare_points_[static_cast<std::size_t>(stress / 3)];
  }

  /// Adds the equations by which the cones are of one and the same stress.
  void equations(algebra::EquationBuilder& equations) const;
  /// Tells a program where its curved envelopes are.
  void tell(ConeProgram& program) const { curves_.tell(program); }

 private:
  void add_cones();
  void add_cone(const problem::Soil& local, const mesh::Point& place,
                const problem::BareCorner* bare);
  void add_curved(const mesh::Triangle& triangle, int i);
  /// Pressures of nodes on sides whose normal traction is given; elsewhere none.
  [[nodiscard]] std::vector<std::optional<double>> given_pressures() const;
  [[nodiscard]] double guess(const problem::Soil& soil, int region, int node) const;
  void add_cut(std::size_t corner);
  void add_pressure(std::size_t point);
  void add_contacts(const mesh::Edge& edge);
  [[nodiscard]] const mesh::Point& node_of(const mesh::Triangle& triangle, int i) const;
  [[nodiscard]] const problem::BareCorner* bare_at(std::size_t triangle, int point) const;
  void copies(algebra::EquationBuilder& equations) const;
  void contacts(algebra::EquationBuilder& equations) const;
  void bare_corners(algebra::EquationBuilder& equations) const;

  const problem::Problem& problem_;
  const Parabolas& parabolas_;
  Overburden overburden_;
  std::vector<std::optional<double>> given_pressures_;  // of the nodes
  std::vector<double> unconfined_;                      // of the soils, where they are curved
  std::vector<YieldCone> cones_;
  std::vector<Eigen::Vector3d> starts_;
  ParabolaCones curves_{cones_, starts_};
  std::vector<Eigen::Index> middles_;
  // The stress of a corner, and the variable that is its normal component.
  struct Contact {
    Eigen::Index stress, variable;
    mesh::Point normal;
  };
  std::vector<Contact> contacts_;
  std::vector<std::optional<YieldCone>> cuts_;                 // of the stresses
  std::vector<problem::BareTriangle> bare_;                    // of the triangles
  std::vector<const problem::BareCorner*> bare_points_;        // of the stresses
  std::vector<std::pair<Eigen::Index, Eigen::Index>> copies_;  // first variables
};

}  // namespace limit::programme
