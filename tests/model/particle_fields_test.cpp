#include "model/particle_fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "model/build.hpp"
#include "model/measures.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

const std::string two_soils = R"(
[geometry]
dimension = 2
min = [0.0, 0.0]
max = [2.0, 1.0]
spacing = 0.1
[[material]]
name = "soil"
model = "elastic"
youngs_modulus = 1e6
poissons_ratio = 0.3
[[material]]
name = "rock"
model = "elastic"
youngs_modulus = 1e9
poissons_ratio = 0.3
region_min = [0.0, 0.0]
region_max = [2.0, 0.5]
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
[[traction]]
name = "load"
side = "top"
value = [0.0, -1000.0]
)";

struct Body {
  Model<2> model;
  State<2> state;

  Body() {
    model = build_model<2>(*scene::parse_scene(two_soils, "two soils").scene);
    state = initial_state(model);
  }
};

std::vector<std::string> names_in(const std::vector<files::PointField>& fields) {
  std::vector<std::string> names;
  for (const auto& field : fields) names.push_back(field.name);
  return names;
}

TEST(ParticleFields, AreThoseAskedForByName) {
  const Body body;
  const std::vector<std::string> wanted = {"recovered_mean_stress", "stress"};
  EXPECT_EQ(names_in(particle_fields<2>(body.model, body.state, wanted)),
            (std::vector<std::string>{"stress", "recovered_mean_stress"}));
  const auto all = names_in(particle_fields<2>(body.model, body.state, {}));
  for (const char* name : {"mean_stress", "recovered_mean_stress"}) {
    EXPECT_EQ(std::ranges::count(all, name), 1) << name;
  }
}

// A mean stress that is linear in where the particles lie now and jumps between the soils is its
// own smooth field.
TEST(ParticleFields, RecoveredMeanStressIsThatOfEachMaterialWhereItIsNow) {
  Body body;
  const auto& x = body.model.particles.position;
  body.state.displacement.col(0) = (3.0 * x.col(0).array()).sin() / 6.0 + x.col(1).array();
  Eigen::VectorXd expected(body.model.size());
  for (Eigen::Index a = 0; a < body.model.size(); ++a) {
    const auto now = x.row(a) + body.state.displacement.row(a);
    expected[a] =
        body.model.material[static_cast<std::size_t>(a)] == 0 ? 1e3 * now[0] : 5e3 - 2e3 * now[1];
    body.state.stress.col(a) << expected[a] + 4e3, expected[a] - 3e3, expected[a] - 1e3, 7e3;
  }
  const std::vector<std::string> wanted = {"recovered_mean_stress"};
  const auto fields = particle_fields<2>(body.model, body.state, wanted);
  ASSERT_EQ(fields.size(), 1U);
  EXPECT_EQ(fields[0].unit, "Pa");
  // Round-off of sums of some hundred products of up to 1e4 Pa.
  for (Eigen::Index a = 0; a < body.model.size(); ++a) {
    EXPECT_NEAR(fields[0].values[static_cast<std::size_t>(a)], expected[a], 1e-7);
  }
}

// Whatever holds a side, prescribed particles, springs or a contact: the forces on its particles
// sum up to the support's measured reaction.
TEST(ParticleFields, ReactionsAreThoseOfEverySupport) {
  const std::string measured = [] {
    std::string text;
    for (const std::string support : {"base", "wall", "springs"}) {
      text += "[[measure]]\nname = \"" + support + "\"\nkind = \"reaction\"\nsupport = \"" +
              support + "\"\n";
    }
    return text;
  }();
  const std::vector<std::string> by_particles = {"support.0.method=direct"};
  const auto scene = *scene::parse_scene(two_soils +
                                             "[[support]]\nname = \"wall\"\nside = \"left\"\n"
                                             "directions = [\"x\"]\nmethod = \"contact\"\n"
                                             "friction_angle = 20.0\n"
                                             "[[support]]\nname = \"springs\"\nside = \"right\"\n"
                                             "directions = [\"x\"]\nmethod = \"penalty\"\n" +
                                             measured,
                                         "held", by_particles)
                          .scene;
  const Model<2> model = build_model<2>(scene);
  State<2> state = initial_state(model);
  const auto& x = model.particles.position;
  state.displacement = 1e-3 * x;
  state.interface_traction.row(0).setConstant(3e3);
  state.interface_traction.row(1).setConstant(-500.0);
  for (Eigen::Index k = 0; k < model.unknowns(); ++k) {
    if (model.prescribed[static_cast<std::size_t>(k)] != 0) state.reaction.data()[k] = 7.0;
  }
  const auto measures = Measures<2>(scene, model).of(state);
  const std::vector<std::string> wanted = {"reaction"};
  const auto field = particle_fields<2>(model, state, wanted).front();
  const auto components = static_cast<std::size_t>(field.components);
  for (std::size_t i = 0; i < 2; ++i) {
    double sum = 0.0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(model.size()); ++a) {
      sum += field.values[components * a + i];
    }
    ASSERT_NE(measures[2 + i], 0.0);  // of the wall
    const double expected = measures[i] + measures[2 + i] + measures[4 + i];
    EXPECT_NEAR(sum, expected, 1e-12 * 1e7);  // sums of springs of 1e9 Pa moved by 1e-3 m
  }
}

}  // namespace
}  // namespace model
