// The gradient of a linear field on a jittered lattice is exact.
#include <cmath>
#include <fpm/moment_operator.hpp>

int main() {
  const double spacing = 0.125, slope_x = 2.0, slope_y = -3.0;
  const auto particles = fpm::make_lattice<2>({.spacing = spacing, .jitter = 0.2});
  const fpm::Ghosts<2> no_ghosts;
  const fpm::Rows<2> rows(particles, no_ghosts,
                          {.support_radius = 2.4 * spacing, .spacing = spacing});
  const fpm::MomentOperator<2> gradient(rows, no_ghosts, fpm::Channels{});

  const auto field = [&](fpm::Index a) {
    return slope_x * particles.position(a, 0) + slope_y * particles.position(a, 1);
  };
  double worst = 0.0;
  for (fpm::Index a = 0; a < particles.size(); ++a) {
    double x = 0.0, y = 0.0;
    gradient.for_each_entry(a, [&](fpm::Index b, const double* weights) {
      x += weights[0] * (field(b) - field(a));
      y += weights[1] * (field(b) - field(a));
    });
    worst = std::fmax(worst, std::fmax(std::abs(x - slope_x), std::abs(y - slope_y)));
  }
  // Some twenty weights of order 1 / spacing and moment matrices of condition below 1e4.
  return particles.size() == 64 && worst < 1e-10 ? 0 : 1;
}
