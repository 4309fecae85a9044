// Plane strain compression between smooth platens (Chen, Huang & Lyamin 2020, Example 2).

#include <algorithm>
#include <numeric>

#include "measure.hpp"

namespace verification {
namespace {

constexpr double height = 0.2;  // [m]

/// Without the weak patch: its material is made the sample's.
const std::string no_patch = "material.1.cohesion=15e3";

struct Compression {
  double worst_error = 0.0;  // of the mean pressure against the homogeneous solution
  double peak = 0.0;         // [Pa]
  double localised = 0.0;    // share of the volume that holds half of the plastic strain
};

// Where half of the plastic strain is, in the smallest volume: 0.5 if it is homogeneous.
double volume_of_half_the_strain(const Run<2>& run) {
  const Eigen::VectorXd& strain = run.state.plastic_strain;
  const Eigen::VectorXd& volume = run.model.particles.volume;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(strain.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return strain[a] > strain[b]; });
  const double half = 0.5 * strain.dot(volume);
  double held = 0.0, taken = 0.0;
  for (const Eigen::Index a : order) {
    if (held >= half) break;
    held += strain[a] * volume[a];
    taken += volume[a];
  }
  return taken / volume.sum();
}

Compression compressed(double mean_strain, const Settings& settings) {
  static const auto reference = reference_table("compression_homogeneous_drucker_prager.csv");
  Run<2> run(shipped_scene("compression.toml", settings));
  Compression result;
  for (const auto& record : run.advance_to(mean_strain * height / target_of(run.scene))) {
    const double exact = 1e3 * interpolated(reference, record.settlement / height);
    result.worst_error = std::max(result.worst_error, std::abs(record.mean_pressure / exact - 1.0));
    result.peak = std::max(result.peak, record.mean_pressure);
  }
  result.localised = volume_of_half_the_strain(run);
  report("worst_error", result.worst_error);
  report("peak_kPa", 1e-3 * result.peak);
  report("share_of_volume_with_half_the_strain", result.localised);
  return result;
}

constexpr double homogeneous_until = 0.02;  // mean strain at which the problem becomes ill-posed
constexpr double sample_target = 0.01;      // the project's, for the sample while homogeneous

TEST(Compression, SampleFollowsTheHomogeneousPath) {
  const Compression sample = compressed(homogeneous_until, {no_patch});
  EXPECT_LT(sample.worst_error, sample_target);
}

// The consistency correction makes the sample exactly homogeneous, so that what is left is the
// stress update's error in steps of 0.002, of first order.
const Settings exact_sample = {no_patch, "approximation.consistency=on", "solver.tolerance=1e-6",
                               "solver.max_evaluations_per_step=4000"};

TEST(Compression, ConsistentSampleFollowsTheHomogeneousPathToTheErrorOfTheSteps) {
  constexpr double first_order = 0.6;  // of the error in steps twice as long, with slack for h^2
  Settings halved = exact_sample;
  halved.push_back("programme.increment_over_spacing=0.04");
  const double coarse = compressed(homogeneous_until, exact_sample).worst_error;
  const double fine = compressed(homogeneous_until, halved).worst_error;
  report("error_in_steps_of_0.002", coarse);
  report("error_in_steps_of_0.001", fine);
  EXPECT_LT(fine, first_order * coarse);
}

TEST(Compression, ConsistentSampleStaysHomogeneous) {
  constexpr double half = 0.5, slack = 0.005;  // one row of 41 more or less would be 0.024
  EXPECT_NEAR(compressed(homogeneous_until, exact_sample).localised, half, slack);
}

TEST(Compression, WithWeakPatchPeaksAndLocalises) {
  constexpr double lowest = 41e3, highest = 46e3;  // [Pa] the project's window
  // In two crossing bands of four spacings (twice the smoothing length's reach) half of the strain
  // would be in a tenth of the volume; in a homogeneous sample in half of it.
  constexpr double localised = 0.25;
  const Compression sample = compressed(0.15, {});
  EXPECT_GT(sample.peak, lowest);
  EXPECT_LT(sample.peak, highest);
  EXPECT_LT(sample.localised, localised);
}

}  // namespace
}  // namespace verification
