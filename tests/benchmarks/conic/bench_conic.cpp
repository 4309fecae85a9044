// A weightless strip on soil of 20 degrees, by one solver after the other:
//   fpm-bench-conic RAYS RINGS lower|upper solver   -> rows of `table`, for fpm-limit's own solvers
//   fpm-bench-conic RAYS RINGS lower|upper sdpa     -> the programme in SDPA's sparse format
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <numbers>
#include <string>

#include "limit/certificate/lower_certificate.hpp"
#include "limit/certificate/upper_certificate.hpp"
#include "limit/problem/case.hpp"
#include "limit/programme/lower_bound.hpp"
#include "limit/programme/upper_bound.hpp"
#include "limit/solver/cone_solver.hpp"
#include "limit/solver/scaled_program.hpp"

namespace {

using namespace limit;

constexpr double exact = 14.834712;  // N_c of 20 degrees

double off(double multiplier, const problem::Units& units) {
  return 100.0 * (multiplier * units.stress / exact - 1.0);
}

void solve_and_certify(const problem::Problem& problem, const problem::Units& units, bool is_lower,
                       solver::ConeForm form) {
  const programme::ConeProgram program =
      is_lower ? programme::lower_bound_program(problem) : programme::upper_bound_program(problem);
  solver::SolverOptions options;
  options.form = form;
  const std::clock_t began = std::clock();
  const solver::ConeSolution found = solver::solve(program, options);
  const double seconds = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
  double multiplier = 0.0;
  bool holds = false;
  if (is_lower) {
    const certificate::LowerCertificate certificate = certificate::certify_lower(
        problem, programme::stress_field(problem, found.variables), found.variables.tail(1)[0]);
    multiplier = certificate.multiplier;
    holds = certificate.holds;
  } else {
    const certificate::UpperCertificate certificate =
        certificate::certify_upper(problem, programme::velocity_field(problem, found.multipliers),
                                   programme::velocity_field(problem, found.interior_multipliers));
    multiplier = certificate.multiplier;
    holds = certificate.holds;
  }
  fmt::print("| {} | {} | {} | {:+.3f} % | {}{} | {} | {:.2f} |\n", is_lower ? "lower" : "upper",
             problem.mesh.triangles.size(),
             form == solver::ConeForm::cones ? "interior point" : "Ipopt", off(multiplier, units),
             found.message, holds ? ", certified" : "", found.iterations, seconds);
}

// SDPA's dual: maximise F0.Y subject to Fi.Y = ci, with Y >= 0 made of a 2 x 2 block
// [s + d, t; t, s - d] per cone and a number for the multiplier. p = (strength - s) / slope.
void print_sdpa(const programme::ConeProgram& program) {
  const solver::ScaledProgram scaled(program);
  const auto cones = static_cast<Eigen::Index>(scaled.cones.size());
  fmt::print("{}\n{}\n", scaled.equations.rows(), cones + 1);
  for (Eigen::Index k = 0; k < cones; ++k) fmt::print("2 ");
  fmt::print("-1\n");
  Eigen::VectorXd right_side = scaled.right_side;
  std::string entries = fmt::format("0 {} 1 1 {:.17g}\n", cones + 1, -scaled.cost.tail(1)[0]);
  for (Eigen::Index i = 0; i < scaled.equations.rows(); ++i) {
    Eigen::VectorXd row = scaled.equations.row(i).transpose();
    for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator at(scaled.equations, i); at;
         ++at) {
      const Eigen::Index k = at.col() / 3;
      if (k == cones) {
        entries += fmt::format("{} {} 1 1 {:.17g}\n", i + 1, k + 1, at.value());
        continue;
      }
      const programme::YieldCone& cone = scaled.cones[static_cast<std::size_t>(k)];
      const Eigen::Vector3d form = row.segment<3>(3 * k);
      if (form.isZero(0.0)) continue;
      right_side[i] -= form[0] * cone.strength / cone.slope;
      const double mean = -form[0] / cone.slope / 2.0;
      entries +=
          fmt::format("{0} {1} 1 1 {2:.17g}\n{0} {1} 2 2 {3:.17g}\n{0} {1} 1 2 {4:.17g}\n", i + 1,
                      k + 1, mean + form[1] / 2.0, mean - form[1] / 2.0, form[2] / 2.0);
      row.segment<3>(3 * k).setZero();  // once per cone
    }
  }
  for (const double c : right_side) fmt::print("{:.17g} ", c);
  fmt::print("\n{}", entries);
}

}  // namespace

int main(int count, char** words) {
  if (count != 5) {
    fmt::print(stderr, "usage: fpm-bench-conic RAYS RINGS lower|upper solver|sdpa\n");
    return 2;
  }
  const bool is_lower = std::string(words[3]) == "lower";
  problem::Strip strip;
  strip.soil = {1.0, 20.0 * std::numbers::pi / 180.0, 0.0};
  strip.rough = false;
  const problem::Box box = problem::box_of(strip);
  const problem::Units units = problem::units_of(strip);
  const problem::Problem problem = problem::in_units(
      problem::strip_problem(strip, mesh::even_fan(box.width, box.depth, std::atoi(words[1]),
                                                   std::atoi(words[2]), is_lower ? 1.5 : 2.0)),
      units);
  if (std::string(words[4]) == "sdpa") {
    print_sdpa(is_lower ? programme::lower_bound_program(problem)
                        : programme::upper_bound_program(problem));
    return 0;
  }
  solve_and_certify(problem, units, is_lower, solver::ConeForm::cones);
  solve_and_certify(problem, units, is_lower,
                    is_lower ? solver::ConeForm::inequality : solver::ConeForm::barrier);
  return 0;
}
