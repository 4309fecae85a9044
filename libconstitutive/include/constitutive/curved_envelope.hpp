#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "constitutive/elastic.hpp"
#include "constitutive/mohr_coulomb.hpp"
#include "constitutive/no_subpoints.hpp"
#include "constitutive/spectral.hpp"
#include "constitutive/state.hpp"

namespace constitutive {

/// Curved Mohr envelopes with their edges and apex, perfectly plastic; plane strain and 3D.
///
/// Compression positive, sigma_1 >= sigma_2 >= sigma_3, here and in what follows:
/// - Hoek-Brown (Hoek, Carranza-Torres & Corkum 2002): sigma_1 = sigma_3 + sigma_ci u^a with
///   u = m_b sigma_3 / sigma_ci + s;
/// - power law: tau = A p_r u^b with u = (sigma_n + T) / p_r.
///
/// The intermediate stress has no part in either. The flow is normal to the surface in the plane of
/// sigma_1 and sigma_3 but for its dilation: with K = d(sigma_1) / d(sigma_3) on the envelope it is
/// that of K_psi = 1 + dilation_ratio (K - 1), associated at a ratio of 1, without change of volume
/// at 0.
struct CurvedEnvelope {
  static constexpr std::array<ModelInfo, 2> models{
      {{.name = "hoek_brown",
        .doc = "rock by Hoek and Brown's curved envelope, true corners",
        .curve = Curve::hoek_brown},
       {.name = "power_law",
        .doc = "shear strength by a power of the normal stress, true corners",
        .curve = Curve::power_law}}};
  /// Its branches differ from point to point.
  static constexpr bool one_point_at_a_time = true;
  static constexpr bool without_subpoints = true;

  ElasticModuli moduli;
  Curve curve = Curve::hoek_brown;
  double stress = 1;          ///< sigma_ci or p_r [Pa].
  double coefficient = 1;     ///< m_b or A.
  double exponent = 0.5;      ///< a or b.
  double cohesive = 0;        ///< s or T / p_r.
  double factor = 1;          ///< Shear strengths, and the slope tan(phi), are divided by it.
  double dilation_ratio = 1;  ///< See above.

  static CurvedEnvelope make(const MaterialParameters& p, const ModelInfo& model) {
    CurvedEnvelope m;
    m.moduli = elastic_moduli(p.youngs_modulus, p.poissons_ratio);
    m.curve = model.curve;
    m.factor = p.strength_factor;
    m.dilation_ratio = p.dilation_ratio;
    if (model.curve == Curve::hoek_brown) {
      m.stress = p.intact_strength;
      m.coefficient = p.m_i * std::exp((p.gsi - 100) / (28 - 14 * p.disturbance));
      m.cohesive = std::exp((p.gsi - 100) / (9 - 3 * p.disturbance));
      m.exponent = 0.5 + (std::exp(-p.gsi / 15) - std::exp(-20.0 / 3.0)) / 6;
    } else {
      m.stress = p.reference_stress;
      m.coefficient = p.power_coefficient;
      m.cohesive = p.power_tension / p.reference_stress;
      m.exponent = p.power_exponent;
    }
    return m;
  }

  /// The largest tension [Pa].
  [[nodiscard]] double apex() const {
    return curve == Curve::hoek_brown ? cohesive * stress / coefficient : cohesive * stress;
  }
};

namespace detail {

/// A point of the envelope at u: the principal stresses of its circle (compression positive),
/// q = 1 - 1 / K_psi of the flow, and the derivatives of all by ln u.
struct CurvedPoint {
  double least, most, flow;
  double least_by, most_by, flow_by;
  double rise;  ///< K = d(sigma_1) / d(sigma_3).
};

inline CurvedPoint curved_point(const CurvedEnvelope& m, double u) {
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
  const double secant = std::hypot(1.0, slope), sum = secant + slope;
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

/// Where a function of ln u that falls from above to below zero is zero.
struct CurvedRoot {
  bool found = false;  ///< False: it is below zero from the apex on.
  double u = 0;
};

/// By Illinois' false position, bisected now and then.
/// @param from  a guess of u, > 0
template <class Function>
CurvedRoot curved_root(const Function& function, double from) {
  constexpr double most = 160;  // of |ln u|
  const auto at = [&](double v) { return function(std::exp(v)); };
  double low = std::clamp(std::log(from), -most, most), high = low;
  double at_low = at(low), at_high = at_low;
  for (double step = 0.25; at_low < 0; step *= 2) {
    if (low <= -most) return {};
    high = low;
    at_high = at_low;
    low = std::max(low - step, -most);
    at_low = at(low);
  }
  for (double step = 0.25; at_high > 0 && high < most; step *= 2) {
    low = high;
    at_low = at_high;
    high = std::min(high + step, most);
    at_high = at(high);
  }
  int side = 0;
  for (int count = 0; count < 200 && at_low != 0 && at_high != 0; ++count) {
    double v = (low * at_high - high * at_low) / (at_high - at_low);
    if (count % 4 == 3 || !(v > low && v < high)) v = low + (high - low) / 2;
    if (!(v > low && v < high)) break;
    const double here = at(v);
    const int now = here > 0 ? 1 : -1;
    if (now > 0) {
      low = v;
      at_low = here;
      if (side == now) at_high /= 2;
    } else {
      high = v;
      at_high = here;
      if (side == now) at_low /= 2;
    }
    side = now;
  }
  return {true, std::exp(at_high == 0 ? high : low)};
}

/// How far sorted principal stresses (falling order, tension positive) are outside, as a difference
/// of stresses along sigma_3; not positive inside.
inline double curved_excess(const CurvedEnvelope& m, double major, double minor) {
  if (major >= m.apex()) return major - m.apex() + (major - minor > 0 ? major - minor : 0);
  const bool closed = m.curve == Curve::hoek_brown && m.factor == 1;
  const double first = m.cohesive - major / m.stress;  // of the power law, more or less
  const CurvedRoot root =
      closed ? CurvedRoot{true, m.cohesive - m.coefficient * major / m.stress}
             : curved_root([&](double u) { return -major - curved_point(m, u).least; },
                           std::max(first, 1e-3));
  if (!root.found) return major - minor;
  const CurvedPoint point = curved_point(m, root.u);
  return (-minor - point.most) / point.rise;
}

/// Radius of the circle about a centre (compression positive) that touches the envelope.
inline double curved_radius(const CurvedEnvelope& m, double centre) {
  const CurvedRoot root = curved_root(
      [&](double u) {
        const CurvedPoint point = curved_point(m, u);
        return centre - (point.least + point.most) / 2;
      },
      std::max(m.cohesive + centre / m.stress, 1e-3));
  if (!root.found) return 0;
  const CurvedPoint point = curved_point(m, root.u);
  return (point.most - point.least) / 2;
}

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

inline CurvedStep curved_step(const CurvedEnvelope& m, const CurvedFlow& flow, double a, double b) {
  const auto rest = [&](double u) {
    const CurvedPoint p = curved_point(m, u);
    return (a + p.least) * flow.of_b(p.flow) - (b + p.most) * flow.of_a(p.flow);
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
inline bool return_to_curved_plane(const CurvedEnvelope& m, const Eigen::Vector3d& trial,
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
inline bool return_to_curved_edge(const CurvedEnvelope& m, bool larger, bool is_told,
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

/// Return of sorted principal trial stresses (falling order, tension positive) to the surface.
inline PrincipalReturn return_principal(const CurvedEnvelope& m, const Eigen::Vector3d& trial) {
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
  r.regime = MohrCoulombRegime::apex;
  r.stress.setConstant(m.apex());
  r.jacobian.setZero();
  return r;
}

}  // namespace detail

/// Stress update of `CurvedEnvelope` from the elastic trial stress, in principal stress space.
///
/// An admissible trial is returned bit for bit. `s0` and `s1` may be the same object. No
/// allocation.
/// @param trial  [Pa] elastic trial stress  @param s0  begin  @param[out] s1  end of the step
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
  s1.stress = recompose<Dim>(r.stress, x.directions);
  const Eigen::Vector3d removed = x.values - r.stress;
  const double p = removed.mean();
  const double sqrt_j2 = std::sqrt((removed.array() - p).square().sum() / 2);
  s1.plastic_strain += equivalent_elastic_strain(material.moduli, p, sqrt_j2);
  s1.plastic_volume_strain += p / material.moduli.bulk;
  return {.apex = r.regime == detail::MohrCoulombRegime::apex, .plastic = true};
}

/// d(stress)/d(trial stress) of `update` at a finite trial, the spin of the principal axes
/// included.
template <int Dim>
TangentMatrix<Dim> trial_tangent(const CurvedEnvelope& material,
                                 const std::type_identity_t<StressVector<Dim>>& trial,
                                 const PointState<Dim>& /*s0*/) {
  const Spectrum x = spectrum(trial);
  const detail::PrincipalReturn r = detail::return_principal(material, x.values);
  if (r.regime == detail::MohrCoulombRegime::elastic) return TangentMatrix<Dim>::Identity();
  return isotropic_function_derivative<Dim>(x, r.stress, r.jacobian);
}

}  // namespace constitutive
