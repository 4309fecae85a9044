// The compressed sample at three spacings: the peak does not depend on them, the branch after it
// may.

#include "measure.hpp"

namespace verification {
namespace {

TEST(CompressionPeak, IsInTheWindowAtEverySpacing) {
  constexpr double lowest = 41e3, highest = 46e3;  // [Pa]
  for (const std::string spacing : {"0.01", "0.005", "0.0025"}) {
    verification::Run<2> run(
        shipped_scene("compression.toml",
                      {"geometry.spacing=" + spacing, "drive.target=0.01", "programme.steps=25"}));
    double peak = 0.0;
    for (const auto& record : run.complete()) peak = std::max(peak, record.mean_pressure);
    report("peak_kPa_at_" + spacing, 1e-3 * peak);
    EXPECT_GT(peak, lowest);
    EXPECT_LT(peak, highest);
  }
}

}  // namespace
}  // namespace verification
