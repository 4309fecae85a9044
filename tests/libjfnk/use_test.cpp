// The ways of calling that are promised: compiled here, and solved.
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <vector>

#include "jfnk/jfnk.hpp"

#pragma GCC diagnostic error "-Wextra"
#pragma GCC diagnostic error "-Wmissing-field-initializers"

namespace {

using jfnk::Iteration;
using jfnk::Options;
using jfnk::Report;
using jfnk::solve;
using jfnk::Solver;
using jfnk::Status;
using jfnk::Vector;

// u_i^3 = i + 1.
template <class U, class R>
void cubes(const U& u, R& r) {
  for (int i = 0; i < 3; ++i) r[i] = u[i] * u[i] * u[i] - (i + 1.0);
}

template <class U>
void expect_roots(const U& u) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(u[i], std::cbrt(i + 1.0), 1e-4);
}

void function(const Vector& u, Vector& r) {
  cubes(u, r);
}
int lines_seen = 0;
void see(const Iteration&) {
  ++lines_seen;
}
void third(const Vector& r, Vector& z) {
  z = r / 3.0;
}

TEST(Use, FunctionsAndPointersToThemServeAsEverything) {
  Vector u = Vector::Ones(3);
  lines_seen = 0;
  EXPECT_TRUE(solve(function, u, {}, third, see).converged());
  EXPECT_GT(lines_seen, 0);
  expect_roots(u);
  u.setOnes();
  EXPECT_TRUE(solve(&function, u, {}, &third, &see).converged());
  expect_roots(u);
  EXPECT_TRUE(jfnk::check(function, u).good);
  Vector x = Vector::Zero(3);
  EXPECT_EQ(jfnk::gmres(third, Vector::Ones(3), x).status, jfnk::KrylovStatus::converged);
  const jfnk::ColouredJacobian jacobian(function, jfnk::banded_sparsity(3, 0, 0));
  EXPECT_EQ(jacobian.colours(), 1);
}

TEST(Use, LambdasServeAsPreconditionerAndObserver) {
  Vector u = Vector::Ones(3);
  int applied = 0;
  int seen = 0;
  const Report report = solve(
      function, u, {},
      [&](const Vector& r, Vector& z) {
        ++applied;
        z = r / 3.0;
      },
      [&](const Iteration&) { return ++seen < 1000; });
  EXPECT_TRUE(report.converged());
  EXPECT_EQ(applied, report.counts.preconditioner);
  EXPECT_EQ(seen, static_cast<int>(report.history.size()));
  expect_roots(u);
}

TEST(Use, VectorsOfEigenOfAnyKind) {
  std::array<double, 5> memory{9.0, 1.0, 1.0, 1.0, 9.0};
  Eigen::Map<Vector> mapped(memory.data() + 1, 3);
  EXPECT_TRUE(solve(function, mapped).converged());
  expect_roots(mapped);
  EXPECT_EQ(memory.front(), 9.0);
  EXPECT_EQ(memory.back(), 9.0);
  mapped.setOnes();
  EXPECT_TRUE(solve(function, Eigen::Map<Vector>(memory.data() + 1, 3)).converged());
  expect_roots(mapped);

  Vector whole = Vector::Ones(7);
  EXPECT_TRUE(solve(function, whole.segment(2, 3)).converged());
  expect_roots(whole.segment(2, 3));
  EXPECT_EQ(whole[1], 1.0);

  Eigen::Vector3d fixed = Eigen::Vector3d::Ones();
  EXPECT_TRUE(solve(function, fixed).converged());
  expect_roots(fixed);
  fixed.setOnes();
  const auto on_fixed = [](const Eigen::Vector3d& u, Eigen::Vector3d& r) { cubes(u, r); };
  EXPECT_TRUE(solve(on_fixed, fixed).converged());
  expect_roots(fixed);
  fixed.setOnes();
  EXPECT_TRUE(solve([](const auto& u, auto& r) { cubes(u, r); }, fixed).converged());
  expect_roots(fixed);
  const auto on_refs = [](const Eigen::Ref<const Vector>& u, Eigen::Ref<Vector> r) { cubes(u, r); };
  fixed.setOnes();
  EXPECT_TRUE(solve(on_refs, fixed).converged());
  expect_roots(fixed);
}

TEST(Use, StdVectorsInASolverStepByStepAndThroughASnapshot) {
  using V = std::vector<double>;
  const auto F = [](const V& u, V& r) { cubes(u, r); };
  const auto P = [](const V& r, V& z) {
    for (std::size_t i = 0; i < 3; ++i) z[i] = r[i] / 3.0;
  };
  const V start(3, 1.0);
  V whole = start;
  Solver solver;
  ASSERT_TRUE(solver.solve(F, whole, P).converged());
  expect_roots(whole);
  bool more = solver.start(F, start, P);
  for (int i = 0; more && i < 2; ++i) more = solver.step(F, start, P);
  ASSERT_TRUE(more);
  Solver other;
  other.load(solver.save());
  while (other.step(F, start, P)) {
  }
  EXPECT_TRUE(other.report().converged());
  V stepped(3);
  other.solution(stepped);
  EXPECT_EQ(stepped, whole);
}

TEST(Use, DesignatedInitialisersNameWhatIsChosen) {
  const Options options{.method = jfnk::Method::newton_krylov,
                        .tolerances = {.relative = 1e-10},
                        .krylov = {.restart = 10, .forcing = {.initial = 0.1}}};
  EXPECT_EQ(options.krylov.forcing.initial, 0.1);
  EXPECT_EQ(options.multisecant.memory, Options{}.multisecant.memory);
  Vector u = Vector::Ones(3);
  EXPECT_TRUE(solve(function, u, options).converged());
  EXPECT_TRUE(solve(function, u, {.max_evaluations = 500}).converged());
}

TEST(Use, AMessageShowsANumberAsItIs) {
  Options options;
  options.lower = Vector::Zero(3);
  options.tolerances.relative = -1e-9;
  EXPECT_NE(jfnk::validate(options).front().find("-1e-09"), std::string::npos);
  options.tolerances.relative = 1e-6;
  Vector u = Vector::Ones(3);
  u[1] = -1e-9;
  try {
    (void)solve(function, u, options);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("u[1] = -1e-09"), std::string::npos) << e.what();
  }
}

TEST(Use, ASolverThatWasNotStartedSaysSo) {
  const Solver solver;
  EXPECT_EQ(solver.report().status, Status::not_started);
  EXPECT_FALSE(solver.report().reason.empty());
  EXPECT_FALSE(Report{}.converged());
}

TEST(Use, AfterAnExceptionThereIsNothingLeftToDo) {
  int calls = 0;
  int last = 4;
  const auto F = [&](const Vector& u, Vector& r) {
    if (++calls == last) throw std::runtime_error("out of paper");
    cubes(u, r);
  };
  Solver solver;
  bool more = solver.start(F, Vector::Ones(3));
  EXPECT_THROW(while (more) more = solver.step(F), std::runtime_error);
  EXPECT_EQ(solver.report().status, Status::threw);
  EXPECT_NE(solver.report().reason.find("begin again"), std::string::npos);
  EXPECT_EQ(solver.solution().size(), 3);
  EXPECT_FALSE(solver.step(F));
  EXPECT_EQ(calls, last);
  EXPECT_THROW((void)solver.save(), std::invalid_argument);
  last = calls + 1;  // at the start
  EXPECT_THROW((void)solver.start(F, Vector::Ones(3)), std::runtime_error);
  EXPECT_EQ(solver.report().status, Status::threw);
  EXPECT_FALSE(solver.step(F));
  for (more = solver.start(F, Vector::Ones(3)); more;) more = solver.step(F);
  EXPECT_TRUE(solver.report().converged());
}

}  // namespace
