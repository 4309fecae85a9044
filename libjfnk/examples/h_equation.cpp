// Chandrasekhar's H-equation of radiative transfer: H(mu) = 1 / (1 - c/2 int mu H(nu)/(mu+nu) dnu).
//
//   jfnk_h_equation          200 midpoints, albedo c = 0.9
//   jfnk_h_equation 500 1    the conservative case, where the root is double
//
// Shows a domain (the denominator must stay positive), an observer, and a check: by symmetry of
// the kernel the mean of the discrete H is (2/c) (1 - sqrt(1 - c)) exactly.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "jfnk/jfnk.hpp"

int main(int argc, char** argv) {
  const int n = argc > 1 ? std::atoi(argv[1]) : 200;
  const double c = argc > 2 ? std::atof(argv[2]) : 0.9;
  if (n < 1 || !(c > 0.0 && c <= 1.0)) {
    std::fprintf(stderr, "usage: jfnk_h_equation [points >= 1] [0 < c <= 1]\n");
    return 2;
  }
  const auto residual = [=](const jfnk::Vector& h, jfnk::Vector& r) {
    for (int i = 0; i < n; ++i) {
      double sum = 0.0;
      for (int j = 0; j < n; ++j) sum += (i + 0.5) / (i + j + 1.0) * h[j];
      const double denominator = 1.0 - 0.5 * c / n * sum;
      if (denominator <= 0.0) return jfnk::Evaluation::out_of_domain;
      r[i] = h[i] - 1.0 / denominator;
    }
    return jfnk::Evaluation::ok;
  };
  const auto print = [](const jfnk::Iteration& line) {
    std::printf("%3d  ||F|| = %.3e  lambda = %.2f  eta = %.1e  evaluations = %d\n", line.index,
                line.residual_norm, line.step_length, line.forcing, line.evaluations);
  };

  jfnk::Options options;
  options.tolerances.relative = 1e-10;
  jfnk::Vector h = jfnk::Vector::Ones(n);
  const jfnk::Report report = jfnk::solve(residual, h, options, jfnk::Identity{}, print);
  std::printf("%s\nmean H = %.9f, exact %.9f\n", report.reason.c_str(), h.mean(),
              2.0 / c * (1.0 - std::sqrt(1.0 - c)));
  return report.converged() ? 0 : 3;
}
