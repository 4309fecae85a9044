#include "constitutive/curved_envelope.hpp"

#include <algorithm>
#include <cmath>

#include "accept_return.hpp"
#include "constitutive/rankine.hpp"
#include "constitutive/spectral.hpp"

namespace constitutive {

namespace detail {

namespace {

/// One plane of the surface, or two that meet at an edge: stresses of `a` (major, a mean of two at
/// the compression edge) and `b` (minor, likewise) lose the multiplier times these.
struct CurvedFlow {
  double a0, a1, b0, b1;  ///< Of a and b, without and times q.

  [[nodiscard]] double of_a(double q) const { return a0 + a1 * q; }
  [[nodiscard]] double of_b(double q) const { return b0 + b1 * q; }
};

/// A return along such a flow, with the derivatives of u's logarithm and the multiplier by a and b.
struct CurvedStep {
  bool found = false;
  CurvedPoint point{};
  double multiplier = 0;
  double u_by_a = 0, u_by_b = 0, multiplier_by_a = 0, multiplier_by_b = 0;
};

CurvedStep curved_step(const CurvedEnvelope& m, const CurvedFlow& flow, double a, double b) {
  const auto rest = [&](double u) {
    const CurvedPoint p = curved_point(m, u);
    const double of_a = flow.of_a(p.flow), of_b = flow.of_b(p.flow);
    return ValueAndSlope{(a + p.least) * of_b - (b + p.most) * of_a,
                         p.least_by * of_b - p.most_by * of_a +
                             p.flow_by * ((a + p.least) * flow.b1 - (b + p.most) * flow.a1)};
  };
  const double about = (m.apex() - (a + b) / 2) / m.stress;
  const CurvedRoot root = curved_root(
      rest, std::max(m.curve == Curve::hoek_brown ? m.coefficient * about / 4 : about, 1e-3));
  CurvedStep step;
  if (!root.found) return step;
  step.found = true;
  const CurvedPoint& p = step.point = curved_point(m, root.u);
  const double of_a = flow.of_a(p.flow), of_b = flow.of_b(p.flow);
  step.multiplier = (a + p.least) / of_a;
  // a + least = multiplier of_a, b + most = multiplier of_b.
  const double a_by = -p.least_by + step.multiplier * flow.a1 * p.flow_by;
  const double b_by = -p.most_by + step.multiplier * flow.b1 * p.flow_by;
  const double determinant = a_by * of_b - b_by * of_a;
  step.u_by_a = of_b / determinant;
  step.u_by_b = -of_a / determinant;
  step.multiplier_by_a = -b_by / determinant;
  step.multiplier_by_b = a_by / determinant;
  return step;
}

/// To the plane sigma_1, sigma_3 alone; the order may be wrong afterwards.
bool return_to_curved_plane(const CurvedEnvelope& m, const Eigen::Vector3d& trial,
                            PrincipalReturn& r) {
  const double shear = 2 * m.moduli.shear, lame = m.moduli.lame;
  const CurvedStep step = curved_step(m, {shear, lame, -shear, shear + lame}, trial[0], trial[2]);
  if (!step.found) return false;
  const CurvedPoint& p = step.point;
  r.stress << -p.least, trial[1] - step.multiplier * lame * p.flow, -p.most;
  const Eigen::RowVector3d by(step.u_by_a, 0, step.u_by_b);
  const Eigen::RowVector3d multiplier(step.multiplier_by_a, 0, step.multiplier_by_b);
  r.jacobian.row(0) = -p.least_by * by;
  r.jacobian.row(1) = -lame * (p.flow * multiplier + step.multiplier * p.flow_by * by);
  r.jacobian(1, 1) += 1;
  r.jacobian.row(2) = -p.most_by * by;
  r.regime = MohrCoulombRegime::plane;
  return true;
}

/// To the edge where the two larger (tension positive), or the two smaller, are equal.
/// @param is_told  the edge is known to be the one; else neither of its planes may pull back
bool return_to_curved_edge(const CurvedEnvelope& m, bool larger, bool is_told,
                           const Eigen::Vector3d& trial, PrincipalReturn& r) {
  const double shear = 2 * m.moduli.shear, lame = m.moduli.lame;
  const Eigen::RowVector3d of_a =
      larger ? Eigen::RowVector3d(0.5, 0.5, 0) : Eigen::RowVector3d(1, 0, 0);
  const Eigen::RowVector3d of_b =
      larger ? Eigen::RowVector3d(0, 0, 1) : Eigen::RowVector3d(0, 0.5, 0.5);
  const CurvedFlow flow = larger ? CurvedFlow{shear / 2, lame, -shear, shear + lame}
                                 : CurvedFlow{shear, lame, -shear / 2, shear / 2 + lame};
  const CurvedStep step = curved_step(m, flow, of_a.dot(trial), of_b.dot(trial));
  if (!step.found) return false;
  const CurvedPoint& p = step.point;
  const double apart = larger ? trial[0] - trial[1] : trial[1] - trial[2];
  const double of_each = larger ? shear : shear * (1 - p.flow);
  if (!is_told && apart > step.multiplier * of_each) return false;
  const Eigen::RowVector3d by = step.u_by_a * of_a + step.u_by_b * of_b;
  r.stress << -p.least, larger ? -p.least : -p.most, -p.most;
  r.jacobian.row(0) = -p.least_by * by;
  r.jacobian.row(2) = -p.most_by * by;
  r.jacobian.row(1) = r.jacobian.row(larger ? 0 : 2);
  r.regime = larger ? MohrCoulombRegime::compression_edge : MohrCoulombRegime::extension_edge;
  return true;
}

/// An envelope that begins as a parabola does, with an exponent of 1/2, is round there: circles
/// smaller than its curvature touch it at its end alone. They are those up to this sigma_1, whose
/// sigma_3 is the largest tension. Next to 1/2 it is what no u on offer tells from that.
double round_end(const CurvedEnvelope& m) {
  return m.curve == Curve::power_law ? curved_point(m, std::exp(-farthest_ln_u)).most : -m.apex();
}

/// To the largest tension, which bounds such circles as a tension cut-off does.
bool return_to_round_end(const CurvedEnvelope& m, const Eigen::Vector3d& trial,
                         PrincipalReturn& r) {
  const double tension = m.apex(), end = round_end(m);
  const PrincipalPlane first = rankine_plane(m.moduli, tension, 0),
                       second = rankine_plane(m.moduli, tension, 1);
  const auto takes = [&](const PlaneReturn& found, int planes) {
    if (!found.found || found.stress[planes] > tension || -found.stress[2] > end) return false;
    r.stress = found.stress;
    r.jacobian = found.jacobian;
    r.regime = MohrCoulombRegime::tension;
    return true;
  };
  return takes(return_to_planes<1>({&first}, trial, 1.0), 1) ||
         takes(return_to_planes<2>({&first, &second}, trial, 1.0), 2);
}

}  // namespace

CurvedPoint curved_point(const CurvedEnvelope& m, double u) {
  // Normal stress, shear strength and its slope, and derivatives by ln u.
  double normal = 0, normal_by = 0, shear = 0, slope = 0, slope_by = 0;
  const double a = m.exponent, power = std::pow(u, a);
  if (m.curve == Curve::hoek_brown) {
    const double k = a * m.coefficient * power / u, two = 2 + k, root = std::sqrt(1 + k);
    const double unit = m.stress / m.coefficient;
    normal = (u - m.cohesive) * unit + m.stress * power / two;
    normal_by = u * unit * (1 + k / two + (1 - a) / a * (k / two) * (k / two));
    shear = m.stress * power * root / two;
    slope = k / (2 * root);
    slope_by = (a - 1) * slope * two / (2 * (1 + k));
  } else {
    normal = (u - m.cohesive) * m.stress;
    normal_by = u * m.stress;
    shear = m.coefficient * m.stress * power;
    slope = m.coefficient * a * power / u;
    slope_by = (a - 1) * slope;
  }
  shear /= m.factor;
  slope /= m.factor;
  slope_by /= m.factor;
  const double secant = std::sqrt(1 + slope * slope), sum = secant + slope;
  CurvedPoint point{};
  point.rise = sum * sum;
  point.least = normal - shear / sum;
  point.most = normal + shear * sum;
  const double centre_by = normal_by * secant * secant + shear * slope_by;
  point.least_by = 2 * centre_by / (1 + point.rise);
  point.most_by = point.rise * point.least_by;
  const double rise_by = 2 * point.rise / secant * slope_by;
  const double k = m.dilation_ratio * (point.rise - 1);
  point.flow = k / (1 + k);
  point.flow_by = m.dilation_ratio * rise_by / ((1 + k) * (1 + k));
  return point;
}

double curved_excess(const CurvedEnvelope& m, double major, double minor) {
  if (major >= m.apex()) {
    return major - m.apex() + (-minor > round_end(m) ? std::max(0.0, major - minor) : 0.0);
  }
  const bool closed = m.curve == Curve::hoek_brown && m.factor == 1;
  // Of Hoek and Brown's undivided, and of the others more or less.
  const double first =
      m.cohesive - (m.curve == Curve::hoek_brown ? m.coefficient : 1.0) * major / m.stress;
  const auto beyond = [&](double u) {
    const CurvedPoint p = curved_point(m, u);
    return ValueAndSlope{-major - p.least, -p.least_by};
  };
  constexpr double least = 1e-9;
  const CurvedRoot root =
      closed ? CurvedRoot{true, first} : curved_root(beyond, std::max(first, least));
  if (!root.found) return major - minor;
  const CurvedPoint point = curved_point(m, root.u);
  return (-minor - point.most) / point.rise;
}

double curved_radius(const CurvedEnvelope& m, double centre) {
  const CurvedRoot root = curved_root(
      [&](double u) {
        const CurvedPoint p = curved_point(m, u);
        return ValueAndSlope{centre - (p.least + p.most) / 2, -(p.least_by + p.most_by) / 2};
      },
      std::max(m.cohesive + centre / m.stress, 1e-3));
  if (!root.found) return std::max(0.0, centre + m.apex());
  const CurvedPoint point = curved_point(m, root.u);
  return (point.most - point.least) / 2;
}

PrincipalReturn return_principal(const CurvedEnvelope& m, const Eigen::Vector3d& trial) {
  PrincipalReturn r;
  r.stress = trial;
  r.jacobian.setIdentity();
  const double size = trial.cwiseAbs().maxCoeff() + m.apex();
  if (curved_excess(m, trial[0], trial[2]) <= yield_round_off * size) return r;
  if (return_to_curved_plane(m, trial, r)) {
    const bool larger = r.stress[1] > r.stress[0];
    if (!larger && r.stress[1] >= r.stress[2]) return r;
    if (return_to_curved_edge(m, larger, true, trial, r)) return r;
  } else {
    for (const bool larger : {true, false}) {
      if (return_to_curved_edge(m, larger, false, trial, r)) return r;
    }
  }
  if (return_to_round_end(m, trial, r)) return r;
  r.regime = MohrCoulombRegime::apex;
  r.stress.setConstant(m.apex());
  r.jacobian.setZero();
  return r;
}

}  // namespace detail

template <int Dim>
UpdateOutcome update(const CurvedEnvelope& material,
                     const std::type_identity_t<StressVector<Dim>>& trial,
                     const PointState<Dim>& s0, PointState<Dim>& s1) {
  s1 = s0;
  if (!std::isfinite(j2(trial)) || !std::isfinite(trace(trial))) return {.failed = true};
  const Spectrum x = spectrum(trial);
  const detail::PrincipalReturn r = detail::return_principal(material, x.values);
  if (r.regime == detail::MohrCoulombRegime::elastic) {
    s1.stress = trial;
    return {};
  }
  detail::accept_return(material.moduli, x, r.stress, s1);
  return {.apex = r.regime == detail::MohrCoulombRegime::apex, .plastic = true};
}

template <int Dim>
TangentMatrix<Dim> trial_tangent(const CurvedEnvelope& material,
                                 const std::type_identity_t<StressVector<Dim>>& trial,
                                 const PointState<Dim>& /*s0*/) {
  const Spectrum x = spectrum(trial);
  const detail::PrincipalReturn r = detail::return_principal(material, x.values);
  if (r.regime == detail::MohrCoulombRegime::elastic) return TangentMatrix<Dim>::Identity();
  return isotropic_function_derivative<Dim>(x, r.stress, r.jacobian);
}

template UpdateOutcome update(const CurvedEnvelope&, const std::type_identity_t<StressVector<2>>&,
                              const PointState<2>&, PointState<2>&);
template UpdateOutcome update(const CurvedEnvelope&, const std::type_identity_t<StressVector<3>>&,
                              const PointState<3>&, PointState<3>&);
template TangentMatrix<2> trial_tangent(const CurvedEnvelope&,
                                        const std::type_identity_t<StressVector<2>>&,
                                        const PointState<2>&);
template TangentMatrix<3> trial_tangent(const CurvedEnvelope&,
                                        const std::type_identity_t<StressVector<3>>&,
                                        const PointState<3>&);

}  // namespace constitutive
