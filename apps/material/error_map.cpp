#include "material/error_map.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <cmath>
#include <stdexcept>

namespace material {

namespace {

using constitutive::Material;
using State = constitutive::PointState<3>;
using Stress = constitutive::StressVector<3>;
using Strain = constitutive::StrainVector<3>;

constexpr double per_thousand = 1e-3;

Stress of_principal(const Eigen::Vector3d& values) {
  Stress stress = Stress::Zero();
  stress.head<3>() = values;
  return stress;
}

/// The state on the yield surface along the direction from the mean stress.
State begin_of(const Material& material, const ErrorMapCase& of) {
  State inside;
  inside.stress = of_principal(Eigen::Vector3d::Constant(of.mean_stress));
  const auto is_elastic = [&](double share) {
    State end;
    const Stress trial = inside.stress + of_principal(share * of.direction);
    const auto outcome = constitutive::update<3>(material, trial, inside, end);
    return !outcome.failed && !outcome.plastic;
  };
  double low = 0.0, high = 1.0;
  constexpr double farthest = 1e15;
  while (is_elastic(high) && high < farthest) high *= 2.0;
  if (high >= farthest || !is_elastic(0.0)) {
    throw std::invalid_argument(of.name + ": no yield surface in that direction");
  }
  for (double middle = high / 2.0; middle > low && middle < high; middle = (low + high) / 2.0) {
    (is_elastic(middle) ? low : high) = middle;
  }
  inside.stress += of_principal(low * of.direction);
  return inside;
}

State after(const Material& material, const State& begin, const Strain& strain, int parts) {
  State state = begin;
  const Strain part = strain / parts;
  for (int k = 0; k < parts; ++k) {
    const Stress trial =
        state.stress + constitutive::elastic_stress<3>(constitutive::moduli(material), part);
    if (constitutive::update<3>(material, trial, state, state).failed) {
      throw std::invalid_argument("a step of the map fails");
    }
  }
  return state;
}

double norm(const Stress& stress) {
  return std::sqrt(constitutive::contract(stress, stress));
}

constitutive::MaterialParameters soil(const std::string& model, double phi, double psi) {
  constitutive::MaterialParameters p;
  p.model = model;
  p.youngs_modulus = 20e6;
  p.poissons_ratio = 0.3;
  p.cohesion = 10e3;
  p.friction_angle = phi;
  p.dilation_angle = psi;
  return p;
}

constitutive::MaterialParameters softening(constitutive::MaterialParameters p) {
  p.residual_strain = 0.01;
  p.residual_cohesion = 0.4 * p.cohesion;
  if (p.friction_angle > 0.0) p.residual_friction_angle = 0.8 * p.friction_angle;
  return p;
}

constitutive::MaterialParameters clay() {
  constitutive::MaterialParameters p;
  p.model = "modified_cam_clay";
  p.youngs_modulus = 20e6;
  p.poissons_ratio = 0.3;
  p.compression_index = 0.1;
  p.swelling_index = 0.02;
  p.critical_stress_ratio = 1.0;
  p.preconsolidation_pressure = 150e3;
  return p;
}

}  // namespace

std::vector<ErrorMapCase> error_map_cases() {
  const Eigen::Vector3d compression(1.0, 1.0, -2.0), shear(1.0, 0.0, -1.0);
  const double confined = -100e3, phi = 30.0, psi = 10.0;
  return {
      {"von_mises", "von Mises", soil("von_mises", 0.0, 0.0), 0.0, shear},
      {"tresca", "Tresca (Mohr-Coulomb, phi = 0), from shear", soil("mohr_coulomb", 0.0, 0.0), 0.0,
       shear},
      {"drucker_prager", "Drucker-Prager, phi = 30, psi = 10 degrees",
       soil("drucker_prager_compression", phi, psi), confined, compression},
      {"mohr_coulomb_compression", "Mohr-Coulomb, phi = 30, psi = 10 degrees, from compression",
       soil("mohr_coulomb", phi, psi), confined, compression},
      {"mohr_coulomb_shear", "Mohr-Coulomb, phi = 30, psi = 10 degrees, from shear",
       soil("mohr_coulomb", phi, psi), confined, shear},
      {"softening_von_mises", "von Mises, cohesion to 40 % over 1 % of plastic strain",
       softening(soil("von_mises", 0.0, 0.0)), 0.0, shear},
      {"softening_mohr_coulomb", "Mohr-Coulomb from shear, cohesion to 40 and phi to 80 % over 1 %",
       softening(soil("mohr_coulomb", phi, psi)), confined, shear},
      {"modified_cam_clay", "Modified Cam Clay, wet of critical, p = p_c / 1.5", clay(), confined,
       compression},
  };
}

ErrorMap error_map(const ErrorMapCase& of, std::size_t count, double widest, int parts) {
  const Material material = constitutive::make_material(of.parameters);
  const State begin = begin_of(material, of);
  const Stress deviator = constitutive::deviator(begin.stress);
  const Strain outward =
      constitutive::with_engineering_shear(deviator) / (2.0 * constitutive::moduli(material).shear);
  const Eigen::Vector3d normal = outward.head<3>();
  const Strain across =
      of_principal(Eigen::Vector3d(Eigen::Vector3d::Ones().cross(normal)) / std::sqrt(3.0));
  ErrorMap map{of, {}, {}, {}, 0.0};
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    map.outward.push_back(widest * share);
    map.across.push_back(widest * (2.0 * share - 1.0));
  }
  for (const double out : map.outward) {
    for (const double side : map.across) {
      const Strain strain = out * outward + side * across;
      const Stress one = after(material, begin, strain, 1).stress;
      const Stress coarse = after(material, begin, strain, parts).stress;
      const Stress fine = after(material, begin, strain, 2 * parts).stress;
      const Stress exact = 2.0 * fine - coarse;
      map.error.push_back(norm(one - exact) / norm(exact));
      map.uncertainty = std::max(map.uncertainty, norm(fine - coarse) / norm(exact));
    }
  }
  return map;
}

std::string csv_text(const ErrorMap& map) {
  std::string out = "outward,across,error\n";
  for (std::size_t i = 0; i < map.outward.size(); ++i) {
    for (std::size_t j = 0; j < map.across.size(); ++j) {
      out += fmt::format("{:.6g},{:.6g},{:.4g}\n", map.outward[i], map.across[j], map.at(i, j));
    }
  }
  return out;
}

std::string table_of(const std::vector<ErrorMap>& maps) {
  std::string out =
      "| surface | largest error [%] | at outward, across | mean error [%] | error up to one "
      "elastic "
      "strain [%] | uncertainty [%] |\n|---|---|---|---|---|---|\n";
  for (const ErrorMap& map : maps) {
    double largest = 0.0, sum = 0.0, near = 0.0;
    std::size_t worst_i = 0, worst_j = 0;
    for (std::size_t i = 0; i < map.outward.size(); ++i) {
      for (std::size_t j = 0; j < map.across.size(); ++j) {
        sum += map.at(i, j);
        if (std::hypot(map.outward[i], map.across[j]) <= 1.0 + per_thousand) {
          near = std::max(near, map.at(i, j));
        }
        if (map.at(i, j) <= largest) continue;
        largest = map.at(i, j);
        worst_i = i;
        worst_j = j;
      }
    }
    out += fmt::format(
        "| [{}](figures/error-map-{}.svg) | {:.1f} | {:.1f}, {:.1f} | {:.1f} | {:.1f} | {:.2f} |\n",
        map.of.title, map.of.name, 100.0 * largest, map.outward[worst_i], map.across[worst_j],
        100.0 * sum / static_cast<double>(map.error.size()), 100.0 * near, 100.0 * map.uncertainty);
  }
  return out;
}

}  // namespace material
