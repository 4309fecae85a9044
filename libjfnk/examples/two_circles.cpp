// Where two circles meet: the shortest system with two roots, and with none.
//
//   jfnk_two_circles          radii 2 and 1.5, centres 2 apart
//   jfnk_two_circles 1 1 3    circles that do not meet: the solver says so
//
// Each start finds the root on its side. Shows bounds, which keep the solver on that side, and how
// a failure is read.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "jfnk/jfnk.hpp"

int main(int argc, char** argv) {
  const double a = argc > 1 ? std::atof(argv[1]) : 2.0;
  const double b = argc > 2 ? std::atof(argv[2]) : 1.5;
  const double distance = argc > 3 ? std::atof(argv[3]) : 2.0;
  if (!(a > 0.0 && b > 0.0 && distance > 0.0)) {
    std::fprintf(stderr, "usage: jfnk_two_circles [radius > 0] [radius > 0] [distance > 0]\n");
    return 2;
  }
  const auto residual = [=](const jfnk::Vector& u, jfnk::Vector& r) {
    r[0] = u[0] * u[0] + u[1] * u[1] - a * a;
    r[1] = (u[0] - distance) * (u[0] - distance) + u[1] * u[1] - b * b;
  };
  bool all_converged = true;
  for (const double side : {1.0, -1.0}) {
    jfnk::Options options;
    options.tolerances.relative = 1e-10;
    options.lower = Eigen::Vector2d(-1e3, side > 0.0 ? 0.0 : -1e3);
    options.upper = Eigen::Vector2d(1e3, side > 0.0 ? 1e3 : 0.0);
    jfnk::Vector u = Eigen::Vector2d(1.0, side);
    const jfnk::Report report = jfnk::solve(residual, u, options);
    if (report.converged()) {
      std::printf("(%.6f, %.6f) after %d evaluations\n", u[0], u[1], report.counts.total());
    } else {
      std::printf("none: %s\n", report.reason.c_str());
      all_converged = false;
    }
  }
  return all_converged ? 0 : 3;
}
