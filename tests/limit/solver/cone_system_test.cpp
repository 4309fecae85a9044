// Newton systems of an interior-point method as they become near the end: some cones give way by
// many orders of magnitude more than others.
#include "limit/solver/cone_system.hpp"

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace limit;
using solver::second_order_cone::Scaling;

// Cones in a row, neighbours joined by three equations, as triangles are by their sides; the last
// equation says what the one before says, but for a factor, as equations of a lower bound do.
programme::ConeProgram chain(int cones) {
  programme::ConeProgram program;
  std::mt19937 random(7);
  const auto any = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
  std::vector<Eigen::Triplet<double>> entries;
  const int variables = 3 * cones + 1, joints = 2 * (cones - 1);
  for (int k = 0; k + 1 < cones; ++k) {
    for (int row = 2 * k; row < 2 * k + 2; ++row) {
      for (int j = 3 * k; j < 3 * k + 6; ++j) entries.emplace_back(row, j, any());
    }
  }
  std::vector<Eigen::Triplet<double>> last;
  for (const auto& entry : entries) {
    if (entry.row() == joints - 1) last.emplace_back(joints, entry.col(), -2.0 * entry.value());
  }
  entries.insert(entries.end(), last.begin(), last.end());
  entries.emplace_back(0, variables - 1, 1.0);
  program.equations.resize(joints + 1, variables);
  program.equations.setFromTriplets(entries.begin(), entries.end());
  program.right_side = Eigen::VectorXd::Zero(joints + 1);
  program.objective = Eigen::VectorXd::Unit(variables, variables - 1);
  program.start = Eigen::VectorXd::Zero(variables);
  for (int k = 0; k < cones; ++k) program.cones.push_back({1.0, k % 3 == 0 ? 0.0 : 0.9, 1.0});
  return program;
}

// By how many powers of ten cones are nearer to yield than others. Seven are too much for the
// condensed form, which leaves 3e-7.
class ConeSystems : public ::testing::TestWithParam<int> {};

TEST_P(ConeSystems, SatisfyTheEquationsHoweverUnequalTheCones) {
  const programme::ConeProgram program = chain(60);
  const solver::ScaledProgram scaled(program);
  solver::ConeSystem system(scaled);
  std::vector<Scaling> scalings;
  for (std::size_t k = 0; k < program.cones.size(); ++k) {
    const double near = std::pow(10.0, -GetParam() * static_cast<double>(k % 4) / 3.0);
    const double turn = static_cast<double>(k);
    const auto touching = [&](double size, double sign) {
      const double radius = sign * size * (1.0 - near);
      return Eigen::Vector3d(size, radius * std::cos(turn), radius * std::sin(turn));
    };
    scalings.emplace_back(touching(k % 2 == 0 ? 1.0 : near, 1.0),
                          touching(k % 2 == 0 ? near : 1.0, -1.0));
  }
  ASSERT_TRUE(system.factorise(scalings));
  // Equations that depend on each other ask for sides that do, too.
  Eigen::VectorXd wanted = scaled.equations * Eigen::VectorXd::Ones(scaled.equations.cols());
  const solver::NewtonSolution found =
      system.solve(Eigen::VectorXd::Zero(scaled.equations.cols()), wanted, true);
  const Eigen::VectorXd left = wanted - scaled.equations * found.x;
  EXPECT_LT(left.lpNorm<Eigen::Infinity>(), 1e-9) << "what an interior point may be off";
}

INSTANTIATE_TEST_SUITE_P(Ranges, ConeSystems, ::testing::Values(0, 3, 6, 7));

}  // namespace
