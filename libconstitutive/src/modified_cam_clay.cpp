#include "constitutive/modified_cam_clay.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace constitutive {

namespace detail {

namespace {

/// One step in the plane of p and q. Pressures enter by their logarithms, which do not overflow.
///
/// The unknown is the plastic volume strain x between 0 and x_c, where the step would end in the
/// critical state, 2 p = p_c: x = t x_c. The multiplier x / (2 p - p_c) grows from 0 to infinity
/// with t, q = q_tr / (1 + 6 G multiplier / M^2) falls to 0, and f from above to below zero,
/// wet of critical (x_c > 0) or dry.
class CamClayStep {
 public:
  CamClayStep(const ModifiedCamClay& m, double log_trial_pressure, double log_preconsolidation,
              double trial_q)
      : a_(1 / m.swelling),
        b_(1 / (m.compression - m.swelling)),
        c_(6 * m.moduli.shear / (m.slope * m.slope)),
        slope_(m.slope),
        trial_q_(trial_q) {
    const double ratio = std::numbers::ln2 + log_trial_pressure - log_preconsolidation;
    critical_ = ratio / (a_ + b_);
    log_critical_ = log_trial_pressure - a_ * critical_;
    take(0);
  }

  /// Whether the trial is outside by more than round-off, `magnified` times that of its terms.
  [[nodiscard]] bool is_exceeded(double magnified) const {
    return rest_ > yield_round_off * magnified;
  }

  /// The t at which f = 0: by Illinois' false position, bisected now and then.
  void solve() {
    double low = 0, at_low = rest_, high = 1, at_high = -std::numbers::ln2;
    int side = 0;
    for (int count = 0; count < 200; ++count) {
      const bool halves = count % 4 == 3;
      double t = halves ? (low + high) / 2 : (low * at_high - high * at_low) / (at_high - at_low);
      if (!(t > low && t < high)) t = (low + high) / 2;
      if (!(t > low && t < high)) break;
      take(t);
      if (std::abs(rest_) <= round_off_) break;
      const int now = rest_ > 0 ? 1 : -1;
      if (now > 0) {
        low = t;
        at_low = rest_;
        if (side == now) at_high /= 2;
      } else {
        high = t;
        at_high = rest_;
        if (side == now) at_low /= 2;
      }
      side = now;
    }
    // Near the critical state q is better known from the surface than from the flow.
    const double ratio = pressure_ / preconsolidation_;
    if (ratio > 0.4 && ratio < 0.6) q_ = slope_ * pressure_ * std::sqrt(1 / ratio - 1);
  }

  [[nodiscard]] double pressure() const { return pressure_; }
  [[nodiscard]] double q() const { return q_; }
  [[nodiscard]] double plastic_volume() const { return t_ * critical_; }

  /// d(p, q) by d(ln p_tr, q_tr), and q / q_tr.
  struct Derivative {
    double pressure_of_log, pressure_of_q, q_of_log, q_of_q, ratio;
  };
  [[nodiscard]] Derivative derivative() const {
    const double p = pressure_, pc = preconsolidation_, two = 2 * p - pc;
    const double spread = 1 + c_ * multiplier_, m2 = slope_ * slope_;
    const double s = 1 + multiplier_ * (2 * p * a_ + pc * b_);
    // dx = (two dm + 2 m p dl) / s; dq = (dq_tr - c q dm) / spread;
    // 2 q dq / M^2 + two p (dl - a dx) - p pc b dx = 0.
    const double of_x = p * (two * a_ + pc * b_);
    const double of_multiplier = 2 * c_ * q_ * q_ / (m2 * spread) + of_x * two / s;
    const double m_of_log = (two * p - of_x * 2 * multiplier_ * p / s) / of_multiplier;
    const double m_of_q = 2 * q_ / (m2 * spread) / of_multiplier;
    const double x_of_log = (two * m_of_log + 2 * multiplier_ * p) / s, x_of_q = two * m_of_q / s;
    return {.pressure_of_log = p * (1 - a_ * x_of_log),
            .pressure_of_q = -p * a_ * x_of_q,
            .q_of_log = -c_ * q_ * m_of_log / spread,
            .q_of_q = (1 - c_ * q_ * m_of_q) / spread,
            .ratio = 1 / spread};
  }

 private:
  void take(double t) {
    t_ = t;
    const double y = (1 - t) * critical_;
    const double log_pressure = log_critical_ + a_ * y;
    pressure_ = std::exp(log_pressure);
    preconsolidation_ = std::exp(std::numbers::ln2 + log_critical_ - b_ * y);
    // y / (2 p - p_c), which has a limit in the critical state.
    const double difference = std::expm1(a_ * y) - std::expm1(-b_ * y);
    const double over = difference == 0 ? 1 / (a_ + b_) : y / difference;
    const double of_multiplier = over / (2 * std::exp(log_critical_));
    multiplier_ = t < 1 ? t / (1 - t) * of_multiplier : 0;
    q_ = trial_q_ / (1 + c_ * multiplier_);
    const double stress_ratio = q_ / (slope_ * pressure_);
    // ln of (q / M p)^2 + 1 over p_c / p.
    const double log_ratio = (a_ + b_) * y - std::numbers::ln2;
    rest_ = 2 * std::log(std::hypot(stress_ratio, 1.0)) + log_ratio;
    round_off_ = 0x1p-51 * (1 + std::abs(log_ratio));
  }

  double a_, b_, c_, slope_, trial_q_;
  double critical_ = 0;      // x_c
  double log_critical_ = 0;  // ln p there
  double t_ = 0, multiplier_ = 0, pressure_ = 0, preconsolidation_ = 0, q_ = 0, rest_ = 0,
         round_off_ = 0;
};

/// The deviator, without the trace that round-off of a mean stress far larger than it would leave:
/// the clay may end at a pressure that is that much smaller.
template <int Dim>
StressVector<Dim> small_deviator(const StressVector<Dim>& stress) {
  return deviator(StressVector<Dim>(deviator(stress)));
}

/// What a trial means to the clay.
struct CamClayTrial {
  double volume_strain;  ///< Of the step, compression positive.
  double log_pressure;   ///< Of elasticity alone.
  bool opens;            ///< The mean stress would fall below the least one.
  double q;
  double magnified;  ///< Round-off of p_c over that of one number.
};

template <int Dim>
CamClayTrial cam_clay_trial(const ModifiedCamClay& m, const StressVector<Dim>& trial,
                            const PointState<Dim>& s0) {
  // A rotation leaves the mean stress: what the trial's has more is the step's strain.
  const double before = mean_stress(s0.stress), least = std::log(m.least_pressure());
  const double strain = (before - mean_stress(trial)) / m.moduli.bulk;
  const double from = std::log(std::max(-before, m.least_pressure()));
  const double to = from + strain / m.swelling;
  const double turns = std::abs(s0.plastic_volume_strain) / (m.compression - m.swelling);
  return {strain, std::max(to, least), to < least, std::sqrt(3 * j2(small_deviator<Dim>(trial))),
          4 * (4 + turns)};
}

template <int Dim>
CamClayStep cam_clay_step(const ModifiedCamClay& m, const CamClayTrial& trial,
                          const PointState<Dim>& s0) {
  const double log_preconsolidation =
      std::log(m.preconsolidation) - s0.plastic_volume_strain / (m.compression - m.swelling);
  return {m, trial.log_pressure, log_preconsolidation, trial.q};
}

/// The trial's deviator, shrunk, at another mean stress (compression positive).
template <int Dim>
StressVector<Dim> at_pressure(const StressVector<Dim>& trial, double ratio, double pressure) {
  return ratio * small_deviator<Dim>(trial) - isotropic<Dim>(pressure);
}

}  // namespace

}  // namespace detail

template <int Dim>
UpdateOutcome update(const ModifiedCamClay& material,
                     const std::type_identity_t<StressVector<Dim>>& trial,
                     const PointState<Dim>& s0, PointState<Dim>& s1) {
  const bool finite = std::isfinite(j2(trial)) && std::isfinite(trace(trial));
  const detail::CamClayTrial of = detail::cam_clay_trial(material, trial, s0);
  detail::CamClayStep step = detail::cam_clay_step(material, of, s0);
  const bool plastic = step.is_exceeded(of.magnified);
  if (finite && plastic) step.solve();
  if (!finite || !std::isfinite(step.pressure()) || !std::isfinite(step.q())) {
    s1 = s0;
    return {.failed = true};
  }
  s1 = s0;
  if (!plastic) {
    s1.stress = of.volume_strain == 0 && !of.opens
                    ? trial
                    : detail::at_pressure<Dim>(trial, 1, step.pressure());
    return {.apex = of.opens};
  }
  const double ratio = of.q > 0 ? step.q() / of.q : 1;
  s1.stress = detail::at_pressure<Dim>(trial, ratio, step.pressure());
  const double x = step.plastic_volume();
  s1.plastic_volume_strain -= x;
  s1.plastic_strain +=
      std::hypot((of.q - step.q()) / (3 * material.moduli.shear), std::sqrt(2.0) / 3 * x);
  return {.apex = of.opens, .plastic = true};
}

template <int Dim>
TangentMatrix<Dim> trial_tangent(const ModifiedCamClay& material,
                                 const std::type_identity_t<StressVector<Dim>>& trial,
                                 const PointState<Dim>& s0) {
  const detail::CamClayTrial of = detail::cam_clay_trial(material, trial, s0);
  detail::CamClayStep step = detail::cam_clay_step(material, of, s0);
  // d(ln p_tr) by d(mean stress), tension positive.
  const double log_of_mean = of.opens ? 0 : -1 / (material.swelling * material.moduli.bulk);
  const StressVector<Dim> one = isotropic<Dim>(1.0);
  const StressVector<Dim> mean = one / 3;  // of a stress-like direction
  const TangentMatrix<Dim> deviatoric = TangentMatrix<Dim>::Identity() - one * mean.transpose();
  if (!step.is_exceeded(of.magnified)) {
    return deviatoric - step.pressure() * log_of_mean * one * mean.transpose();
  }
  step.solve();
  const auto d = step.derivative();
  const double ratio = of.q > 0 ? step.q() / of.q : d.ratio;
  TangentMatrix<Dim> t = ratio * deviatoric;
  t -= d.pressure_of_log * log_of_mean * one * mean.transpose();
  if (of.q > 0) {
    const StressVector<Dim> s = detail::small_deviator<Dim>(trial);
    const StressVector<Dim> q_of_trial = 1.5 / of.q * with_engineering_shear(s);
    t += (d.q_of_q - ratio) / of.q * s * q_of_trial.transpose();
    t += d.q_of_log * log_of_mean / of.q * s * mean.transpose();
    t -= d.pressure_of_q * one * q_of_trial.transpose();
  }
  return t;
}

template UpdateOutcome update(const ModifiedCamClay&, const std::type_identity_t<StressVector<2>>&,
                              const PointState<2>&, PointState<2>&);
template UpdateOutcome update(const ModifiedCamClay&, const std::type_identity_t<StressVector<3>>&,
                              const PointState<3>&, PointState<3>&);
template TangentMatrix<2> trial_tangent(const ModifiedCamClay&,
                                        const std::type_identity_t<StressVector<2>>&,
                                        const PointState<2>&);
template TangentMatrix<3> trial_tangent(const ModifiedCamClay&,
                                        const std::type_identity_t<StressVector<3>>&,
                                        const PointState<3>&);

}  // namespace constitutive
