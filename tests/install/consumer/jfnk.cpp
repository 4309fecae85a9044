// Solves x^2 + y^2 = 2, x = y from (2, 1/2); the root is (1, 1).
#include <cmath>
#include <jfnk/solver.hpp>

int main() {
  const auto residual = [](const jfnk::Vector& u, jfnk::Vector& r) {
    r[0] = u[0] * u[0] + u[1] * u[1] - 2.0;
    r[1] = u[0] - u[1];
  };
  jfnk::Options options;
  options.tolerances.relative = 1e-10;
  jfnk::Vector u(2);
  u << 2.0, 0.5;
  jfnk::Solver solver(options);
  const bool converged = solver.solve(residual, u).converged();
  // ||F(u0)|| = 2.7 and the Jacobian's inverse is below 1 at the root: the error is below 1e-9.
  const bool at_root = std::abs(u[0] - 1.0) < 1e-9 && std::abs(u[1] - 1.0) < 1e-9;
  return converged && at_root ? 0 : 1;
}
