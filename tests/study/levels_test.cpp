// What a scene offers a ladder: spacings, steps, far sides, qualities, and the order to trust.
#include "study/levels.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include "program/command_line.hpp"
#include "scene/derived.hpp"
#include "scene/grading.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "scene/stages.hpp"
#include "study/accuracy.hpp"
#include "study/quality.hpp"

namespace study {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<double> offered(const std::string& name) {
  const auto file = std::filesystem::path(FPM_SHARE_DIR) / "scenes" / name;
  return spacings_on_offer(*scene::read_scene(file).scene);
}

scene::Scene shipped(const std::string& name, const std::vector<std::string>& settings = {}) {
  const auto file = std::filesystem::path(FPM_SHARE_DIR) / "scenes" / name;
  const auto reading = scene::read_scene(file, settings);
  EXPECT_TRUE(reading.scene) << reading.errors.front().text();
  return *reading.scene;
}

// A body of elements has the spacing of its mesh.
TEST(Spacings, OfElementsAreNotOnOffer) {
  EXPECT_THROW((void)offered("circle.toml"), program::UsageError);
}

// B/spacing = 16 of 64 x 32 cells: B keeps whole numbers of cells, from 6 on.
TEST(SpacingsOnOffer, KeepTheFootingAWholeNumberOfCells) {
  const auto all = offered("prandtl_phi0.toml");
  ASSERT_GE(all.size(), 5U);
  for (const double spacing : all) {
    EXPECT_THAT(1.0 / spacing, DoubleNear(std::round(1.0 / spacing), 1e-9));
  }
  EXPECT_DOUBLE_EQ(all[0], 1.0 / 6.0);
  EXPECT_DOUBLE_EQ(all[1], 1.0 / 9.0);
  EXPECT_DOUBLE_EQ(all[2], 1.0 / 14.0);
}

// Its radii are 1 and 2 m: the box is whole, the bore is resolved by six cells.
TEST(SpacingsOnOffer, ResolveACircleFromTheFirst) {
  EXPECT_DOUBLE_EQ(offered("cylinder.toml")[0], 1.0 / 6.0);
}

TEST(SpacingsOnOffer, MakeScenesThatAreAccepted) {
  for (const char* name : {"beam.toml", "block3d.toml", "compression.toml", "cylinder.toml",
                           "footing.toml", "prandtl_phi20.toml"}) {
    const auto file = std::filesystem::path(FPM_SHARE_DIR) / "scenes" / name;
    const auto all = offered(name);
    ASSERT_GE(all.size(), 3U) << name;
    for (const double spacing : {all[0], all[1], all[2]}) {
      std::ostringstream setting;
      setting.precision(17);
      setting << "geometry.spacing=" << spacing;
      const auto one = scene::read_scene(file, std::vector<std::string>{setting.str()});
      EXPECT_TRUE(one.errors.empty()) << name << ": " << one.errors.front().text();
    }
  }
}

// Six particles across a region, a hole, or what is pressed on: the footing of half width 1.
TEST(SpacingsOnOffer, ResolveWhatABodyOfRegionsIsMadeOf) {
  for (const char* name : {"crest.toml", "tunnel.toml", "strength_with_depth.toml"}) {
    EXPECT_LE(spacings_of_a_ladder(shipped(name), false)[0], 1.0 / 6.0) << name;
  }
}

TEST(SpacingsOnOffer, EndWithABudgetAndElseAtAnEighth) {
  const scene::Scene strip = shipped("prandtl_phi0.toml");
  const auto without = spacings_of_a_ladder(strip, false), with = spacings_of_a_ladder(strip, true);
  EXPECT_EQ(without, spacings_on_offer(strip));
  EXPECT_GE(without.back(), strip.geometry.spacing / 8.0);
  EXPECT_LT(with.back(), strip.geometry.spacing / 32.0);
}

// Where only the finest of graded particles became finer, what the others leave would stay unseen.
TEST(ASpacing, MakesAllGradedParticlesAsMuchFiner) {
  const scene::Scene crest = shipped("crest.toml");
  const double half = crest.geometry.spacing / 2.0;
  const scene::Scene fine = shipped("crest.toml", settings_of_spacing(crest, half));
  ASSERT_TRUE(fine.grading.enabled);
  EXPECT_DOUBLE_EQ(fine.geometry.spacing, half);
  EXPECT_DOUBLE_EQ(scene::resolve_growth(fine), scene::resolve_growth(crest) / 2.0);
  EXPECT_DOUBLE_EQ(scene::resolve_coarsest(fine), scene::resolve_coarsest(crest) / 2.0);
  const scene::Scene strip = shipped("prandtl_phi0.toml");
  EXPECT_THAT(settings_of_spacing(strip, 0.125), ElementsAre("geometry.spacing=0.125"));
}

// The number of a stage goes before that of the programme.
TEST(MoreSteps, AreTakenInEachStage) {
  for (const char* name : {"footing_cycle.toml", "footing_stages.toml", "excavation.toml",
                           "prandtl_phi0.toml", "footing.toml"}) {
    const scene::Scene scene = shipped(name);
    const scene::Scene more = shipped(name, settings_of_steps(scene, 2.0));
    EXPECT_EQ(scene::planned_steps(more), 2 * scene::planned_steps(scene)) << name;
  }
}

// The strip's box is 4 x 2 of its half width, which stays a whole number of cells.
TEST(FarSides, MoveAwayAndMaterialsWithThem) {
  const scene::Scene strip = shipped("prandtl_phi0.toml");
  const auto far = parse_far("right,bottom", strip);
  EXPECT_THAT(widened(strip, far, 1.0), IsEmpty());
  EXPECT_THAT(widened(strip, far, 1.5), ElementsAre("geometry.min=[0, -3]", "geometry.max=[6, 0]"));
  EXPECT_THAT(widened(strip, far, 1.1), ElementsAre("geometry.min=[0, -3]", "geometry.max=[5, 0]"))
      << "by whole cells of every spacing";
  const scene::Scene layered = shipped("layered_clay.toml");
  const auto settings = widened(layered, parse_far("right,bottom", layered), 1.5);
  const scene::Scene wide = shipped("layered_clay.toml", settings);
  for (std::size_t m = 1; m < layered.material.size(); ++m) {
    EXPECT_EQ(wide.material[m].region_max[0] >= wide.geometry.max[0],
              layered.material[m].region_max[0] >= layered.geometry.max[0]);
    EXPECT_EQ(wide.material[m].region_min[1] <= wide.geometry.min[1],
              layered.material[m].region_min[1] <= layered.geometry.min[1]);
  }
}

TEST(FarSides, AreRefusedWhereNoGroundLiesBeyond) {
  const scene::Scene strip = shipped("prandtl_phi0.toml");
  for (const char* text : {"left", "top", "back", "middle", "", "right,left"}) {
    EXPECT_THROW((void)parse_far(text, strip), program::UsageError) << text;
  }
}

TEST(AQuality, IsTwiceOrHalfTheSpacingAsNearlyAsWholeCellsAllow) {
  for (const char* name : {"prandtl_phi0.toml", "footing.toml", "cylinder.toml", "beam.toml"}) {
    const scene::Scene scene = shipped(name);
    EXPECT_THAT(settings_of(Quality::normal, scene), IsEmpty());
    const double own = scene.geometry.spacing;
    const double fine = shipped(name, settings_of(Quality::fine, scene)).geometry.spacing;
    // Spacings on offer are 1.5 apart.
    EXPECT_GE(own / fine, 2.0 / 1.5) << name;
    EXPECT_LE(own / fine, 2.0 * 1.5) << name;
    const double draft = shipped(name, settings_of(Quality::draft, scene)).geometry.spacing;
    EXPECT_GT(draft, own) << name;
    EXPECT_LE(draft, 2.0 * 1.5 * own) << name;
    const auto tolerance = [](const scene::Scene& of) {
      return scene::resolve_solver(of).tolerance;
    };
    EXPECT_DOUBLE_EQ(tolerance(shipped(name, settings_of(Quality::draft, scene))),
                     std::min(10.0 * tolerance(scene), 0.01))
        << name;
  }
  EXPECT_EQ(parse_quality("draft"), Quality::draft);
  EXPECT_THROW((void)parse_quality("good"), program::UsageError);
}

// Measured: a slope bears 11 % more of its weight with a tolerance of 0.01 than with 0.001.
TEST(AQuality, LoosensNoToleranceThatDecidesWhenARunFails) {
  for (const char* name :
       {"slope.toml", "slope_safety.toml", "excavation.toml", "embankment.toml"}) {
    const scene::Scene scene = shipped(name);
    const scene::Scene draft = shipped(name, settings_of(Quality::draft, scene));
    EXPECT_GT(draft.geometry.spacing, scene.geometry.spacing) << name;
    EXPECT_EQ(scene::resolve_solver(draft).tolerance, scene::resolve_solver(scene).tolerance)
        << name;
  }
}

TEST(TheFormalOrder, IsTheFirstWhereAPlaceIsKnownToHalfASpacing) {
  const Quantity moved = parse_quantity("displacement_x@1,0");
  EXPECT_EQ(formal_order(shipped("block3d.toml"), moved), 2.0);
  EXPECT_EQ(formal_order(shipped("prandtl_phi0.toml"), moved), 1.0) << "the edge of its plate";
  EXPECT_EQ(formal_order(shipped("strength_with_depth.toml"), moved), 1.0) << "of a side";
  EXPECT_EQ(formal_order(shipped("compression.toml"), moved), 1.5) << "a plate without an edge";
  EXPECT_EQ(formal_order(shipped("slope.toml"), moved), 1.5);
  scene::Scene held = shipped("cylinder.toml");
  EXPECT_EQ(formal_order(held, moved), 2.0);
  held.support.emplace_back().at = {1.5, 0.0};
  EXPECT_EQ(formal_order(held, moved), 1.0) << "a particle near by is held";
  held.geometry.layout = scene::Layout::vertex;
  EXPECT_EQ(formal_order(held, moved), 2.0) << "one is there";
  EXPECT_EQ(formal_order(held, parse_quantity("stress_xx@1,0")), 1.0) << "of a particle near by";
  held.measure.front().kind = scene::MeasureKind::stress;
  EXPECT_EQ(formal_order(held, parse_quantity("bore_sxx_Pa")), 1.0);
  held.measure.front().kind = scene::MeasureKind::particle_stress;
  EXPECT_EQ(formal_order(held, parse_quantity("bore_sxx_Pa")), 1.0);
}

TEST(AnAccuracy, IsAPartOrAPercentage) {
  EXPECT_DOUBLE_EQ(parse_accuracy("2%"), 0.02);
  EXPECT_DOUBLE_EQ(parse_accuracy("0.005"), 0.005);
  for (const char* text : {"", "0", "2", "-1%", "100%", "2 %", "x", "nan"}) {
    EXPECT_THROW((void)parse_accuracy(text), program::UsageError) << text;
  }
}

TEST(ABudget, IsATime) {
  EXPECT_DOUBLE_EQ(parse_budget("10min"), 600.0);
  EXPECT_DOUBLE_EQ(parse_budget("1h30m"), 5400.0);
  EXPECT_DOUBLE_EQ(parse_budget("2.5s"), 2.5);
  for (const char* text : {"", "10", "min", "30m1h", "0s", "-5s", "10 min", "infs"}) {
    EXPECT_THROW((void)parse_budget(text), program::UsageError) << text;
  }
}

TEST(TheQuantity, OfASceneIsWhatItIsRunFor) {
  const auto of = [](const char* name) {
    const auto file = std::filesystem::path(FPM_SHARE_DIR) / "scenes" / name;
    return quantity_of(*scene::read_scene(file).scene).column;
  };
  EXPECT_EQ(of("footing.toml"), "mean_pressure_Pa");
  EXPECT_EQ(of("beam.toml"), "body_max_displacement_m");
  EXPECT_EQ(of("slope_safety.toml"), "strength_reduction");
  try {
    (void)of("cylinder.toml");
    FAIL() << "it measures the bore";
  } catch (const program::UsageError& refusal) {
    EXPECT_THAT(refusal.what(), HasSubstr("displacement of its measure bore; load_parameter"));
  }
}

}  // namespace
}  // namespace study
