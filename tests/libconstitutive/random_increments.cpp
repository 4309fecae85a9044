// random_increments N: N random strain increments, up to 100 % strain each, on every model and on
// parameters drawn anew every thousand. What must hold of any rate-independent law is checked
// without knowing the law: no update fails, the stress returned is admissible (to be returned once
// more changes it by round-off only), plastic strain grows, the plastic work is not negative.
// Prints a line per model; exit code 1 if one fails.

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include "points.hpp"

namespace {

using namespace constitutive;

/// Amplification of round-off by a corner whose two flows are nearly parallel (see test_extremes)
/// and by the ratio of bulk to shear modulus, which a trial of given strain enters with.
double condition(const MaterialParameters& p, const ModelInfo& model) {
  const double stiffness = (1 + p.poissons_ratio) / (1 - 2 * p.poissons_ratio);
  if (!model.frictional) return std::max(1.0, stiffness);
  const double phi = radians(p.friction_angle), psi = radians(p.dilation_angle);
  return 4 / ((1 - std::sin(phi)) * (1 - std::sin(psi))) * std::max(1.0, stiffness);
}

MaterialParameters drawn(const ModelInfo& model, std::mt19937_64& engine) {
  std::uniform_real_distribution<double> share(0, 1);
  MaterialParameters p;
  p.model = model.name;
  p.youngs_modulus = std::pow(10, 5 + 5 * share(engine));
  p.poissons_ratio = -0.5 + 0.99 * share(engine);
  if (model.critical_state) {
    p.poissons_ratio = 0.4 * share(engine);
    p.compression_index = std::pow(10, -1.5 + 1.2 * share(engine));
    p.swelling_index = p.compression_index * (0.05 + 0.55 * share(engine));
    p.critical_stress_ratio = 0.3 + 1.5 * share(engine);
    p.preconsolidation_pressure = std::pow(10, 3 + 4 * share(engine));
    return p;
  }
  if (model.curve == Curve::hoek_brown) {
    p.intact_strength = std::pow(10, 5 + 4 * share(engine));
    p.m_i = 4 + 30 * share(engine);
    p.gsi = 100 * share(engine);
    p.disturbance = share(engine);
    p.dilation_ratio = share(engine);
    return p;
  }
  if (model.curve == Curve::power_law) {
    p.reference_stress = std::pow(10, 3 + 4 * share(engine));
    p.power_coefficient = 0.2 + 2 * share(engine);
    p.power_exponent = 0.5 + 0.45 * share(engine);
    p.power_tension = share(engine) * p.reference_stress;
    p.dilation_ratio = share(engine);
    return p;
  }
  if (model.yields) p.cohesion = std::pow(10, 1 + 5 * share(engine));
  if (model.frictional) {
    p.friction_angle = 50 * share(engine);
    p.dilation_angle = p.friction_angle * share(engine);
  }
  // Every other material has a tension cut-off, from none at all to beyond the apex.
  if (model.yields && share(engine) < 0.5) {
    p.tension_cutoff = share(engine) < 0.2 ? 0 : 3 * share(engine) * p.cohesion;
  }
  if (model.yields && !std::isfinite(p.tension_cutoff) && share(engine) < 0.5) {
    p.residual_strain = std::pow(10, -3 + 3 * share(engine));
    p.residual_cohesion = (0.1 + 2 * share(engine)) * p.cohesion;
    if (model.frictional) {
      p.residual_friction_angle = p.dilation_angle + (50 - p.dilation_angle) * share(engine);
    }
  }
  return p;
}

struct Tally {
  long failed = 0, inadmissible = 0, backward = 0, plastic = 0, apex = 0;
  double worst = 0;  // excess after a second return, over round-off
  [[nodiscard]] bool good() const { return failed == 0 && inadmissible == 0 && backward == 0; }
};

/// One increment from `s`; `s` becomes its end.
template <int Dim>
void step(const Material& material, double allowed, const StrainVector<Dim>& increment,
          const PointState<Dim>& begin, PointState<Dim>& s, Tally& tally) {
  const PointState<Dim> s0 = s;
  const StressVector<Dim> trial = s0.stress + elastic_stress<Dim>(moduli(material), increment);
  const UpdateOutcome outcome = update(material, trial, s0, s);
  if (outcome.failed || !s.stress.allFinite()) {
    ++tally.failed;
    s = begin;
    return;
  }
  tally.plastic += outcome.plastic ? 1 : 0;
  tally.apex += outcome.apex ? 1 : 0;
  PointState<Dim> again;
  (void)update(material, s.stress, s, again);
  // Every number on the way is the trial's size at most.
  const double scale = points::round_off * allowed * (trial.norm() + s.stress.norm());
  const double excess = (again.stress - s.stress).norm();
  if (scale > 0) tally.worst = std::max(tally.worst, excess / scale);
  if (excess > scale) ++tally.inadmissible;
  // The deviator of D^-1 (trial - stress) is that of the plastic strain, whose volume the state
  // has; its work on the stress at the end.
  const StressVector<Dim> removed = trial - s.stress;
  const ElasticModuli& m = moduli(material);
  const double work = contract(s.stress, deviator(removed)) / (2 * m.shear) +
                      mean_stress(s.stress) * (s.plastic_volume_strain - s0.plastic_volume_strain);
  // Both are as exact as the trial's size lets a difference be; without tension the work is 0.
  const double largest =
      (trial.norm() + s.stress.norm()) * s.stress.norm() * (1 / m.shear + 1 / m.bulk);
  if (s.plastic_strain < s0.plastic_strain || work < -points::round_off * allowed * largest) {
    ++tally.backward;
  }
}

template <int Dim>
Tally walk(const ModelInfo& model, long increments) {
  std::mt19937_64 engine(20 + Dim);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> decades(-5, 0);
  constexpr long of_one_material = 1000;
  Tally tally;
  for (long done = 0; done < increments;) {
    const MaterialParameters p = drawn(model, engine);
    const Material material = make_material(p);
    PointState<Dim> begin;
    if (model.critical_state) begin.stress = isotropic<Dim>(-0.7 * p.preconsolidation_pressure);
    PointState<Dim> s = begin;
    for (long k = 0; k < of_one_material && done < increments; ++k, ++done) {
      StrainVector<Dim> increment;
      for (double& row : increment) row = normal(engine);
      increment *= std::pow(10, decades(engine)) / increment.norm();
      step<Dim>(material, condition(p, model), increment, begin, s, tally);
    }
  }
  return tally;
}

bool report(const ModelInfo& model, int dimension, const Tally& tally) {
  std::printf(
      "%-28s %dD: %ld plastic, %ld at the apex; %ld failed, %ld not admissible (%.2g of "
      "round-off at most), %ld backward\n",
      std::string(model.name).c_str(), dimension, tally.plastic, tally.apex, tally.failed,
      tally.inadmissible, tally.worst, tally.backward);
  return tally.good() && (tally.plastic > 0 || !model.yields);
}

}  // namespace

int main(int count, char** words) {
  const long increments = count > 1 ? std::atol(words[1]) : 10000;
  bool good = true;
  for (const ModelInfo& model : material_models()) {
    good = report(model, 2, walk<2>(model, increments)) && good;
    if (!model.only_plane_strain.empty()) continue;
    good = report(model, 3, walk<3>(model, increments)) && good;
  }
  return good ? 0 : 1;
}
