#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "constitutive/parameters.hpp"
#include "tables/diagnosis.hpp"

namespace material {

/// What is prescribed of a component in a stage.
enum class Control { strain, stress };

/// Tests by name; `mixed` says itself what it prescribes.
enum class TestKind {
  isotropic,
  triaxial_compression,
  triaxial_extension,
  plane_strain,
  oedometer,
  simple_shear,
  mixed,
};

std::span<const std::string_view> names_of(Control);
std::span<const std::string_view> names_of(TestKind);

/// A part of the path: how far, in how many equal steps.
struct Stage {
  std::string name;
  TestKind test = TestKind::mixed;
  std::optional<double> amount;  // strain, or stress [Pa] of an isotropic one
  std::vector<Control> control;  // of mixed: rows xx yy zz xy yz zx
  std::vector<double> change;    // of mixed: strain (engineering shear) or stress [Pa]
  int steps = 100;
};

/// The material as the user writes it down; see constitutive::MaterialParameters.
struct Soil {
  std::string model = "elastic";  // a family of models of libconstitutive
  std::string match = "plane_strain";
  double youngs_modulus = 0.0;
  double poissons_ratio = 0.0;
  std::optional<double> cohesion, friction_angle, dilation_angle, dilation_cutoff, tension_cutoff;
  std::optional<double> residual_strain, residual_cohesion, residual_friction_angle;
  std::optional<double> compression_index, swelling_index, critical_stress_ratio,
      preconsolidation_pressure;
  std::optional<double> intact_strength, m_i, gsi, disturbance;
  std::optional<double> power_coefficient, power_exponent, power_tension, reference_stress;
  std::optional<double> dilation_ratio, strength_factor;

  /// Calls visit(name, value) for every parameter that not every model has.
  template <class Visitor>
  void for_each_of_some(Visitor&& visit) const {
    visit("cohesion", cohesion);
    visit("friction_angle", friction_angle);
    visit("dilation_angle", dilation_angle);
    visit("dilation_cutoff", dilation_cutoff);
    visit("tension_cutoff", tension_cutoff);
    visit("residual_strain", residual_strain);
    visit("residual_cohesion", residual_cohesion);
    visit("residual_friction_angle", residual_friction_angle);
    visit("compression_index", compression_index);
    visit("swelling_index", swelling_index);
    visit("critical_stress_ratio", critical_stress_ratio);
    visit("preconsolidation_pressure", preconsolidation_pressure);
    visit("intact_strength", intact_strength);
    visit("m_i", m_i);
    visit("gsi", gsi);
    visit("disturbance", disturbance);
    visit("power_coefficient", power_coefficient);
    visit("power_exponent", power_exponent);
    visit("power_tension", power_tension);
    visit("reference_stress", reference_stress);
    visit("dilation_ratio", dilation_ratio);
    visit("strength_factor", strength_factor);
  }
};

/// An element test as its file describes it.
struct Path {
  std::string title;
  Soil material;
  std::vector<double>
      initial_stress;  // [Pa] rows xx yy zz xy yz zx, or the first three; empty: none
  std::vector<Stage> stage;
};

/// What a stage prescribes of each row, whatever its test.
struct Prescription {
  std::array<Control, 6> control{};
  std::array<double, 6> change{};
};
[[nodiscard]] Prescription prescription_of(const Stage& stage);

/// The parameters of a checked path.
[[nodiscard]] constitutive::MaterialParameters parameters_of(const Path& path);

/// A path, if it is without a fault, and every complaint.
struct PathReading {
  std::optional<Path> path;
  std::vector<tables::Complaint> errors;
};
/// Reads a path's text, settings (`material.cohesion=5e3`) applied. Never throws for what the user
/// wrote.
[[nodiscard]] PathReading read_path(std::string_view text, const std::string& source,
                                    std::span<const std::string> settings = {});

/// All keys as Markdown.
[[nodiscard]] std::string path_reference();

}  // namespace material
