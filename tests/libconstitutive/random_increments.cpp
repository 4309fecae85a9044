// random_increments N: N random strain increments, up to 100 % strain each, on every law and on
// parameters drawn anew every thousand. A law is a model as it is, with a tension cut-off, or with
// a strength that rises or falls with the plastic strain, or whose cohesion and friction go
// opposite ways. What must hold of any rate-independent law is checked without knowing the law: no
// update fails, the stress returned is admissible (to be returned once more changes it by round-off
// only), plastic strain grows, the plastic work is not negative.
// Prints a line per law; exit code 1 if one fails.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include "points.hpp"

namespace {

using namespace constitutive;

/// What a model's strength does beside what its name says.
enum class Strength { stays, is_cut_off, rises, falls, turns };

const char* words_of(Strength strength) {
  switch (strength) {
    case Strength::stays:
      return "";
    case Strength::is_cut_off:
      return "tension cut-off";
    case Strength::rises:
      return "hardens";
    case Strength::falls:
      return "softens";
    case Strength::turns:
      break;
  }
  return "c and phi oppositely";
}

std::vector<Strength> strengths_of(const ModelInfo& model) {
  if (!model.yields || model.critical_state) return {Strength::stays};
  std::vector<Strength> all{Strength::stays, Strength::is_cut_off, Strength::rises,
                            Strength::falls};
  if (model.frictional) all.push_back(Strength::turns);
  return all;
}

constexpr double steepest = 50;  // friction angle [deg]

/// Amplification of round-off by a corner whose two flows are nearly parallel (see test_extremes)
/// and by the ratio of bulk to shear modulus, which a trial of given strain enters with.
double condition(const MaterialParameters& p, const ModelInfo& model) {
  const double stiffness = (1 + p.poissons_ratio) / (1 - 2 * p.poissons_ratio);
  if (!model.frictional) return std::max(1.0, stiffness);
  const double largest = std::isfinite(p.residual_friction_angle)
                             ? std::max(p.friction_angle, p.residual_friction_angle)
                             : p.friction_angle;
  const double phi = radians(largest), psi = radians(p.dilation_angle);
  return 4 / ((1 - std::sin(phi)) * (1 - std::sin(psi))) * std::max(1.0, stiffness);
}

using Share = std::uniform_real_distribution<double>;

/// Residual values that are higher or lower than those of the soil.
void let_change(MaterialParameters& p, const ModelInfo& model, Strength strength,
                std::mt19937_64& engine) {
  Share share(0, 1);
  const bool either = share(engine) < 0.5;
  const bool cohesion_rises = strength == Strength::turns ? either : strength == Strength::rises;
  const bool friction_rises = strength == Strength::turns ? !either : strength == Strength::rises;
  p.residual_strain = std::pow(10, -3 + 3 * share(engine));
  const double part = share(engine);
  p.residual_cohesion = (cohesion_rises ? 1 + 2 * part : part) * p.cohesion;
  if (!model.frictional) return;
  const double end = friction_rises ? steepest : p.dilation_angle;
  p.residual_friction_angle = p.friction_angle + share(engine) * (end - p.friction_angle);
}

MaterialParameters drawn(const ModelInfo& model, Strength strength, std::mt19937_64& engine) {
  Share share(0, 1);
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
    p.friction_angle = steepest * share(engine);
    p.dilation_angle = p.friction_angle * share(engine);
  }
  if (strength == Strength::stays) return p;
  if (strength == Strength::is_cut_off) {
    // From no tension at all to beyond the apex.
    p.tension_cutoff = share(engine) < 0.2 ? 0 : 3 * share(engine) * p.cohesion;
  } else {
    let_change(p, model, strength, engine);
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
  // Both are as exact as the trial's size lets a difference be, and as the volume strain that has
  // accumulated lets its change be; without tension the work is 0.
  const double largest =
      s.stress.norm() * ((trial.norm() + s.stress.norm()) * (1 / m.shear + 1 / m.bulk) +
                         std::abs(s.plastic_volume_strain));
  if (s.plastic_strain < s0.plastic_strain || work < -points::round_off * allowed * largest) {
    ++tally.backward;
  }
}

template <int Dim>
Tally walk(const ModelInfo& model, Strength strength, long increments) {
  std::mt19937_64 engine(20 + Dim);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> decades(-5, 0);
  constexpr long of_one_material = 1000;
  Tally tally;
  for (long done = 0; done < increments;) {
    const MaterialParameters p = drawn(model, strength, engine);
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

bool report(const ModelInfo& model, Strength strength, int dimension, const Tally& tally) {
  std::printf(
      "%-28s %-20s %dD: %ld plastic, %ld at the apex; %ld failed, %ld not admissible (%.2g of "
      "round-off at most), %ld backward\n",
      std::string(model.name).c_str(), words_of(strength), dimension, tally.plastic, tally.apex,
      tally.failed, tally.inadmissible, tally.worst, tally.backward);
  return tally.good() && (tally.plastic > 0 || !model.yields);
}

}  // namespace

int main(int count, char** words) {
  const long increments = count > 1 ? std::atol(words[1]) : 10000;
  bool good = true;
  for (const ModelInfo& model : material_models()) {
    for (const Strength strength : strengths_of(model)) {
      good = report(model, strength, 2, walk<2>(model, strength, increments)) && good;
      if (!model.only_plane_strain.empty()) continue;
      good = report(model, strength, 3, walk<3>(model, strength, increments)) && good;
    }
  }
  return good ? 0 : 1;
}
