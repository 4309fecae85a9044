#include "fpm/boundary_loads.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace fpm {
namespace {

// det(F) F^-T without a division. In 2D it is linear in F.
Tensor<2> cofactor(const Tensor<2>& f) {
  Tensor<2> c;
  c << f(1, 1), -f(1, 0), -f(0, 1), f(0, 0);
  return c;
}

Tensor<3> cofactor(const Tensor<3>& f) {
  Tensor<3> c;
  for (int j = 0; j < 3; ++j) c.col(j) = f.col((j + 1) % 3).cross(f.col((j + 2) % 3));
  return c;
}

Tensor<2> cofactor_change(const Tensor<2>&, const Tensor<2>& df) {
  return cofactor(df);
}

Tensor<3> cofactor_change(const Tensor<3>& f, const Tensor<3>& df) {
  Tensor<3> c;
  for (int j = 0; j < 3; ++j) {
    const int k = (j + 1) % 3;
    const int l = (j + 2) % 3;
    c.col(j) = df.col(k).cross(f.col(l)) + f.col(k).cross(df.col(l));
  }
  return c;
}

template <int Dim>
void check_shapes(const PointOperator<Dim>& op, const BoundaryPoints<Dim>& points,
                  Eigen::Index force_rows) {
  require_size("boundary points", points.size(), op.size());
  require_size("force", force_rows, op.particle_count());
}

template <int Dim>
Vector<Dim> masked(const PenaltyOptions<Dim>& options, Vector<Dim> v) {
  for (int i = 0; i < Dim; ++i) {
    if (!options.prescribed[static_cast<std::size_t>(i)]) v[i] = 0.0;
  }
  return v;
}

}  // namespace

template <int Dim>
void add_traction(const PointOperator<Dim>& op, const BoundaryPoints<Dim>& points,
                  const FieldView<Dim>& traction, FieldTarget<Dim> force) {
  check_shapes(op, points, force.rows());
  require_size("tractions", traction.rows(), op.size());
  for (Index c = 0; c < op.size(); ++c) {
    op.add_transposed_value(c, points.weight[c] * traction.row(c).transpose(), force);
  }
}

template <int Dim>
void add_uniform_traction(const PointOperator<Dim>& op, const BoundaryPoints<Dim>& points,
                          const Vector<Dim>& traction, FieldTarget<Dim> force) {
  check_shapes(op, points, force.rows());
  for (Index c = 0; c < op.size(); ++c) {
    op.add_transposed_value(c, points.weight[c] * traction, force);
  }
}

template <int Dim>
std::optional<Index> add_following_pressure(const PointOperator<Dim>& op,
                                            const BoundaryPoints<Dim>& points, double pressure,
                                            const FieldView<Dim>& displacement,
                                            FieldTarget<Dim> force) {
  check_shapes(op, points, force.rows());
  require_size("displacement", displacement.rows(), op.particle_count());
  for (Index c = 0; c < op.size(); ++c) {
    const Tensor<Dim> f = Tensor<Dim>::Identity() + op.gradient(c, displacement);
    if (!(f.determinant() > 0.0)) return c;  // so that a NaN is refused
    const Vector<Dim> area = points.weight[c] * (cofactor(f) * points.normal.row(c).transpose());
    op.add_transposed_value(c, -pressure * area, force);
  }
  return std::nullopt;
}

template <int Dim>
void add_following_pressure_action(const PointOperator<Dim>& op, const BoundaryPoints<Dim>& points,
                                   double pressure, const FieldView<Dim>& displacement,
                                   const FieldView<Dim>& direction, FieldTarget<Dim> force) {
  check_shapes(op, points, force.rows());
  require_size("displacement", displacement.rows(), op.particle_count());
  require_size("direction", direction.rows(), op.particle_count());
  for (Index c = 0; c < op.size(); ++c) {
    const Tensor<Dim> f = Tensor<Dim>::Identity() + op.gradient(c, displacement);
    const Tensor<Dim> change = cofactor_change(f, op.gradient(c, direction));
    const Vector<Dim> area = points.weight[c] * (change * points.normal.row(c).transpose());
    op.add_transposed_value(c, -pressure * area, force);
  }
}

template <int Dim>
std::vector<std::string> validate(const PenaltyOptions<Dim>& options) {
  std::vector<std::string> messages;
  if (!(options.penalty > 0.0)) messages.push_back("the penalty must be positive");
  if (options.prescribed == PenaltyOptions<Dim>::filled(false)) {
    messages.push_back("the penalty prescribes no component");
  }
  return messages;
}

template <int Dim>
Vector<Dim> add_penalty_force(const PointOperator<Dim>& op, const BoundaryPoints<Dim>& points,
                              const PenaltyOptions<Dim>& options, const FieldView<Dim>& target,
                              const FieldView<Dim>& displacement, FieldTarget<Dim> force) {
  check_shapes(op, points, force.rows());
  require_size("prescribed displacements", target.rows(), op.size());
  require_size("displacement", displacement.rows(), op.particle_count());
  Vector<Dim> reaction = Vector<Dim>::Zero();
  for (Index c = 0; c < op.size(); ++c) {
    const Vector<Dim> gap =
        masked(options, Vector<Dim>(op.value(c, displacement) - target.row(c).transpose()));
    const Vector<Dim> point_force = options.penalty * points.weight[c] * gap;
    op.add_transposed_value(c, point_force, force);
    reaction -= point_force;
  }
  return reaction;
}

template <int Dim>
void add_penalty_action(const PointOperator<Dim>& op, const BoundaryPoints<Dim>& points,
                        const PenaltyOptions<Dim>& options, const FieldView<Dim>& direction,
                        FieldTarget<Dim> force) {
  check_shapes(op, points, force.rows());
  require_size("direction", direction.rows(), op.particle_count());
  for (Index c = 0; c < op.size(); ++c) {
    const Vector<Dim> change = masked(options, op.value(c, direction));
    op.add_transposed_value(c, options.penalty * points.weight[c] * change, force);
  }
}

template <int Dim>
double penalty_energy(const PointOperator<Dim>& op, const BoundaryPoints<Dim>& points,
                      const PenaltyOptions<Dim>& options, const FieldView<Dim>& target,
                      const FieldView<Dim>& displacement) {
  check_shapes(op, points, displacement.rows());
  require_size("prescribed displacements", target.rows(), op.size());
  double energy = 0.0;
  for (Index c = 0; c < op.size(); ++c) {
    const Vector<Dim> gap =
        masked(options, Vector<Dim>(op.value(c, displacement) - target.row(c).transpose()));
    energy += 0.5 * options.penalty * points.weight[c] * gap.squaredNorm();
  }
  return energy;
}

#define FPM_INSTANTIATE(Dim)                                                                     \
  template void add_traction<Dim>(const PointOperator<Dim>&, const BoundaryPoints<Dim>&,         \
                                  const FieldView<Dim>&, FieldTarget<Dim>);                      \
  template void add_uniform_traction<Dim>(const PointOperator<Dim>&, const BoundaryPoints<Dim>&, \
                                          const Vector<Dim>&, FieldTarget<Dim>);                 \
  template std::optional<Index> add_following_pressure<Dim>(                                     \
      const PointOperator<Dim>&, const BoundaryPoints<Dim>&, double, const FieldView<Dim>&,      \
      FieldTarget<Dim>);                                                                         \
  template void add_following_pressure_action<Dim>(                                              \
      const PointOperator<Dim>&, const BoundaryPoints<Dim>&, double, const FieldView<Dim>&,      \
      const FieldView<Dim>&, FieldTarget<Dim>);                                                  \
  template std::vector<std::string> validate<Dim>(const PenaltyOptions<Dim>&);                   \
  template Vector<Dim> add_penalty_force<Dim>(                                                   \
      const PointOperator<Dim>&, const BoundaryPoints<Dim>&, const PenaltyOptions<Dim>&,         \
      const FieldView<Dim>&, const FieldView<Dim>&, FieldTarget<Dim>);                           \
  template void add_penalty_action<Dim>(const PointOperator<Dim>&, const BoundaryPoints<Dim>&,   \
                                        const PenaltyOptions<Dim>&, const FieldView<Dim>&,       \
                                        FieldTarget<Dim>);                                       \
  template double penalty_energy<Dim>(const PointOperator<Dim>&, const BoundaryPoints<Dim>&,     \
                                      const PenaltyOptions<Dim>&, const FieldView<Dim>&,         \
                                      const FieldView<Dim>&);
FPM_INSTANTIATE(2)
FPM_INSTANTIATE(3)
#undef FPM_INSTANTIATE

}  // namespace fpm
