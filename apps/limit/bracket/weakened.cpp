#include "limit/bracket/weakened.hpp"

#include <cmath>

namespace limit::bracket {

problem::Soil weakened(const problem::Soil& soil, double factor) {
  problem::Soil weak = soil;
  weak.cohesion /= factor;
  weak.cohesion_gradient /= factor;
  weak.divisor *= factor;
  weak.tension /= factor;
  weak.envelope.factor *= factor;
  weak.friction_angle = std::atan(std::tan(soil.friction_angle) / factor);
  return weak;
}

std::vector<problem::Soil> weakened(std::vector<problem::Soil> soils, double factor) {
  for (problem::Soil& soil : soils) soil = weakened(soil, factor);
  return soils;
}

}  // namespace limit::bracket
