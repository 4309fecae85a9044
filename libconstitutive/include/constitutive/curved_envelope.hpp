#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "constitutive/elastic.hpp"
#include "constitutive/mohr_coulomb.hpp"
#include "constitutive/no_subpoints.hpp"
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

CurvedPoint curved_point(const CurvedEnvelope& m, double u);

/// Beyond it, at either end, u is not asked for.
constexpr double farthest_ln_u = 160;

/// Where a function of ln u that falls from above to below zero is zero.
struct CurvedRoot {
  bool found = false;  ///< False: it is below zero from the apex on.
  double u = 0;
};

/// Of a function of ln u.
struct ValueAndSlope {
  double value, slope;
};

/// By Newton's method in ln u between what is known to be above and below zero.
/// @param function  of u: its value and its derivative by ln u
/// @param from  a guess of u, > 0
template <class Function>
CurvedRoot curved_root(const Function& function, double from) {
  constexpr double most = farthest_ln_u;
  constexpr double round_off = 2e-16;  // of ln u, where that is not less than 1
  constexpr int usual = 16, enough = 200;
  double above = -INFINITY, below = INFINITY, v = std::clamp(std::log(from), -most, most);
  // Of a step; the nearest zero is sought, and farther away there may be another one.
  double farthest = 0.25;
  for (int count = 0; count < enough; ++count) {
    const auto [value, slope] = function(std::exp(v));
    if (value == 0) break;
    (value > 0 ? above : below) = v;
    if (below <= -most) return {};
    if (above >= most) break;
    const double newton = slope < 0 ? -value / slope : value > 0 ? INFINITY : -INFINITY;
    if (std::abs(newton) <= round_off * std::max(1.0, std::abs(v))) break;
    const bool is_between = std::isfinite(below - above);
    double next = v + newton;
    if (!is_between) {
      next = std::clamp(v + std::clamp(newton, -farthest, farthest), -most, most);
      farthest *= 2;
    }
    // What does not converge by then is halved every other time.
    const bool is_slow = is_between && count > usual && count % 2 == 0;
    if (is_slow || !(next > above && next < below)) next = above + (below - above) / 2;
    if (!(next > above && next < below)) break;
    v = next;
  }
  return {true, std::exp(v)};
}

/// How far sorted principal stresses (falling order, tension positive) are outside, as a difference
/// of stresses along sigma_3; not positive inside.
double curved_excess(const CurvedEnvelope& m, double major, double minor);

/// Radius of the circle about a centre (compression positive) that touches the envelope.
double curved_radius(const CurvedEnvelope& m, double centre);

/// Return of sorted principal trial stresses (falling order, tension positive) to the surface.
PrincipalReturn return_principal(const CurvedEnvelope& m, const Eigen::Vector3d& trial);

}  // namespace detail

/// Stress update of `CurvedEnvelope` from the elastic trial stress, in principal stress space.
///
/// An admissible trial is returned bit for bit. `s0` and `s1` may be the same object. No
/// allocation.
/// @param trial  [Pa] elastic trial stress  @param s0  begin  @param[out] s1  end of the step
template <int Dim>
UpdateOutcome update(const CurvedEnvelope& material,
                     const std::type_identity_t<StressVector<Dim>>& trial,
                     const PointState<Dim>& s0, PointState<Dim>& s1);

/// d(stress)/d(trial stress) of `update` at a finite trial, the spin of the principal axes
/// included.
template <int Dim>
TangentMatrix<Dim> trial_tangent(const CurvedEnvelope& material,
                                 const std::type_identity_t<StressVector<Dim>>& trial,
                                 const PointState<Dim>& /*s0*/);

}  // namespace constitutive
