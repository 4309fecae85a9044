#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <constitutive/material.hpp>
#include <constitutive/objective.hpp>
#include <limits>
#include <random>
#include <string>
#include <vector>

/// Materials, stresses and yield functions that several tests of libconstitutive share.
namespace points {

inline constexpr double eps = std::numeric_limits<double>::epsilon();

/// London clay, nearly: lambda and kappa per volume strain, E and nu of its shear modulus.
inline constitutive::MaterialParameters clay() {
  constitutive::MaterialParameters p;
  p.model = "modified_cam_clay";
  p.youngs_modulus = 8e6;
  p.poissons_ratio = 0.3;
  p.compression_index = 0.08;
  p.swelling_index = 0.03;
  p.critical_stress_ratio = 0.9;
  p.preconsolidation_pressure = 200e3;
  return p;
}

/// A fair rock mass, and a soil of a curved envelope; both with strengths of some 100 kPa.
inline constitutive::MaterialParameters curved(const std::string& model) {
  constitutive::MaterialParameters p;
  p.model = model;
  p.youngs_modulus = 500e6;
  p.poissons_ratio = 0.25;
  if (model == "hoek_brown") {
    p.intact_strength = 20e6;
    p.m_i = 10;
    p.gsi = 45;
    p.disturbance = 0.2;
  } else {
    p.power_coefficient = 0.8;
    p.power_exponent = 0.7;
    p.power_tension = 100e3;
    p.reference_stress = 500e3;
  }
  p.dilation_ratio = 0.5;
  return p;
}

inline constitutive::MaterialParameters soil(const std::string& model, double phi = 20,
                                             double psi = 10) {
  constitutive::MaterialParameters p;
  if (model == "modified_cam_clay") return clay();
  if (model == "hoek_brown" || model == "power_law") return curved(model);
  p.model = model;
  p.youngs_modulus = 5e6;
  p.poissons_ratio = 0.4;
  p.cohesion = 15e3;
  p.friction_angle = model == "von_mises" ? 0 : phi;
  p.dilation_angle = model == "von_mises" ? 0 : psi;
  return p;
}

inline std::vector<constitutive::MaterialParameters> plastic_soils() {
  using constitutive::MaterialParameters;
  std::vector<MaterialParameters> all;
  for (const char* model :
       {"von_mises", "drucker_prager", "drucker_prager_compression", "mohr_coulomb"}) {
    all.push_back(soil(model));
  }
  all.push_back(soil("drucker_prager", 30, 0));
  all.push_back(soil("mohr_coulomb", 30, 0));
  all.push_back(soil("drucker_prager", 0, 0));
  all.push_back(soil("mohr_coulomb", 0, 0));
  return all;
}

inline std::string label(const constitutive::MaterialParameters& p) {
  return p.model + " phi " + std::to_string(p.friction_angle) + " psi " +
         std::to_string(p.dilation_angle) + " nu " + std::to_string(p.poissons_ratio) + " c " +
         std::to_string(p.cohesion);
}

/// Stresses in all directions whose size is spread over a decade below and above `scale`.
template <int Dim>
class RandomStress {
 public:
  explicit RandomStress(double scale, unsigned seed = 1) : scale_(scale), engine_(seed) {}

  constitutive::StressVector<Dim> operator()() {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> decades(-1, 1);
    constitutive::StressVector<Dim> v;
    for (double& component : v) component = normal(engine_);
    v += constitutive::isotropic<Dim>(normal(engine_));
    return scale_ * std::pow(10, decades(engine_)) * v;
  }

 private:
  double scale_;
  std::mt19937_64 engine_;
};

inline Eigen::Matrix3d random_rotation(std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  const Eigen::Quaterniond q(normal(engine), normal(engine), normal(engine), normal(engine));
  return q.normalized().toRotationMatrix();
}

/// Yield function as on paper, from the eigenvalues or invariants of the full matrix [Pa].
template <int Dim>
double yield_function(const constitutive::Cone& cone, const constitutive::StressVector<Dim>& v) {
  return std::sqrt(constitutive::j2(v)) + 3 * cone.alpha * constitutive::mean_stress(v) -
         cone.strength;
}

template <int Dim>
double yield_function(const constitutive::Material& material,
                      const constitutive::StressVector<Dim>& v) {
  using namespace constitutive;
  if (const auto* m = std::get_if<VonMises>(&material)) {
    return yield_function<Dim>(yield_cone(*m, 0), v);
  }
  if (const auto* m = std::get_if<DruckerPrager>(&material)) {
    return yield_function<Dim>(m->cone, v);
  }
  if (const auto* m = std::get_if<MohrCoulomb>(&material)) {
    const Eigen::Vector3d principal = to_matrix(v).eigenvalues().real();
    const double s1 = principal.maxCoeff(), s3 = principal.minCoeff();
    return s1 - s3 + (s1 + s3) * m->sin_friction - 2 * m->cohesion * m->cos_friction;
  }
  return -std::numeric_limits<double>::infinity();
}

/// Round-off of a stress update and of `yield_function`, relative to the trial and the strength.
///
/// About 100 roundings along the longest chain (spectrum, return, recomposition, spectrum again),
/// each at most eps / 2 of the largest number met, which is the trial stress or the cohesion.
inline constexpr double round_off = 64 * eps;

template <int Dim>
double magnitude(const constitutive::StressVector<Dim>& trial,
                 const constitutive::MaterialParameters& p) {
  return trial.norm() + p.cohesion;
}

}  // namespace points
