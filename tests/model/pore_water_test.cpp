// What pore water adds to a model.
#include "model/pore_water.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/build.hpp"
#include "model/particle_fields.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

const std::string soil = R"([[material]]
name = "sand"
model = "elastic"
youngs_modulus = 1e7
poissons_ratio = 0.25
unit_weight = 17e3
saturated_unit_weight = 20e3
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
)";
const std::string box =
    "[geometry]\ndimension = 2\nmin = [0.0, 0.0]\nmax = [4.0, 2.0]\nspacing = 0.1\n";
const std::string slope =
    "[geometry]\nspacing = 0.13\n[[region]]\nmaterial = \"sand\"\n"
    "outline = [[0, 0], [4, 0], [4, 1], [2, 2], [0, 2]]\n[[side]]\nname = \"free\"\nkind = "
    "\"free\"\n"
    "along = [[0, 0], [0, 2], [2, 2], [4, 1], [4, 0], [0, 0]]\n";

std::string table(const std::string& points) {
  return "[water]\nunit_weight = 10e3\ntable = " + points + "\n";
}

Model<2> model_of(const std::string& text, const std::vector<std::string>& settings = {}) {
  const auto reading = scene::parse_scene(text, "scene", settings);
  if (!reading.scene) throw std::invalid_argument(reading.errors.front().text());
  return build_model<2>(*reading.scene);
}

Eigen::Vector2d sum_of(const Model<2>& model, const Eigen::VectorXd& load) {
  return {load.head(model.size()).sum(), load.tail(model.size()).sum()};
}

constexpr double rounding = 1e-9;

// Archimedes: whatever the cells, flooded ground weighs what it does less the water it displaces.
TEST(PoreWaterOfAModel, BearsTheWaterThatTheGroundDisplaces) {
  for (const std::string& body : {box, slope}) {
    const Model<2> model = model_of(body + soil + table("[[0, 3], [4, 3]]"));
    const double area = model.particles.volume.sum();
    EXPECT_NEAR(sum_of(model, model.water_load)[1], 10e3 * area, rounding * area * 1e4);
    EXPECT_NEAR(sum_of(model, model.water_load)[0], 0.0, rounding * area * 1e4);
    EXPECT_NEAR(sum_of(model, model.constant_load)[1], -10e3 * area, rounding * area * 1e4);
  }
}

// A table aslant through whole cells: the wet part is a trapezoid, to the last digit.
TEST(PoreWaterOfAModel, IsThatOfThePartBelowATableAslant) {
  const Model<2> model = model_of(box + soil + table("[[0, 1.5], [4, 0.3]]"));
  const double wet = 4.0 * 0.9, dry = 8.0 - wet;
  const Eigen::Vector2d water = sum_of(model, model.water_load);
  EXPECT_NEAR(water[0], 10e3 * wet * 0.3, rounding * 1e4) << "it seeps to the right";
  EXPECT_NEAR(water[1], 10e3 * wet, rounding * 1e4);
  EXPECT_NEAR(model.mass.sum() * 9.81, 17e3 * dry + 20e3 * wet, rounding * 1e5);
  // The table goes through this cell from its upper left corner to seven tenths of its right side.
  Eigen::Index cell = 0;
  (model.particles.position.rowwise() - Eigen::RowVector2d(1.05, 1.15))
      .rowwise()
      .squaredNorm()
      .minCoeff(&cell);
  EXPECT_NEAR(model.mass[cell] * 9.81, 0.01 * (17e3 * 0.15 + 20e3 * 0.85), rounding * 1e3);
  EXPECT_NEAR(model.water_load[model.size() + cell], 0.01 * 10e3 * 0.85, rounding * 1e3);
}

// Told by a number that changes, the same water is the same load, cell by cell.
TEST(PoreWaterOfAModel, IsWhatATableOrAShareOfTheOverburdenIsIfItIsToldSo) {
  const auto expect_same = [](const Model<2>& one, const Model<2>& other) {
    EXPECT_LT((one.pore_pressure - other.pore_pressure).cwiseAbs().maxCoeff(), rounding * 1e5);
    EXPECT_LT((one.water_load - other.water_load).cwiseAbs().maxCoeff(), rounding * 1e4);
    EXPECT_LT((one.mass - other.mass).cwiseAbs().maxCoeff(), rounding * 1e3);
  };
  const std::string told = "[water]\npore_pressure = ";
  expect_same(
      model_of(box + soil + told + "{ at = [0, 1.5], value = 0, gradient = [-3e3, -10e3] }\n"),
      model_of(box + soil + table("[[0, 1.5], [4, 0.3]]")));
  // Of 17 kN/m3 above; the upright through the crest is between cells.
  expect_same(model_of(slope + soil + told +
                           "{ points = [[0, 0, 8.5e3], [2, 0, 8.5e3], [4, 0, 4.25e3], [0, 2, 0], "
                           "[2, 2, 0], [4, 1, 0]] }\n",
                       {"geometry.spacing=0.125", "material.0.saturated_unit_weight=17e3"}),
              model_of(slope + soil, {"geometry.spacing=0.125", "water.r_u=0.25"}));
}

TEST(PoreWaterOfAModel, IsThatOfAShareOfTheOverburden) {
  const Model<2> model = model_of(slope + soil, {"water.r_u=0.25"});
  Eigen::Index a = 0;
  (model.particles.position.rowwise() - Eigen::RowVector2d(3.0, 0.5))
      .rowwise()
      .squaredNorm()
      .minCoeff(&a);
  const auto place = model.particles.position.row(a);
  const double above = 3.0 - 0.5 * place[0] - place[1];
  EXPECT_NEAR(model.pore_pressure[a], 0.25 * 17e3 * above, rounding * 1e4);
  const double volume = model.particles.volume[a];
  EXPECT_NEAR(model.water_load[a], 0.25 * 17e3 * 0.5 * volume, rounding * 1e4);
  EXPECT_NEAR(model.water_load[model.size() + a], 0.25 * 17e3 * volume, rounding * 1e4);
}

TEST(PoreWaterOfAModel, IsInTheFrames) {
  const Model<2> model = model_of(box + soil + table("[[0, 1], [4, 1]]"));
  State<2> state = initial_state(model);
  state.stress.setConstant(-3e3);
  const std::vector<std::string> wanted{"stress", "pore_pressure", "total_stress"};
  const auto fields = particle_fields<2>(model, state, wanted);
  ASSERT_EQ(fields.size(), 3U);
  const auto named = [&](const char* name) {
    return std::ranges::find(fields, name, &files::PointField::name)->values;
  };
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    const auto i = static_cast<std::size_t>(a);
    const double pressure = 10e3 * std::max(0.0, 1.0 - model.particles.position(a, 1));
    EXPECT_NEAR(named("pore_pressure")[i], pressure, rounding * 1e4);
    EXPECT_EQ(named("stress")[6 * i + 1], -3e3);
    EXPECT_NEAR(named("total_stress")[6 * i + 1], -3e3 - pressure, rounding * 1e4);
    EXPECT_EQ(named("total_stress")[6 * i + 3], -3e3) << "shear";
  }
  EXPECT_TRUE(particle_fields<2>(model_of(box + soil), initial_state(model_of(box + soil)),
                                 std::vector<std::string>{"pore_pressure", "total_stress"})
                  .empty());
}

}  // namespace
}  // namespace model
