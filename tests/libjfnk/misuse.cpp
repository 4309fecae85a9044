// Near-misses that the compiler shall explain: each CASE of CMakeLists.txt must not compile.
#include <vector>

#include "jfnk/jfnk.hpp"

using jfnk::solve;
using jfnk::Vector;

struct Good {
  void operator()(const Vector& u, Vector& r) const { r = u; }
};
struct Linearize : Good {
  void linearize(const Vector&) {}
  void apply_jacobian(const Vector& v, Vector& Jv) const { Jv = v; }
};
struct NoLinearise : Good {
  void apply_jacobian(const Vector& v, Vector& Jv) const { Jv = v; }
};
struct ActionOfOneArgument : Good {
  void linearise(const Vector&) {}
  Vector apply_jacobian(const Vector& v) const { return v; }
};
struct AcceptMutable : Good {
  void on_accept(Vector&) {}
};
struct ReferenceNotConst : Good {
  double reference_norm() { return 1.0; }
};
struct SumsOfAMatrix : Good {
  double dot(const Vector& a, const Vector& b) const { return a.dot(b); }
  Vector dots(const Eigen::MatrixXd& columns, const Vector& w) const {
    return columns.transpose() * w;
  }
};
struct Solves {
  Vector solve(const Vector& r) const { return r; }
};
struct AppliesOne {
  Vector apply(const Vector& r) const { return r; }
};

int main() {
  Vector u = Vector::Ones(2);
  [[maybe_unused]] Good good;
#if CASE == 0
  return solve(good, u).converged() ? 0 : 1;
#elif CASE == 1
  return solve(Linearize{}, u).converged() ? 0 : 1;
#elif CASE == 2
  return solve(NoLinearise{}, u).converged() ? 0 : 1;
#elif CASE == 3
  return solve(ActionOfOneArgument{}, u).converged() ? 0 : 1;
#elif CASE == 4
  return solve(
             [](const Vector& v, Vector& r) {
               r = v;
               return 0;
             },
             u)
                 .converged()
             ? 0
             : 1;
#elif CASE == 5
  return solve([](const Vector& v) { return v; }, u).converged() ? 0 : 1;
#elif CASE == 6
  return solve(AcceptMutable{}, u).converged() ? 0 : 1;
#elif CASE == 7
  return solve(ReferenceNotConst{}, u).converged() ? 0 : 1;
#elif CASE == 8
  return solve(good, u, {}, Solves{}).converged() ? 0 : 1;
#elif CASE == 9
  return solve(good, u, {}, AppliesOne{}).converged() ? 0 : 1;
#elif CASE == 10
  return solve(good, u, {}, jfnk::Identity{}, [](const jfnk::Iteration&) { return 1; }).converged();
#elif CASE == 11
  return solve(good, std::vector<int>(2)).converged() ? 0 : 1;
#elif CASE == 12
  return solve(SumsOfAMatrix{}, u).converged() ? 0 : 1;
#endif
}
