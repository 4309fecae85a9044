#include "jfnk/solver.hpp"

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

#include "problems.hpp"

namespace {

using jfnk::Iteration;
using jfnk::Method;
using jfnk::Options;
using jfnk::Report;
using jfnk::solve;
using jfnk::Solver;
using jfnk::Status;
using jfnk::Vector;
using jfnk_test::all_methods;

bool same_bits(const Vector& a, const Vector& b) {
  return (a.array() == b.array()).all();
}

Vector solve_bratu(Solver& solver) {
  const jfnk_test::Bratu bratu(12, 6.0);
  const jfnk_test::CholeskyPreconditioner P(jfnk_test::laplacian(12));
  Vector u = Vector::Zero(bratu.size());
  EXPECT_TRUE(solver.solve(bratu, u, P).converged());
  return u;
}

TEST(Solver, RepeatsItselfBitForBit) {
  for (const Method method : all_methods) {
    Options options;
    options.method = method;
    Solver fresh(options);
    Solver used(options);
    const Vector first = solve_bratu(used);
    Vector other = Vector::Constant(7, 0.5);  // another size between the two
    (void)used.solve([](const Vector& u, Vector& r) { r = u.array() - 0.2 * u.array().cos(); },
                     other);
    EXPECT_TRUE(same_bits(first, solve_bratu(used)));
    EXPECT_TRUE(same_bits(first, solve_bratu(fresh)));
  }
}

TEST(Solver, DistinctSolversRunInDistinctThreads) {
  Solver serial;
  const Vector expected = solve_bratu(serial);
  std::vector<Vector> results(4);
  std::vector<std::thread> threads;
  for (Vector& result : results) {
    threads.emplace_back([&result] {
      Solver solver;
      result = solve_bratu(solver);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Vector& result : results) EXPECT_TRUE(same_bits(result, expected));
}

TEST(Solver, LastEvaluationOfASuccessIsAtTheSolution) {
  const jfnk_test::Bratu bratu(10, 6.0);
  const jfnk_test::CholeskyPreconditioner P(jfnk_test::laplacian(10));
  for (const Method method : all_methods) {
    Options options;
    options.method = method;
    Vector last;
    const auto F = [&](const Vector& u, Vector& r) {
      last = u;
      bratu(u, r);
    };
    Vector u = Vector::Zero(bratu.size());
    ASSERT_TRUE(solve(F, u, options, P).converged());
    EXPECT_TRUE(same_bits(last, u));
  }
}

TEST(Solver, CountsEveryCallByPurpose) {
  struct Counting : jfnk_test::BratuWithJacobian {
    using BratuWithJacobian::BratuWithJacobian;
    void operator()(const Vector& u, Vector& r) {
      ++residuals;
      BratuWithJacobian::operator()(u, r);
    }
    void linearise(const Vector& u) {
      ++linearisations;
      BratuWithJacobian::linearise(u);
    }
    void apply_jacobian(const Vector& v, Vector& Jv) {
      ++actions;
      BratuWithJacobian::apply_jacobian(v, Jv);
    }
    int residuals = 0;
    int linearisations = 0;
    int actions = 0;
  };
  struct CountingPreconditioner {
    jfnk_test::CholeskyPreconditioner inner;
    int applications = 0;
    int setups = 0;
    void apply(const Vector& r, Vector& z) {
      ++applications;
      inner.apply(r, z);
    }
    void setup(const Vector&) { ++setups; }
  };
  for (const Method method : all_methods) {
    for (const auto source :
         {jfnk::Jacobian::Source::user_if_available, jfnk::Jacobian::Source::finite_difference}) {
      Counting F(10, 6.0);
      CountingPreconditioner P{jfnk_test::CholeskyPreconditioner(jfnk_test::laplacian(10))};
      Options options;
      options.method = method;
      options.jacobian.source = source;
      options.preconditioner_setup = jfnk::PreconditionerSetup::every_newton_step;
      Vector u = Vector::Zero(F.size());
      const Report report = solve(F, u, options, P);
      ASSERT_TRUE(report.converged());
      EXPECT_EQ(report.counts.residuals(), F.residuals);
      EXPECT_EQ(report.counts.user_actions, F.actions);
      EXPECT_EQ(report.counts.linearisations, F.linearisations);
      EXPECT_EQ(report.counts.preconditioner, P.applications);
      EXPECT_EQ(report.counts.preconditioner_setups, P.setups);
      EXPECT_EQ(P.setups, std::max(1, report.newton_iterations));
      EXPECT_EQ(report.counts.total(), F.residuals + F.actions);
      EXPECT_EQ(report.history.back().evaluations, report.counts.total());
    }
  }
}

TEST(Solver, KeepsTheEvaluationLimitExactly) {
  for (const Method method : all_methods) {
    for (const int limit : {1, 2, 3, 7, 12}) {
      Options options;
      options.method = method;
      options.max_evaluations = limit;
      options.tolerances.relative = 1e-13;
      int calls = 0;
      const jfnk_test::Bratu bratu(10, 6.0);
      const auto F = [&](const Vector& u, Vector& r) {
        ++calls;
        bratu(u, r);
      };
      Vector u = Vector::Zero(bratu.size());
      const Report report = solve(F, u, options);
      EXPECT_EQ(report.status, Status::evaluation_limit);
      EXPECT_EQ(calls, limit);
      EXPECT_EQ(report.counts.total(), limit);
      Vector r(bratu.size());
      bratu(u, r);
      EXPECT_DOUBLE_EQ(r.norm(), report.residual_norm);  // sums in another order
      EXPECT_LE(report.residual_norm, report.initial_residual_norm);
    }
  }
}

TEST(Solver, UsesTheResidualsOwnReferenceNorm) {
  struct Scaled {
    void operator()(const Vector& u, Vector& r) {
      r = u;
      scale = 1.0 + u.norm();
    }
    double reference_norm() const { return 1e3 * scale; }
    double scale = 0.0;
  };
  Options options;
  options.tolerances.relative = 1e-3;
  Vector u = Vector::Constant(1, 10.0);
  const Report report = solve(Scaled{}, u, options);
  EXPECT_TRUE(report.converged());
  EXPECT_EQ(report.counts.total(), 1);  // ||F|| = 10 is already below 1e-3 * 1e3 * 11
  EXPECT_EQ(report.reference_norm, 11e3);
  EXPECT_NEAR(report.tolerance, 11.0, 1e-12);
}

TEST(Solver, MeasuresInTheResidualsOwnInnerProduct) {
  struct Weighted {
    void operator()(const Vector& u, Vector& r) const { r = u.array() - 1.0; }
    double dot(const Vector& a, const Vector& b) const { return 4.0 * a.dot(b); }
  };
  for (const Method method : all_methods) {
    Options options;
    options.method = method;
    Vector u = Vector::Zero(9);
    const Report report = solve(Weighted{}, u, options);
    EXPECT_TRUE(report.converged());
    EXPECT_EQ(report.initial_residual_norm, 6.0);
  }
}

TEST(Solver, ObserverSeesEachIterationAndMayStop) {
  const jfnk_test::Bratu bratu(10, 6.0);
  std::vector<Iteration> seen;
  Vector u = Vector::Zero(bratu.size());
  const Report full = solve(bratu, u, Options{}, jfnk::Identity{},
                            [&](const Iteration& line) { seen.push_back(line); });
  ASSERT_EQ(seen.size(), full.history.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i].index, static_cast<int>(i));
    EXPECT_EQ(seen[i].residual_norm, full.history[i].residual_norm);
  }
  u.setZero();
  const Report cut = solve(bratu, u, Options{}, jfnk::Identity{},
                           [](const Iteration& line) { return line.index < 2; });
  EXPECT_EQ(cut.status, Status::stopped);
  EXPECT_EQ(cut.history.size(), 3u);
  EXPECT_EQ(cut.residual_norm, full.history[2].residual_norm);
}

TEST(Solver, ExceptionsPassThroughAndLeaveUAndTheSolverUsable) {
  const jfnk_test::Bratu bratu(12, 6.0);
  Solver solver;
  int calls = 0;
  const auto throwing = [&](const Vector& u, Vector& r) {
    if (++calls == 6) throw std::runtime_error("from the residual");
    bratu(u, r);
  };
  Vector u = Vector::Zero(bratu.size());
  EXPECT_THROW((void)solver.solve(throwing, u), std::runtime_error);
  EXPECT_EQ(u.norm(), 0.0);
  Solver fresh;
  EXPECT_TRUE(same_bits(solve_bratu(solver), solve_bratu(fresh)));
}

TEST(Solver, RefusesAnEmptyVectorAndAResizingResidual) {
  Vector empty;
  EXPECT_THROW((void)solve([](const Vector&, Vector&) {}, empty), std::invalid_argument);
  Vector u = Vector::Ones(3);
  try {
    (void)solve([](const Vector&, Vector& r) { r = Vector::Ones(2); }, u);
    FAIL() << "a residual of another size was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "jfnk: the residual resized its output from 3 to 2");
  }
}

TEST(Solver, AcceptsResidualsOfEveryForm) {
  struct ConstResidual {
    bool operator()(const Eigen::Ref<const Vector>& u, Eigen::Ref<Vector> r) const {
      r = 2.0 * u;
      return true;
    }
  };
  const ConstResidual constant;
  Vector u = Vector::Ones(2);
  EXPECT_TRUE(solve(constant, u).converged());
  u.setOnes();
  EXPECT_TRUE(solve(ConstResidual{}, u).converged());
  u.setOnes();
  auto mutating = [n = 0](const Vector& v, Vector& r) mutable {
    ++n;
    r = v;
  };
  EXPECT_TRUE(solve(mutating, u).converged());
  static_assert(!jfnk::Residual<int>);
  static_assert(!jfnk::HasJacobian<ConstResidual>);
  static_assert(jfnk::HasJacobian<jfnk_test::BratuWithJacobian>);
}

/// Bytes that are allocated now; 0 where another allocator stands in for the C library's.
std::size_t allocated() {
  const struct mallinfo2 info = ::mallinfo2();
  return info.uordblks + info.hblkhd;
}

TEST(SolverMemory, IsToldAsItIsAndAsItWillBe) {
  // The table of --check and its like promise a tenth.
  constexpr double tenth = 0.1;
  const jfnk_test::Bratu bratu(80, 6.0);
  const int n = bratu.size();
  const auto weak = [](const Vector& r, Vector& z) { z = 0.2 * r; };
  Options single = jfnk::plasticity();
  single.krylov.single_precision = single.multisecant.single_precision = true;
  for (const Options& options :
       {jfnk::plasticity(), single, jfnk::newton_krylov(), jfnk::hybrid()}) {
    Vector u = Vector::Zero(n);
    const std::size_t before = allocated();
    Solver solver(options);
    (void)solver.solve(bratu, u, weak);
    const auto held = static_cast<double>(allocated() - before);
    const auto told = static_cast<double>(solver.bytes());
    const bool learns = solver.report().counts.learning > 0;
    if (before > 0 && !learns) {
      EXPECT_NEAR(told, held, tenth * held);
    }
    const int krylov = options.krylov.restart;
    const auto at_most = static_cast<double>(solver.bytes_to_come(n, true, krylov));
    EXPECT_LE(told, (1.0 + tenth) * at_most);
  }
  // All pairs and few Krylov vectors: as foretold.
  Options options = jfnk::plasticity();
  options.method = Method::multisecant;
  options.max_iterations = 60;
  Solver solver(options);
  Vector u = Vector::Zero(n);
  (void)solver.solve(bratu, u, weak);
  const auto told = static_cast<double>(solver.bytes());
  EXPECT_NEAR(static_cast<double>(solver.bytes_to_come(n, true)), told, tenth * told);
}

}  // namespace
