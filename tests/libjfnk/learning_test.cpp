#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "jfnk/jfnk.hpp"
#include "learnt_jacobian.hpp"
#include "problems.hpp"

// The Jacobian learnt by looking: what it spares, and where it must not be tried or trusted.
namespace {

using jfnk::Evaluation;
using jfnk::Options;
using jfnk::Report;
using jfnk::Vector;
using jfnk::detail::LearntJacobian;
using jfnk_test::Bratu;
using jfnk_test::Sparse;

Options without_learning() {
  Options options;
  options.learning.enabled = false;
  return options;
}

template <class F, class P = jfnk::Identity>
Report solve_from(F&& residual, Vector u, const Options& options, P&& preconditioner = {}) {
  return jfnk::solve(residual, u, options, preconditioner);
}

/// Learns `matrix` from the given columns and by its groups.
void learn(LearntJacobian& learnt, const Sparse& matrix,
           std::initializer_list<Eigen::Index> columns) {
  learnt.reset(matrix.cols());
  jfnk::detail::LatticePattern& pattern = learnt.pattern();
  for (const Eigen::Index j : columns) pattern.learn(pattern.read(j, matrix.col(j), matrix.cols()));
  learnt.group_columns();
  Vector v(matrix.cols());
  for (int group = 0; group < learnt.groups(); ++group) {
    learnt.write_group(group, v);
    learnt.read_group(group, matrix * v);
  }
}

/// Two fields on a line of m nodes, coupled: u after v if `by_field`, else in turns.
Sparse two_fields(int m, bool by_field) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto at = [&](int field, int i) { return by_field ? field * m + i : 2 * i + field; };
  for (int i = 0; i < m; ++i) {
    for (int field = 0; field < 2; ++field) {
      entries.emplace_back(at(field, i), at(field, i), 4.0 + 0.1 * i);
      entries.emplace_back(at(field, i), at(1 - field, i), 1.0 + field);
      if (i > 0) entries.emplace_back(at(field, i), at(field, i - 1), -1.0 - field);
      if (i + 1 < m) entries.emplace_back(at(0, i), at(field, i + 1), 0.5 + field);
    }
  }
  Sparse matrix(2 * m, 2 * m);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEST(LearntJacobian, IsTheMatrixWhoseDiagonalsItHasSeen) {
  const Sparse lattice = jfnk_test::laplacian(9);
  const Vector x = Vector::LinSpaced(81, -1.0, 2.0);
  LearntJacobian learnt;
  learn(learnt, lattice, {40});
  EXPECT_LE(learnt.groups(), 9);  // five columns share a row; greedy colouring needs a few more
  EXPECT_LT((learnt.multiply(x) - lattice * x).norm(), 1e-14 * (lattice * x).norm());
  Vector z(81);
  ASSERT_TRUE(learnt.factorise(0.0));
  learnt.apply(lattice * x, z);
  EXPECT_LT((z - x).norm(), 1e-12 * x.norm());
  ASSERT_TRUE(learnt.factorise(2.5));
  learnt.apply(lattice * x + 2.5 * x, z);
  EXPECT_LT((z - x).norm(), 1e-12 * x.norm());
}

TEST(LearntJacobian, KnowsFieldsNumberedNodeByNodeOrOneAfterTheOther) {
  for (const bool by_field : {false, true}) {
    const Sparse matrix = two_fields(30, by_field);
    const Vector x = Vector::LinSpaced(60, 1.0, 3.0);
    LearntJacobian learnt;
    learn(learnt, matrix, {20, 41});
    EXPECT_LT((learnt.multiply(x) - matrix * x).norm(), 1e-13 * (matrix * x).norm());
  }
}

TEST(LearntJacobian, TellsColumnsOfOneProductApart) {
  // The first differences of a ring and of the line that it is cut into.
  const int n = 40;
  for (const bool ring : {true, false}) {
    Sparse matrix(n, n);
    for (int i = 0; i < n; ++i) {
      matrix.insert(i, i) = 3.0;
      if (ring || i > 0) matrix.insert(i, (i + n - 1) % n) = -1.0;
      if (ring || i + 1 < n) matrix.insert(i, (i + 1) % n) = -2.0;
    }
    Vector v = Vector::Zero(n);
    for (const int j : {0, 10, 20, 30}) v[j] = 1.0;
    const Vector product = matrix * v;
    jfnk::detail::LatticePattern pattern;
    pattern.reset(n);
    for (const int j : {0, 10, 20, 30}) {
      const auto column = pattern.read(j, product, 4);
      EXPECT_EQ(pattern.width(column), 1);
      EXPECT_EQ(column.offsets.size(), Vector(matrix.col(j)).cwiseAbs().count());
      pattern.learn(column);
    }
    EXPECT_EQ(pattern.matrix().nonZeros(), matrix.nonZeros());
  }
}

TEST(LearntJacobian, ForetellsItsFactors) {
  // A band of half width one: L has one entry under each pivot, whatever the ordering.
  const auto line = jfnk::banded_sparsity(100, 1, 1);
  const auto cost = jfnk::detail::factor_cost(line, 1e9);
  EXPECT_EQ(cost.entries, 2.0 * 99 + 100);
  EXPECT_EQ(cost.operations, 2.0 * 99);
  // A full matrix: n - 1 under the first pivot, n - 2 under the next, ...
  const auto full = jfnk::banded_sparsity(20, 19, 19);
  EXPECT_EQ(jfnk::detail::factor_cost(full, 1e9).entries, 400.0);
  // Counting ends soon after the limit.
  EXPECT_LT(jfnk::detail::factor_cost(full, 50.0).entries, 400.0);
  // Nested dissection of m x m nodes needs at least of the order of m^3 operations (George 1973).
  const auto lattice = jfnk::detail::factor_cost(jfnk_test::laplacian(40), 1e9);
  EXPECT_GT(lattice.operations, 40.0 * 40 * 40);
  EXPECT_LT(lattice.operations, 2.0 * 40 * 40 * 40 * 40);  // that of the band
}

TEST(LearntJacobian, FindsASingularMatrixUnusable) {
  Sparse matrix = jfnk_test::laplacian(6);
  for (Sparse::InnerIterator it(matrix, 7); it; ++it) it.valueRef() = 0.0;
  LearntJacobian learnt;
  learn(learnt, matrix, {14});
  EXPECT_FALSE(learnt.factorise(0.0));
}

TEST(LearntJacobian, FindsAnAllButEmptyMatrixUnusable) {
  Sparse matrix(100, 100);
  EXPECT_FALSE([&] {
    LearntJacobian learnt;
    learn(learnt, matrix, {50});
    return learnt.factorise(0.0);
  }());
  matrix.insert(3, 3) = 1.0;
  LearntJacobian learnt;
  learn(learnt, matrix, {3});
  EXPECT_FALSE(learnt.factorise(0.0));
  EXPECT_TRUE(learnt.factorise(1.0));
}

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

TEST(Learning, RespectsScalesAndBounds) {
  const int m = 20;
  const Bratu bratu(m, 6.0);
  Vector rows(m * m);
  Vector columns(m * m);
  for (int i = 0; i < m * m; ++i) {
    rows[i] = std::pow(10.0, i % 9 - 4);
    columns[i] = std::pow(10.0, i % 7 - 3);
  }
  Vector outermost = Vector::Zero(m * m);
  const auto F = [&](const Vector& u, Vector& r) {
    outermost = outermost.cwiseMax(u);
    bratu(u.cwiseQuotient(columns), r);
    r.array() *= rows.array();
  };
  Options options;
  options.u_scale = columns;
  options.f_scale = rows;
  options.upper = 2.0 * columns;
  const Report report = solve_from(F, Vector::Zero(m * m), options);
  const Report unscaled = solve_from(bratu, Vector::Zero(m * m), Options{});
  EXPECT_TRUE(report.converged()) << report.reason;
  EXPECT_GT(report.counts.learning, 0);
  EXPECT_LE(std::abs(report.counts.total() - unscaled.counts.total()), 3);
  EXPECT_TRUE((outermost.array() <= options.upper.array()).all());
}

TEST(Learning, IsNotTriedWhereItIsNotAskedFor) {
  const Bratu bratu(24, 6.0);
  const auto learning = [&](const Options& options) {
    return solve_from(bratu, Vector::Zero(24 * 24), options).counts.learning;
  };
  EXPECT_EQ(learning(without_learning()), 0);
  EXPECT_EQ(learning(jfnk::newton_krylov()), 0);
  EXPECT_EQ(learning(jfnk::plasticity()), 0);
  Options options;
  options.learning.least_unknowns = 24 * 24 + 1;
  EXPECT_EQ(learning(options), 0);
  options = {};
  options.learning.after = 10000;
  EXPECT_EQ(learning(options), 0);
  options = {};
  options.learning.most_entries = 1e3;  // known when the diagonals are
  EXPECT_EQ(learning(options), 4);
  options = {};
  options.learning.operations = 0.1;
  EXPECT_EQ(learning(options), 4);
  EXPECT_GT(learning(Options{}), 4);
}

TEST(Learning, LeavesANoisyResidualAlone) {
  const Bratu bratu(16, 6.0);
  const auto F = [&](const Vector& u, Vector& r) {
    bratu(u, r);
    // A difference of single columns drowns in the rounding of single precision.
    for (Eigen::Index i = 0; i < r.size(); ++i) r[i] = static_cast<float>(r[i] + 10.0) - 10.0;
  };
  Options options;
  options.tolerances.relative = 1e-3;
  const Report report = solve_from(F, Vector::Zero(256), options);
  const Report plain = solve_from(F, Vector::Zero(256), without_learning());
  EXPECT_TRUE(report.converged()) << report.reason;
  EXPECT_LE(report.counts.learning, 8);
  EXPECT_LE(report.counts.total(), plain.counts.total() + report.counts.learning);
}

/// Of steps so long that exp(u) overflows.
struct Misleading {
  void apply(const Vector& r, Vector& z) const { z = 1e6 * r; }
};

TEST(Learning, ReplacesAPreconditionerThatDoesNotHelp) {
  const Bratu bratu(24, 6.0);
  const Vector start = Vector::Zero(24 * 24);
  const Report kept = solve_from(bratu, start, without_learning(), Misleading{});
  const Report learnt = solve_from(bratu, start, Options{}, Misleading{});
  ASSERT_TRUE(kept.converged() && learnt.converged()) << learnt.reason;
  EXPECT_GT(learnt.counts.learning, 0);
  EXPECT_LT(learnt.counts.total(), kept.counts.total());
}

TEST(Learning, LeavesAPreconditionerThatHelpsAlone) {
  const Bratu bratu(24, 6.0);
  const jfnk_test::CholeskyPreconditioner P(jfnk_test::laplacian(24));
  const Report report = solve_from(bratu, Vector::Zero(24 * 24), Options{}, P);
  EXPECT_TRUE(report.converged());
  EXPECT_EQ(report.counts.learning, 0);
}

TEST(Learning, DoesNoHarmWhereTheJacobianIsSingular) {
  // Sums of neighbours only: no factors. Consistent, and solved without them.
  const int n = 64;
  const auto F = [&](const Vector& u, Vector& r) {
    for (int i = 0; i < n; ++i) {
      const double left = u[(i + n - 1) % n];
      const double right = u[(i + 1) % n];
      r[i] = 2.0 * u[i] - left - right - std::sin(6.0 * M_PI * (i + 0.5) / n);
    }
  };
  Options options;
  options.learning.after = 2;
  options.learning.worth = 0.0;
  const Report report = solve_from(F, Vector::Zero(n), options);
  EXPECT_TRUE(report.converged()) << report.reason;
}

TEST(Learning, StopsWhenAskedTo) {
  const Bratu bratu(24, 6.0);
  for (int at = 8; at < 16; ++at) {
    int calls = 0;
    const auto F = [&](const Vector& u, Vector& r) {
      if (++calls == at) return Evaluation::stop;
      bratu(u, r);
      return Evaluation::ok;
    };
    const Report report = solve_from(F, Vector::Zero(24 * 24), Options{});
    EXPECT_EQ(report.status, jfnk::Status::stopped);
    EXPECT_EQ(calls, at);
    Options few;
    few.max_evaluations = at;
    const Report limited = solve_from(bratu, Vector::Zero(24 * 24), few);
    EXPECT_EQ(limited.status, jfnk::Status::evaluation_limit);
    EXPECT_EQ(limited.counts.total(), at);
  }
}

TEST(Learning, SurvivesPlacesWhereFHasNoValue) {
  const Bratu bratu(24, 6.0);
  for (int hole = 8; hole < 20; ++hole) {
    int calls = 0;
    const auto F = [&](const Vector& u, Vector& r) {
      bratu(u, r);
      return ++calls < hole || calls > hole + 5;
    };
    const Report report = solve_from(F, Vector::Zero(24 * 24), Options{});
    EXPECT_TRUE(report.converged()) << hole << ": " << report.reason;
  }
}

}  // namespace
