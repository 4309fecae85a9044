#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "jfnk/jfnk.hpp"
#include "learning.hpp"
#include "problems.hpp"

// The Jacobian learnt by looking: what it spares.
namespace {

using jfnk::Evaluation;
using jfnk::Options;
using jfnk::Report;
using jfnk::Vector;
using jfnk_test::Bratu;
using jfnk_test::solve_from;
using jfnk_test::Sparse;
using jfnk_test::without_learning;

TEST(Learning, SparesMostEvaluationsOnALattice) {
  // GMRES on the Laplacian of m x m nodes takes some 2 m products for six digits; what is learnt
  // takes nine for the Jacobian, four for its diagonals and a test, whatever m is.
  for (const int m : {16, 32}) {
    const Bratu bratu(m, 6.0);
    const Report plain = solve_from(bratu, Vector::Zero(m * m), without_learning());
    const Report learnt = solve_from(bratu, Vector::Zero(m * m), Options{});
    ASSERT_TRUE(plain.converged() && learnt.converged());
    EXPECT_GT(learnt.counts.learning, 5);
    EXPECT_LE(learnt.counts.learning, 15);
    EXPECT_LT(learnt.counts.total(), plain.counts.total());
    EXPECT_LE(learnt.counts.total(), 35);
    EXPECT_EQ(plain.counts.learning, 0);
  }
}

TEST(Learning, WorksThroughTheResidualsOwnProducts) {
  jfnk_test::BratuWithJacobian bratu(24, 6.0);
  Vector u = Vector::Zero(24 * 24);
  const Report report = jfnk::solve(bratu, u, Options{});
  EXPECT_TRUE(report.converged());
  EXPECT_GT(report.counts.learning, 0);
  EXPECT_LT(report.counts.total(), 40);
}

TEST(Learning, GivesUpAfterOneColumnWhereEveryUnknownCountsEverywhere) {
  const jfnk_test::HEquation h(100, 0.99999);
  Options options;
  options.learning.worth = 0.0;  // or it would not even look
  options.learning.after = 3;
  const Report report = solve_from(h, Vector::Ones(100), options);
  EXPECT_TRUE(report.converged());
  // A point off the base, and one column.
  EXPECT_EQ(report.counts.learning, 2);
}

TEST(Learning, GivesUpAfterALookWhereUnknownsAreInNoOrder) {
  const Bratu bratu(24, 6.0);
  const int n = 24 * 24;
  const auto node = [&](int i) { return (233 * i + i * i * i) % n; };
  std::vector<int> place(n);
  std::vector<bool> taken(n, false);
  for (int i = 0; i < n; ++i) {
    int free = node(i);
    while (taken[free]) free = (free + 1) % n;
    taken[free] = true;
    place[i] = free;
  }
  Vector v(n);
  Vector s(n);
  const auto F = [&](const Vector& u, Vector& r) {
    for (int i = 0; i < n; ++i) v[place[i]] = u[i];
    bratu(v, s);
    for (int i = 0; i < n; ++i) r[i] = s[place[i]];
  };
  const Report plain = solve_from(F, Vector::Zero(n), without_learning());
  const Report report = solve_from(F, Vector::Zero(n), Options{});
  EXPECT_TRUE(report.converged()) << report.reason;
  // A point off the base and at most six columns.
  EXPECT_LE(report.counts.learning, 7);
  EXPECT_EQ(report.counts.total(), plain.counts.total() + report.counts.learning);
}

TEST(Learning, SeesWhatVanishesAtTheStart) {
  // At u = 0 no component depends on its neighbours but through the first one's load.
  const int n = 200;
  const auto F = [&](const Vector& u, Vector& r) {
    for (int i = 0; i < n; ++i) {
      const double left = i > 0 ? u[i - 1] : 1.0;
      const double right = i + 1 < n ? u[i + 1] : 1.0;
      r[i] = u[i] * (1.0 + left * left + right * right) + 0.5 * left * right - 1.0;
    }
  };
  Options options;
  options.learning.after = 1;
  options.learning.worth = 0.0;
  const Report report = solve_from(F, Vector::Zero(n), options);
  EXPECT_TRUE(report.converged()) << report.reason;
  // Off the base 1, columns 3, groups 3, test 1: nothing was missed at first and found later.
  EXPECT_GE(report.counts.learning, 8);
  EXPECT_EQ(report.counts.learning % 3, 8 % 3);  // and renewed three products at a time
}

TEST(Learning, FindsTheRowsWhoseEntriesLieElsewhere) {
  // Ends of a line that are joined: two rows have an entry on a diagonal of their own.
  const int n = 300;
  const auto F = [&](const Vector& u, Vector& r) {
    for (int i = 0; i < n; ++i) {
      const double left = u[(i + n - 1) % n];
      const double right = u[(i + 1) % n];
      r[i] = 2.001 * u[i] - left - right + 0.1 * std::exp(u[i]) - 0.2 * std::sin(0.1 * i);
    }
  };
  const Report report = solve_from(F, Vector::Zero(n), Options{});
  const Report plain = solve_from(F, Vector::Zero(n), without_learning());
  EXPECT_TRUE(report.converged()) << report.reason;
  EXPECT_GT(report.counts.learning, 0);
  EXPECT_LT(report.counts.total(), plain.counts.total());
}

/// Bratu's equation on the nodes of a lattice that `inside` says yes to; the others are no
/// unknowns.
template <class Inside>
class PartOfLattice {
 public:
  PartOfLattice(int m, double lambda, const Inside& inside)
      : bratu_(m, lambda), whole_(m * m), images_(m * m) {
    for (int k = 0; k < m * m; ++k) {
      if (inside(k % m, k / m)) nodes_.push_back(k);
    }
  }
  [[nodiscard]] int size() const { return static_cast<int>(nodes_.size()); }
  void operator()(const Vector& u, Vector& r) {
    whole_.setZero();
    whole_(nodes_) = u;
    bratu_(whole_, images_);
    r = images_(nodes_);
  }

 private:
  Bratu bratu_;
  std::vector<int> nodes_;
  Vector whole_;
  Vector images_;
};

TEST(Learning, SeesWhereEliminatedUnknownsShiftDiagonals) {
  // Every row of nodes across the hole is of another length.
  const int m = 40;
  PartOfLattice F(m, 6.0, [](int i, int j) { return std::hypot(i - 19.5, j - 19.5) > 8.0; });
  const Report plain = solve_from(F, Vector::Zero(F.size()), without_learning());
  const Report report = solve_from(F, Vector::Zero(F.size()), Options{});
  ASSERT_TRUE(report.converged()) << report.reason;
  EXPECT_GT(report.counts.learning, 0);
  EXPECT_LT(report.counts.total(), plain.counts.total());
}

TEST(Learning, IsTriedAgainWhereItHasComeToPay) {
  // Factors are dear here, and few evaluations seem to be left at first; then secants fail.
  const Bratu bratu(32, 6.0);
  const Vector start = Vector::Zero(32 * 32);
  Options options;
  options.tolerances.relative = 1e-10;
  options.multisecant.patience = 4;
  options.learning.operations = 2.0;
  jfnk::Solver solver(options);
  std::vector<int> learnt;
  jfnk::Snapshot between;
  for (bool more = solver.start(bratu, start); more; more = solver.step(bratu)) {
    const int count = solver.report().counts.learning;
    if (learnt.empty() || learnt.back() != count) learnt.push_back(count);
    if (learnt.size() == 2) between = solver.save();
  }
  ASSERT_TRUE(solver.report().converged()) << solver.report().reason;
  // A point off the base and three columns; then, by the diagonals of before, products alone: five
  // entries of a row want five groups at least, and one product tests them.
  ASSERT_GE(learnt.size(), 3U);
  EXPECT_EQ(learnt[1], 4);
  EXPECT_GE(learnt[2] - learnt[1], 6);
  EXPECT_LE(learnt[2] - learnt[1], 10);
  options.learning.enabled = false;
  const Report plain = solve_from(bratu, start, options);
  EXPECT_LT(2 * solver.report().counts.total(), plain.counts.total());
  // What is known between the tries goes through a snapshot.
  options.learning.enabled = true;
  jfnk::Solver other(options);
  other.load(between);
  while (other.step(bratu)) {
  }
  EXPECT_EQ(other.report().counts.total(), solver.report().counts.total());
  EXPECT_TRUE((other.solution().array() == solver.solution().array()).all());
}

TEST(Learning, TakesFactorsThatExplainMostOfTheJacobian) {
  // The last of the rows is held here and there, so that its unknowns are out of step: the few
  // rows that see them are wrong, which is no reason to pay for all diagonals.
  const int m = 20;
  PartOfLattice F(m, 6.0, [](int i, int j) { return j + 1 < m || i % 3 == 0; });
  const Report report = solve_from(F, Vector::Zero(F.size()), Options{});
  ASSERT_TRUE(report.converged()) << report.reason;
  // As for the whole lattice, twice.
  EXPECT_GT(report.counts.learning, 0);
  EXPECT_LE(report.counts.learning, 2 * 15);
  EXPECT_LE(report.counts.total(), 2 * 35);
}

TEST(Learning, ItsSecantsAreInTheNormOfPF) {
  // Whether or not that is asked for, bit for bit.
  const Bratu bratu(24, 6.5);
  Vector u[2];
  for (const bool asked : {false, true}) {
    Options options;
    options.multisecant.preconditioned_norm = asked;
    u[asked] = Vector::Zero(24 * 24);
    const Report report = jfnk::solve(bratu, u[asked], options);
    EXPECT_TRUE(report.converged()) << report.reason;
    EXPECT_GT(report.counts.learning, 0);
  }
  EXPECT_TRUE((u[0].array() == u[1].array()).all());
}

}  // namespace
