#include "noise_level.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace jfnk::detail {

double random_sign(Eigen::Index i, int stream) {
  auto z = static_cast<std::uint64_t>(i) * 16 + static_cast<std::uint64_t>(stream);
  z = (z + 1) * 0x9E3779B97F4A7C15U;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return ((z >> 40U) & 1U) != 0 ? 1.0 : -1.0;
}

void random_direction(int stream, const InnerProductRef& product, Vector& direction) {
  for (Eigen::Index i = 0; i < direction.size(); ++i) direction[i] = random_sign(i, stream);
  direction /= product.norm(direction);
}

void project_sample(const Vector& r, int point, const InnerProductRef& product, Vector& signs,
                    NoiseSamples& samples) {
  for (int p = 0; p < noise_projections; ++p) {
    for (Eigen::Index i = 0; i < signs.size(); ++i) signs[i] = random_sign(i, p);
    samples[static_cast<std::size_t>(p)][static_cast<std::size_t>(point)] = product.dot(signs, r);
  }
}

NoiseVerdict judge_noise(NoiseSamples table, double& noise) {
  std::array<double, noise_points> level{};
  std::array<bool, noise_points> changes{};
  double factor = 1.0;  // (k!)^2 / (2k)!
  int zeros = 0;
  for (int k = 1; k < noise_points; ++k) {
    factor *= k / (4.0 * k - 2.0);
    double sum = 0.0;
    bool changed = false;
    for (auto& row : table) {
      for (int i = 0; i + k < noise_points; ++i) {
        const auto j = static_cast<std::size_t>(i);
        row[j] = row[j + 1] - row[j];
        if (k == 1 && row[j] == 0.0) ++zeros;
        if (i > 0 && row[j] * row[j - 1] < 0.0) changed = true;
        sum += row[j] * row[j];
      }
    }
    level[static_cast<std::size_t>(k)] =
        std::sqrt(factor * sum / (noise_projections * (noise_points - k)));
    changes[static_cast<std::size_t>(k)] = changed;
  }
  if (zeros >= noise_projections * (noise_points - 1) / 2) return NoiseVerdict::step_too_small;
  for (std::size_t k = 1; k + 2 < noise_points; ++k) {
    const auto [low, high] = std::minmax({level[k], level[k + 1], level[k + 2]});
    if (high <= 4.0 * low && changes[k]) {
      noise = level[k];
      return NoiseVerdict::found;
    }
  }
  return NoiseVerdict::step_too_large;
}

}  // namespace jfnk::detail
