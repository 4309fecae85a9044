#include "equilibrium/lanes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <limits>
#include <vector>

#include "constitutive/cone_update.hpp"
#include "constitutive/objective.hpp"
#include "libconstitutive/points.hpp"

// The updates are one text for double and for Lanes, so what is tested is that every lane gets what
// a point of its own gets, whatever its neighbours in the register do.
namespace {

using constitutive::PointState;
using constitutive::SpatialMatrix;
using constitutive::StressVector;
using equilibrium::LaneMask;

// The compiler may contract a * b + c in one of the two and not in the other: a few roundings.
constexpr double tolerance = 16 * points::eps;

/// Of either width; the wider is compiled for processors that have registers for it.
template <class Width>
class Lanes : public testing::Test {
 protected:
  void SetUp() override {
#ifdef EQUILIBRIUM_WIDE_LOOPS
    if (Width::value == 8 && !__builtin_cpu_supports("x86-64-v4")) GTEST_SKIP() << "no AVX-512";
#endif
  }
};
using Widths = testing::Types<std::integral_constant<int, 4>, std::integral_constant<int, 8>>;
TYPED_TEST_SUITE(Lanes, Widths);

template <int Width, class Function>
equilibrium::Lanes<Width> make_lanes(Function&& value) {
  std::array<double, Width> values;
  for (int lane = 0; lane < Width; ++lane) values[static_cast<std::size_t>(lane)] = value(lane);
  return equilibrium::load<equilibrium::Lanes<Width>>(values.data());
}

TYPED_TEST(Lanes, ComputeCompareAndSelectLaneByLane) {
  constexpr int lane_count = TypeParam::value;
  const double infinity = std::numeric_limits<double>::infinity();
  const std::array<double, 8> x{-2.0, 0.0, 9.0, infinity, 1.0, -infinity, 0.5, -7.0};
  const std::array<double, 8> y{3.0, -1.0, 9.0, 2.0, 1.5, 4.0, -0.5, -7.0};
  const auto a = equilibrium::load<equilibrium::Lanes<lane_count>>(x.data());
  const auto b = equilibrium::load<equilibrium::Lanes<lane_count>>(y.data());
  const LaneMask<lane_count> less = a < b;
  for (int lane = 0; lane < lane_count; ++lane) {
    const double p = x[static_cast<std::size_t>(lane)], q = y[static_cast<std::size_t>(lane)];
    EXPECT_EQ((a + b)[lane], p + q);
    EXPECT_EQ((a - b)[lane], p - q);
    EXPECT_EQ((a * b)[lane], p * q);
    EXPECT_EQ((a / b)[lane], p / q);
    EXPECT_EQ((-a)[lane], -p);
    EXPECT_EQ(less[lane], p < q);
    EXPECT_EQ((a <= b)[lane], p <= q);
    EXPECT_EQ((a > b)[lane], p > q);
    EXPECT_EQ((a >= b)[lane], p >= q);
    EXPECT_EQ((a == b)[lane], p == q);
    EXPECT_EQ((!less)[lane], !(p < q));
    EXPECT_EQ(select(less, a, b)[lane], p < q ? p : q);
    EXPECT_EQ(min(a, b)[lane], std::min(p, q));
    EXPECT_EQ(max(a, b)[lane], std::max(p, q));
    EXPECT_EQ(abs(a)[lane], std::abs(p));
    EXPECT_EQ(sqrt(abs(a))[lane], std::sqrt(std::abs(p)));
    EXPECT_EQ(is_finite(a)[lane], std::isfinite(p));
  }
  EXPECT_TRUE(any(less));
  EXPECT_FALSE(any(a < a));
  EXPECT_FALSE(any(is_finite(a * std::numeric_limits<double>::quiet_NaN())));
}

TYPED_TEST(Lanes, AreReadFromColumnsOfAnyHeightAndWrittenBack) {
  constexpr int lane_count = TypeParam::value;
  const auto check = [](auto height) {
    constexpr int count = height();
    std::vector<double> columns(static_cast<std::size_t>(count * lane_count));
    for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = static_cast<double>(i);
    std::array<equilibrium::Lanes<lane_count>, static_cast<std::size_t>(count)> rows;
    equilibrium::load_columns<count>(columns.data(), rows.data());
    for (int k = 0; k < count; ++k) {
      for (int lane = 0; lane < lane_count; ++lane) {
        EXPECT_EQ(rows[static_cast<std::size_t>(k)][lane], lane * count + k);
      }
    }
    // Any address will do: one double behind the alignment of a register.
    std::array<double, lane_count + 2> line{};
    equilibrium::store(line.data() + 1, rows[0]);
    EXPECT_EQ(line[0], 0.0);
    EXPECT_EQ(line[lane_count], (lane_count - 1) * count);
    EXPECT_EQ(line[lane_count + 1], 0.0);
  };
  check(std::integral_constant<int, 2>());
  check(std::integral_constant<int, 3>());
  check(std::integral_constant<int, 4>());
  check(std::integral_constant<int, 6>());
  check(std::integral_constant<int, 9>());
  check(std::integral_constant<int, 16>());
}

TYPED_TEST(Lanes, AreKeptInSinglePrecision) {
  constexpr int lane_count = TypeParam::value;
  std::array<float, lane_count + 1> line{};
  const auto thirds = make_lanes<lane_count>([](int lane) { return (lane + 1) / 3.0; });
  equilibrium::store(line.data() + 1, thirds);
  const auto again = equilibrium::load<equilibrium::Lanes<lane_count>>(line.data() + 1);
  for (int lane = 0; lane < lane_count; ++lane) {
    EXPECT_EQ(again[lane], static_cast<float>((lane + 1) / 3.0));
  }
  EXPECT_EQ(line[0], 0.0F);
}

template <int Dim, int lane_count, class Material>
void expect_lanes_update_like_points(const Material& material, double cohesion) {
  points::RandomStress<Dim> stress(cohesion);
  int elastic = 0, cone = 0, apex = 0, failed = 0;
  for (int sample = 0; sample < 500; ++sample) {
    std::array<StressVector<Dim>, lane_count> trial;
    std::array<PointState<Dim>, lane_count> s0;
    PointState<Dim, equilibrium::Lanes<lane_count>> wide0, wide1;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      trial[lane] = stress();
      if ((sample + static_cast<int>(lane)) % 7 == 0) {
        trial[lane] += constitutive::isotropic<Dim>(20 * cohesion);  // towards the apex
      }
      if (sample % 50 == 3 && lane == 2) trial[lane][1] = std::numeric_limits<double>::quiet_NaN();
      s0[lane].stress = stress();
      s0[lane].plastic_strain = 0.1 * static_cast<double>(lane);
      s0[lane].plastic_volume_strain = 0.02 * static_cast<double>(lane);  // cut-off at 0.05
    }
    const auto gather = [&](auto&& value) {
      return make_lanes<lane_count>(
          [&](int lane) { return value(static_cast<std::size_t>(lane)); });
    };
    StressVector<Dim, equilibrium::Lanes<lane_count>> wide_trial;
    for (int row = 0; row < constitutive::stress_size<Dim>; ++row) {
      wide_trial[row] = gather([&](std::size_t lane) { return trial[lane][row]; });
      wide0.stress[row] = gather([&](std::size_t lane) { return s0[lane].stress[row]; });
    }
    wide0.plastic_strain = gather([&](std::size_t lane) { return s0[lane].plastic_strain; });
    wide0.plastic_volume_strain =
        gather([&](std::size_t lane) { return s0[lane].plastic_volume_strain; });
    const auto wide = update(material, wide_trial, wide0, wide1);
    for (std::size_t k = 0; k < lane_count; ++k) {
      const int lane = static_cast<int>(k);
      PointState<Dim> s1;
      const auto outcome = update(material, trial[k], s0[k], s1);
      ASSERT_EQ(wide.failed[lane], outcome.failed) << sample;
      ASSERT_EQ(wide.apex[lane], outcome.apex) << sample;
      ASSERT_EQ(wide.plastic[lane], outcome.plastic) << sample;
      ++(outcome.failed ? failed : outcome.apex ? apex : outcome.plastic ? cone : elastic);
      const double scale = outcome.failed ? s0[k].stress.norm() : trial[k].norm() + cohesion;
      for (int row = 0; row < constitutive::stress_size<Dim>; ++row) {
        ASSERT_NEAR(wide1.stress[row][lane], s1.stress[row], tolerance * scale) << sample;
      }
      const double strain = scale / material.moduli.shear + s0[k].plastic_strain;
      ASSERT_NEAR(wide1.plastic_strain[lane], s1.plastic_strain, tolerance * strain);
      ASSERT_NEAR(wide1.plastic_volume_strain[lane], s1.plastic_volume_strain, tolerance * strain);
    }
  }
  EXPECT_GT(elastic, 100);
  EXPECT_GT(failed, 5);
  EXPECT_GT(cone, 100);
  EXPECT_GT(apex, 100);
}

TYPED_TEST(Lanes, UpdateStressesAsPointsOfTheirOwnDo) {
  auto soil = points::soil("drucker_prager", 30, 15);
  soil.dilation_cutoff = 0.05;
  const auto material = constitutive::make_material(soil);
  const auto& cone = std::get<constitutive::DruckerPrager>(material);
  expect_lanes_update_like_points<2, TypeParam::value>(cone, soil.cohesion);
  expect_lanes_update_like_points<3, TypeParam::value>(cone, soil.cohesion);
}

template <int Dim, int lane_count>
void expect_lanes_move_like_points() {
  std::srand(1);
  const auto near_identity = [] {
    return SpatialMatrix<Dim>(SpatialMatrix<Dim>::Identity() + 0.3 * SpatialMatrix<Dim>::Random());
  };
  for (int sample = 0; sample < 100; ++sample) {
    std::array<SpatialMatrix<Dim>, lane_count> change, direction;
    SpatialMatrix<Dim, equilibrium::Lanes<lane_count>> wide_change, wide_direction;
    for (std::size_t k = 0; k < lane_count; ++k) {
      change[k] = near_identity();
      if (sample % 10 == 0 && k == 1) change[k] = -change[k];  // an inverted neighbour
      direction[k] = SpatialMatrix<Dim>::Random();
    }
    for (int e = 0; e < Dim * Dim; ++e) {
      const auto entry = [&](const auto& of) {
        return make_lanes<lane_count>(
            [&](int lane) { return of[static_cast<std::size_t>(lane)].data()[e]; });
      };
      wide_change.data()[e] = entry(change);
      wide_direction.data()[e] = entry(direction);
    }
    const auto wide = constitutive::objective_increment(wide_change);
    const auto wide_derivative = constitutive::derivative(wide, wide_direction);
    for (std::size_t k = 0; k < lane_count; ++k) {
      const int lane = static_cast<int>(k);
      const auto one = constitutive::objective_increment(change[k]);
      ASSERT_EQ(wide.is_admissible()[lane], one.is_admissible());
      if (!one.is_admissible()) continue;
      const auto derivative = constitutive::derivative(one, direction[k]);
      // The size of the numbers on the way: cofactors over the determinant.
      const double scale = 10.0 * (1.0 + one.gradient.norm()) / one.midpoint_determinant;
      for (int e = 0; e < Dim * Dim; ++e) {
        ASSERT_NEAR(wide.strain.data()[e][lane], one.strain.data()[e], tolerance * scale);
        ASSERT_NEAR(wide.rotation.data()[e][lane], one.rotation.data()[e], tolerance * scale);
        ASSERT_NEAR(wide_derivative.rotation.data()[e][lane], derivative.rotation.data()[e],
                    tolerance * scale * scale);
      }
    }
  }
}

TYPED_TEST(Lanes, MoveAsPointsOfTheirOwnDo) {
  expect_lanes_move_like_points<2, TypeParam::value>();
  expect_lanes_move_like_points<3, TypeParam::value>();
}

}  // namespace
