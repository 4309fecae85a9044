#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "limit/ground/ground_cases.hpp"
#include "limit/problem/envelope.hpp"

// Ground of curved envelopes.
namespace limit {

inline constexpr const char* rock =
    "model = \"hoek_brown\"\nintact_strength = 20e6\nm_i = 10\ngsi = 45\ndisturbance = 0.2\n";
inline constexpr const char* power =
    "model = \"power_law\"\npower_coefficient = 0.8\npower_exponent = 0.7\npower_tension = 100e3\n"
    "reference_stress = 500e3\n";

inline problem::Envelope rock_envelope() {
  return problem::hoek_brown(20e6, 10.0, 45.0, 0.2);
}
inline problem::Envelope power_envelope() {
  return {problem::Envelope::Kind::power_law, 500e3, 0.8, 0.7, 0.2};
}

inline std::string material(const std::string& curve, double weight = 0.0) {
  return fmt::format("[[material]]\nname = \"rock\"\n{}unit_weight = {}\n", curve, weight);
}

inline bracket::Solution first_mesh(const std::string& text) {
  const auto problem = case_of(text);
  EXPECT_TRUE(problem);
  bracket::BracketOptions options;
  options.max_triangles = 1;
  return problem ? bracket::solution_of(problem->associated, options, {}) : bracket::Solution{};
}

// A block under smooth platens, pressed from the sides.
inline std::string block(const std::string& curve, double cell) {
  return "[load]\nsought = \"traction\"\n" + material(curve) +
         fmt::format(R"([[region]]
material = "rock"
outline = [[0, 0], [2, 0], [2, 3], [0, 3]]
[[side]]
name = "face"
kind = "loaded"
pressure = {}
along = [[2, 0], [2, 3]]
[[side]]
name = "top"
kind = "loaded"
live_pressure = 1
along = [[0, 3], [2, 3]]
[[side]]
name = "axes"
kind = "symmetry"
along = [[0, 3], [0, 0], [2, 0]]
)",
                     cell);
}

}  // namespace limit
