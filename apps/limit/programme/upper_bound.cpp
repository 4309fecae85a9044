#include "limit/programme/upper_bound.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "limit/problem/local_soil.hpp"
#include "limit/programme/parabola_cones.hpp"
#include "limit/programme/velocity_shapes.hpp"
#include "limit/programme/weight_power.hpp"
#include "limit/programme/yield_cones.hpp"

namespace limit::programme {

namespace {

const mesh::Point& node_at(const mesh::Mesh& mesh, int node) {
  return mesh.nodes[static_cast<std::size_t>(node)];
}

// Equation of each motion of the footing, -1 for those it cannot have, and of how many in all.
struct Rows {
  explicit Rows(const problem::Problem& problem)
      : count(static_cast<int>(12 * problem.mesh.triangles.size())) {
    for (std::size_t motion = 0; motion < 3; ++motion) {
      footing[motion] = problem.footing.may_move[motion] ? count++ : -1;
    }
  }
  int count;
  std::array<int, 3> footing{};
};

// Power of the loads on each velocity.
struct Loads {
  Loads(const problem::Problem& problem, const std::vector<mesh::Edge>& edges)
      : dead(Eigen::VectorXd::Zero(Rows(problem).count)), live(dead) {
    const mesh::Mesh& mesh = problem.mesh;
    const problem::MeshPressure water = pressure_on_mesh(problem, problem::Bound::upper);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) add_weight(problem, water, t);
    for (const mesh::Edge& edge : edges) {
      if (edge.boundary < 0) continue;
      const problem::Boundary& on = problem.boundaries[static_cast<std::size_t>(edge.boundary)];
      const bool pushed = on.normal == problem::Known::traction,
                 sheared = on.tangential == problem::Known::traction;
      add_tractions(mesh, edge, pushed ? on.normal_stress : 0.0, sheared ? on.shear_stress : 0.0,
                    dead);
      add_tractions(mesh, edge, pushed ? on.live_normal_stress : 0.0,
                    sheared ? on.live_shear_stress : 0.0, live);
    }
    const Rows rows(problem);
    for (std::size_t motion = 0; motion < 3; ++motion) {
      if (rows.footing[motion] < 0) continue;
      dead[rows.footing[motion]] += problem.footing.dead_load[motion];
      live[rows.footing[motion]] += problem.footing.live_load[motion];
    }
  }

  Eigen::VectorXd dead, live;

 private:
  void add_weight(const problem::Problem& problem, const problem::MeshPressure& water,
                  std::size_t t) {
    const WeightForces forces = weight_forces(problem, water, t);
    for (std::size_t place = 0; place < 6; ++place) {
      const auto row = static_cast<Eigen::Index>(2 * (6 * t + place));
      dead.segment<2>(row) += forces.dead[place];
      live.segment<2>(row) += forces.live[place];
    }
  }

  // Simpson's rule, exact for a constant traction on a quadratic velocity.
  static void add_tractions(const mesh::Mesh& mesh, const mesh::Edge& edge, double normal,
                            double shear, Eigen::VectorXd& loads) {
    const mesh::Point along = node_at(mesh, edge.second) - node_at(mesh, edge.first);
    const mesh::Point outward(along.y(), -along.x());  // times the length, as `along` is
    const mesh::Point force = normal * outward + shear * along;
    const auto [first, middle, second] = places_along(mesh, edge.left, edge);
    loads.segment<2>(2 * first) += force / 6.0;
    loads.segment<2>(2 * middle) += force * (4.0 / 6.0);
    loads.segment<2>(2 * second) += force / 6.0;
  }
};

// Of the cohesion, of the tension of soil without any; of the unit of stress, of the cohesion of
// soil without any: what a stronger soil does not carry, a softer one does not, and there is a
// stress strictly within yield at free faces. The certificate knows what the mechanism dissipates
// without it.
constexpr double trace = 1e-4;

class Builder {
 public:
  Builder(const problem::Problem& problem, const Parabolas& parabolas)
      : problem_(problem),
        parabolas_(parabolas),
        edges_(mesh::edges_of(problem.mesh)),
        overburden_(problem),
        rows_(problem) {}

  ConeProgram program() {
    for (std::size_t t = 0; t < problem_.mesh.triangles.size(); ++t) add_triangle(t);
    for (const mesh::Edge& edge : edges_) add_side(edge);
    curves_.add_others();
    int equations = rows_.count;
    algebra::EquationBuilder of_curves;
    curves_.equations(of_curves);
    const Eigen::VectorXd right_side = of_curves.right_side();
    const auto curves = of_curves.matrix(3 * static_cast<Eigen::Index>(cones_.size()));
    for (Eigen::Index row = 0; row < curves.rows(); ++row) {
      for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator entry(curves, row); entry;
           ++entry) {
        add(equations, static_cast<int>(entry.col()), entry.value());
      }
      ++equations;
    }
    for (const Contact& contact : contacts_) {
      add(equations, contact.traction, 1.0);
      if (contact.has_deviator) add(equations, contact.traction + 1, 1.0);
      add(equations++, contact.variable, -1.0);
    }
    for (const auto& [column, cone] : cuts_) {
      const auto copy = static_cast<int>(3 * cones_.size());
      cones_.push_back(cone);
      starts_.push_back(inner_point(cone, -starts_[static_cast<std::size_t>(column / 3)][0]));
      for (int i = 0; i < 3; ++i) {
        add(equations, column + i, 1.0);
        add(equations++, copy + i, -1.0);
      }
    }
    if (problem_.most_multiplier) ++equations;
    if (problem_.most_multiplier) {
      cones_.push_back(half_line_cone(*problem_.most_multiplier));
      starts_.push_back(inner_point(cones_.back(), 0.0));
    }
    const auto multiplier = static_cast<int>(3 * cones_.size());
    const Loads loads(problem_, edges_);
    for (int row = 0; row < rows_.count; ++row) add(row, multiplier, -loads.live[row]);
    if (problem_.most_multiplier) {
      // What is left to the most, in the last cone.
      add(equations - 1, multiplier, 1.0);
      add(equations - 1, multiplier - 3, -1.0);
    }
    ConeProgram program;
    program.equations.resize(equations, multiplier + 1);
    program.equations.setFromTriplets(entries_.begin(), entries_.end());
    program.right_side = Eigen::VectorXd::Zero(equations);
    program.right_side.head(rows_.count) = loads.dead;
    program.right_side.segment(rows_.count, right_side.size()) = right_side;
    if (problem_.most_multiplier) program.right_side[equations - 1] = *problem_.most_multiplier;
    program.objective = Eigen::VectorXd::Unit(multiplier + 1, multiplier);
    program.start = Eigen::VectorXd::Zero(multiplier + 1);
    for (std::size_t k = 0; k < cones_.size(); ++k) {
      program.start.segment<3>(3 * static_cast<Eigen::Index>(k)) = starts_[k];
    }
    curves_.tell(program);
    program.cones = std::move(cones_);
    return program;
  }

 private:
  // First variable of a new cone.
  int add_cone(const problem::Soil& local, const mesh::Point& place, double cohesion) {
    const problem::Soil soil = local.with_cohesion(local.is_loose() ? trace : cohesion);
    const double load = overburden_.at(soil, place);
    cones_.push_back(yield_cone(soil, load, 0.0));
    starts_.push_back(inner_point(cones_.back(), load));
    const int column = 3 * static_cast<int>(cones_.size() - 1);
    if (soil.cuts_tension()) {
      problem::Soil cut = soil;
      cut.tension = std::max(soil.tension, trace * soil.cohesion);
      cuts_.emplace_back(column, tension_cone(cut, load, 0.0));
    }
    return column;
  }

  int add_curved(const problem::Soil& soil, const CurvedPoint& point, const mesh::Point& place) {
    const double load = parabolas_.guesses_least() ? 0.0 : overburden_.at(soil, place);
    const double guess = load + soil.envelope.unconfined() / 2.0;
    curves_.add(soil.envelope, parabolas_.at(soil, point, guess, problem::Bound::upper), point,
                0.0);
    return 3 * static_cast<int>(cones_.size() - 1);
  }

  // A normal traction (variable `traction`) that may not pull, as a variable of its own: the
  // multiplier of their equality is the opening, which costs nothing.
  void add_contact(int traction, bool has_deviator) {
    contacts_.push_back({traction, 3 * static_cast<int>(cones_.size()), has_deviator});
    cones_.push_back(contact_cone(cones_[static_cast<std::size_t>(traction / 3)].scale, 0.0));
    starts_.push_back(inner_point(cones_.back(), 0.0));
  }

  void add(int row, int column, double value) {
    if (value != 0.0) entries_.emplace_back(row, column, value);
  }

  // Power of the corners' stresses, a third of the area each, p (exx + eyy) + d (exx - eyy) +
  // t gxy.
  void add_triangle(std::size_t t) {
    const mesh::Mesh& mesh = problem_.mesh;
    const mesh::Triangle& triangle = mesh.triangles[t];
    const VelocityTriangle shapes = velocity_triangle(mesh, triangle);
    const double weight = shapes.area / 3.0;
    const problem::Soil soil = problem::soil_in(problem_, triangle, problem::Bound::upper);
    double sum = 0.0;
    mesh::Point centre(0.0, 0.0);
    for (const int node : triangle.nodes) {
      sum += soil.cohesion_at(node_at(mesh, node));
      centre += node_at(mesh, node) / 3.0;
    }
    for (std::size_t corner = 0; corner < 3; ++corner) {
      // The integral of a linear cohesion times a linear rate.
      const mesh::Point& place = node_at(mesh, triangle.nodes[corner]);
      const double cohesion = (sum + soil.cohesion_at(place)) / 4.0;
      const int column =
          soil.is_curved()
              ? add_curved(soil, {0, triangle.region, false, towards(place, centre)}, place)
              : add_cone(soil, place, cohesion);
      for (std::size_t i = 0; i < 6; ++i) {
        const auto row = static_cast<int>(2 * (6 * t + i));
        const mesh::Point slope = weight * shapes.slopes[corner][i];
        add(row, column, slope.x());
        add(row, column + 1, slope.x());
        add(row, column + 2, slope.y());
        add(row + 1, column, slope.y());
        add(row + 1, column + 1, -slope.y());
        add(row + 1, column + 2, slope.x());
      }
    }
  }

  // Power of the tractions at the control points of the jump across a side: of the neighbour's
  // velocity, the footing's or nothing, less that of the triangle. (p, t) is (normal, shear x
  // cos(phi)); d stays out. Where tension is cut off or the envelope curved, it is the stress of a
  // thin layer, whose third component has no power: p + d is normal, t the shear.
  void add_side(const mesh::Edge& edge) {
    bool has_shear = true, may_open = false;
    if (edge.boundary >= 0) {
      const problem::Boundary& boundary =
          problem_.boundaries[static_cast<std::size_t>(edge.boundary)];
      if (boundary.normal == problem::Known::traction &&
          boundary.tangential != problem::Known::traction) {
        throw std::invalid_argument("boundary " + boundary.name +
                                    ": it is held along but not across itself");
      }
      if (boundary.normal == problem::Known::traction) return;
      has_shear = boundary.tangential != problem::Known::traction;
      may_open = boundary.may_open;
    }
    const mesh::Mesh& mesh = problem_.mesh;
    const mesh::Point along = node_at(mesh, edge.second) - node_at(mesh, edge.first);
    const problem::Soil soil = problem::soil_across(problem_, edge);
    const double cosine = std::cos(soil.friction_angle);
    const double length = along.norm();
    const mesh::Point tangent = along / length, normal(tangent.y(), -tangent.x());
    const std::array<mesh::Point, 3> at{node_at(mesh, edge.first),
                                        node_at(mesh, edge.first) + along / 2,
                                        node_at(mesh, edge.second)};
    const auto inside = places_along(mesh, edge.left, edge);
    constexpr std::array<std::array<double, 3>, 3> control{
        {{1.0, 0.0, 0.0}, {-0.5, 2.0, -0.5}, {0.0, 0.0, 1.0}}};
    for (std::size_t c = 0; c < 3; ++c) {
      // The mean of a linear cohesion over the control point's share of a jump lies between.
      const double share = 0.25 + 0.25 * static_cast<double>(c);
      const double cohesion =
          (1.0 - share) * soil.cohesion_at(at[0]) + share * soil.cohesion_at(at[2]);
      const int column =
          soil.is_curved()
              ? add_curved(soil,
                           {0, problem::region_across(problem_, edge), true, towards(at[c], at[1])},
                           at[c])
              : add_cone(soil, at[c], cohesion);
      const bool cut = soil.cuts_tension() || soil.is_curved();
      if (may_open) add_contact(column, cut);
      for (std::size_t i = 0; i < 3; ++i) {
        const double factor = control[c][i] * length / 3.0;
        const mesh::Point n = factor * normal;
        const mesh::Point s =
            has_shear ? mesh::Point((cut ? factor : factor / cosine) * tangent) : mesh::Point(0, 0);
        add_power(2 * inside[i], column, -n, -s, cut);
        if (edge.right >= 0) {
          add_power(2 * places_along(mesh, edge.right, edge)[i], column, n, s, cut);
        } else {
          add_footing_power(edge.boundary, at[i], column, n, s, cut);
        }
      }
    }
  }

  void add_power(int row, int column, const mesh::Point& normal, const mesh::Point& shear,
                 bool has_deviator) {
    for (int xy = 0; xy < 2; ++xy) {
      add(row + xy, column, normal[xy]);
      if (has_deviator) add(row + xy, column + 1, normal[xy]);
      add(row + xy, column + 2, shear[xy]);
    }
  }

  void add_footing_power(int boundary, const mesh::Point& at, int column, const mesh::Point& normal,
                         const mesh::Point& shear, bool has_deviator) {
    const problem::Boundary& conditions = problem_.boundaries[static_cast<std::size_t>(boundary)];
    for (int motion = 0; motion < 3; ++motion) {
      const int row = rows_.footing[static_cast<std::size_t>(motion)];
      if (row < 0) continue;
      const mesh::Point velocity = rigid_velocity(at - problem_.footing.centre, motion);
      if (conditions.normal == problem::Known::footing) {
        add(row, column, normal.dot(velocity));
        if (has_deviator) add(row, column + 1, normal.dot(velocity));
      }
      if (conditions.tangential == problem::Known::footing)
        add(row, column + 2, shear.dot(velocity));
    }
  }

  const problem::Problem& problem_;
  const Parabolas& parabolas_;
  std::vector<mesh::Edge> edges_;
  Overburden overburden_;
  Rows rows_;
  std::vector<YieldCone> cones_;
  std::vector<Eigen::Vector3d> starts_;
  ParabolaCones curves_{cones_, starts_};
  struct Contact {
    int traction, variable;
    bool has_deviator;
  };
  std::vector<Contact> contacts_;
  std::vector<std::pair<int, YieldCone>> cuts_;  // of which variables, Rankine's cone
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace

ConeProgram upper_bound_program(const problem::Problem& problem, const Parabolas& parabolas) {
  return Builder(problem, parabolas).program();
}

problem::VelocityField velocity_field(const problem::Problem& problem,
                                      const Eigen::VectorXd& multipliers) {
  problem::VelocityField field;
  const std::size_t triangles = problem.mesh.triangles.size();
  field.footing.setZero();
  const Rows rows(problem);
  for (std::size_t motion = 0; motion < 3; ++motion) {
    if (rows.footing[motion] < 0) continue;
    field.footing[static_cast<Eigen::Index>(motion)] = multipliers[rows.footing[motion]];
  }
  const Eigen::VectorXd live = Loads(problem, mesh::edges_of(problem.mesh)).live;
  const double power = live.dot(multipliers.head(live.size()));
  // The multipliers are the velocities turned round. Without power of the live loads, as where the
  // multiplier has no end, the size is left as it is.
  const double scale = power < 0.0 ? 1.0 / power : -1.0;
  field.footing *= scale;
  for (std::size_t t = 0; t < triangles; ++t) {
    field.triangles.emplace_back(
        scale * Eigen::Map<const Eigen::Matrix<double, 2, 6>>(multipliers.data() + 12 * t));
  }
  return field;
}

}  // namespace limit::programme
