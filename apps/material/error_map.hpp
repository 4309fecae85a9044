#pragma once

#include <string>
#include <vector>

#include "constitutive/material.hpp"

namespace material {

/// Where a map begins: a point of the yield surface, and the steps that are tried from there.
struct ErrorMapCase {
  std::string name;   // of its files
  std::string title;  // of its picture
  constitutive::MaterialParameters parameters;
  double mean_stress = 0.0;  // [Pa]
  /// Principal values of the direction from that mean stress to the surface, falling, sum 0.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
};

/// How far one step is from as good as infinitely many, over a grid of steps of constant volume in
/// principal axes: so far along the deviator of the stress it begins with (outward), so far across.
/// Both in the elastic strain of that deviator.
struct ErrorMap {
  ErrorMapCase of;
  std::vector<double> outward, across;
  std::vector<double> error;  // relative, of the stress; outward by outward, across inner
  double uncertainty = 0.0;   // largest, of the stress it is held against

  [[nodiscard]] double at(std::size_t i, std::size_t j) const {
    return error[i * across.size() + j];
  }
};

/// The cases of the documentation: every surface, from the compression meridian and from shear.
[[nodiscard]] std::vector<ErrorMapCase> error_map_cases();

/// A map of `count` x `count` steps up to `widest` elastic strains. The exact stress is
/// extrapolated with first order from `parts` and twice as many parts of a step; what the two
/// differ by is the uncertainty.
/// @throws std::invalid_argument if the direction never comes to a yield surface.
[[nodiscard]] ErrorMap error_map(const ErrorMapCase& of, std::size_t count = 41,
                                 double widest = 6.0, int parts = 200);

/// Where a field on the map's grid has a value: lines, apart by a point that is not a number.
struct Contour {
  std::vector<double> across, outward;
};
[[nodiscard]] Contour contour(const ErrorMap& map, double level);

/// A line per step.
[[nodiscard]] std::string csv_text(const ErrorMap& map);
/// Lines of equal error.
[[nodiscard]] std::string map_picture(const ErrorMap& map);
/// A row of Markdown per map: the largest error, where, the mean, the uncertainty.
[[nodiscard]] std::string table_of(const std::vector<ErrorMap>& maps);

}  // namespace material
