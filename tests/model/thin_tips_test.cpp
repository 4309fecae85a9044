// Which faces between materials are left where one of them runs out into a tip.
#include "model/thin_tips.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "model/build.hpp"
#include "model/surface.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "scene/stages.hpp"

namespace model {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using Pairs = std::set<MaterialPair>;

std::string materials(const std::vector<std::string>& names) {
  std::string text = "[approximation]\nkinematics = \"small_strain\"\n";
  for (const std::string& name : names) {
    text += fmt::format(
        "[[material]]\nname = \"{}\"\nmodel = \"elastic\"\nyoungs_modulus = 1e6\n"
        "poissons_ratio = 0.3\n",
        name);
  }
  return text;
}

std::string region(const std::string& material, const std::string& outline) {
  return fmt::format("[[region]]\nmaterial = \"{}\"\noutline = {}\n", material, outline);
}

std::string interface(const std::string& one, const std::string& other, const std::string& kind) {
  return fmt::format("[[interface]]\nbetween = [\"{}\", \"{}\"]\nkind = \"{}\"\n", one, other,
                     kind);
}

// Held at its bottom and pressed elsewhere, of a height.
std::string sides(double height, const std::string& top = "\"loaded\"\nlive_pressure = 1e3") {
  return fmt::format(R"([geometry]
spacing = 0.1
[[side]]
name = "bottom"
kind = "fixed"
along = [[0, 0], [3, 0]]
[[side]]
name = "right"
kind = "loaded"
live_pressure = 1e3
along = [[3, 0], [3, {0}]]
[[side]]
name = "top"
kind = {1}
along = [[3, {0}], [0, {0}]]
[[side]]
name = "left"
kind = "loaded"
live_pressure = 1e3
along = [[0, {0}], [0, 0]]
[drive]
kind = "load"
scales = ["traction"]
[programme]
steps = 1
)",
                     height, top);
}

Model<2> model_of(const std::string& text) {
  const scene::SceneReading reading = scene::parse_scene(text, "scene");
  for (const auto& complaint : reading.errors) ADD_FAILURE() << complaint.text();
  return build_model<2>(*reading.scene);
}

Pairs joined(const Model<2>& model) {
  Pairs pairs;
  for (const JoinedFace& face : model.joined_faces) pairs.insert({face.first, face.second});
  return pairs;
}

// Of materials between which faces are left.
Pairs faces_left(const Model<2>& model) {
  Pairs pairs;
  if (model.particles.body.empty()) return pairs;
  const auto faces = joint_faces(model);
  for (std::size_t c = 0; c < faces.first.size(); ++c) {
    const fpm::Index one = model.material[static_cast<std::size_t>(faces.first[c])];
    const fpm::Index other = model.material[static_cast<std::size_t>(faces.second[c])];
    pairs.insert({std::min(one, other), std::max(one, other)});
  }
  return pairs;
}

fpm::Index bodies(const Model<2>& model) {
  return model.particles.body.empty() ? 1 : std::ranges::max(model.particles.body) + 1;
}

// Falls [m] of the layer below, at 29 and 15 degrees; from 20 degrees on tips are seen.
constexpr double seen = 0.8, blind = 0.4;

// A layer on another one that ends at the surface, `fall` deep at the right side.
std::string layer(double fall) {
  return sides(1.0) + materials({"soft", "stiff"}) +
         region("soft", fmt::format("[[0, 0], [3, 0], [3, {}], [1.53, 1], [0, 1]]", 1.0 - fall)) +
         region("stiff", fmt::format("[[1.53, 1], [3, {}], [3, 1]]", 1.0 - fall));
}

TEST(ThinTips, ThatPointsSeeKeepTheirFace) {
  const Model<2> model = model_of(layer(seen));
  EXPECT_EQ(joined(model), Pairs{});
  EXPECT_EQ(faces_left(model), (Pairs{{0, 1}}));
  EXPECT_EQ(bodies(model), 2);
}

TEST(ThinTips, ThatNoPointSeesGoWithTheirNeighbour) {
  const Model<2> model = model_of(layer(blind));
  ASSERT_EQ(joined(model), (Pairs{{0, 1}}));
  EXPECT_LT((model.joined_faces[0].place - Eigen::Vector2d(1.53, 1.0)).norm(), 0.5);
  EXPECT_EQ(bodies(model), 1);
}

TEST(ThinTips, AreRefusedWhereTheSceneSaysThatTheyAreBodiesOfTheirOwn) {
  for (const std::string kind : {"tied", "contact"}) {
    try {
      static_cast<void>(model_of(layer(blind) + interface("stiff", "soft", kind)));
      ADD_FAILURE() << kind;
    } catch (const InterfaceRefused& refused) {
      EXPECT_EQ(refused.key, "interface.0.kind");
      EXPECT_THAT(refused.found,
                  AllOf(HasSubstr(kind), HasSubstr("\"soft\" and \"stiff\""),
                        HasSubstr("\"stiff\" runs out"), HasSubstr("(1.647, 0.9683) m")));
    }
  }
}

// The middle one of three layers ends at the surface, on the lowest one; where the uppermost one
// meets either there is no tip.
std::string three_layers() {
  return sides(2.0) + materials({"low", "mid", "top"}) +
         region("low", "[[0, 0], [3, 0], [3, 2], [2.5, 2], [0.6, 1.24], [0, 1]]") +
         region("mid", "[[0.6, 1.24], [2.5, 2], [0.6, 2]]") +
         region("top", "[[0, 1], [0.6, 1.24], [0.6, 2], [0, 2]]");
}

TEST(ThinTips, TakeNoFaceButTheNearestWithThem) {
  const Model<2> model = model_of(three_layers());
  EXPECT_EQ(joined(model), (Pairs{{0, 1}}));
  EXPECT_EQ(faces_left(model), (Pairs{{0, 2}, {1, 2}}));
  EXPECT_EQ(bodies(model), 2);
}

TEST(ThinTips, AreRefusedWhereAContactElsewhereWouldGoWithThem) {
  const std::string through = interface("mid", "top", "through");
  EXPECT_EQ(bodies(model_of(three_layers() + through)), 1);
  try {
    static_cast<void>(model_of(three_layers() + through + interface("low", "top", "contact")));
    ADD_FAILURE();
  } catch (const InterfaceRefused& refused) {
    EXPECT_EQ(refused.key, "interface.1.kind");
    EXPECT_THAT(refused.found, AllOf(HasSubstr("\"low\" and \"top\""), HasSubstr("\"mid\" runs")));
  }
}

// A wedge of gravel between clay and concrete, which meet beyond its tip.
std::string wedge() {
  return sides(2.0) + materials({"clay", "concrete", "gravel"}) +
         region("clay", "[[0, 0], [3, 0], [3, 1], [1.63, 1], [0, 1]]") +
         region("concrete", "[[1.63, 1], [3, 1], [3, 2], [0, 2], [0, 1.5]]") +
         region("gravel", "[[0, 1], [1.63, 1], [0, 1.5]]");
}

// Not seen at its contact with clay, the wedge goes with concrete, to which it is tied.
TEST(ThinTips, LeaveAContactOfTheirOwn) {
  const Model<2> model = model_of(wedge() + interface("gravel", "clay", "contact"));
  EXPECT_EQ(joined(model), (Pairs{{1, 2}}));
  EXPECT_EQ(faces_left(model), (Pairs{{0, 1}, {0, 2}}));
}

TEST(ThinTips, LeaveAContactBeyondThem) {
  const Model<2> model = model_of(wedge() + interface("clay", "concrete", "contact"));
  EXPECT_EQ(joined(model), (Pairs{{0, 2}}));
  EXPECT_EQ(faces_left(model), (Pairs{{0, 1}, {1, 2}}));
  EXPECT_EQ(bodies(model), 2);
}

// A cell's share of a wedge that clay's particle has and one that concrete's has meet within the
// wedge, but not once that is dug away: then clay and concrete meet beyond its tip only.
TEST(ThinTips, OfGroundThatIsNotThereHaveNoJoints) {
  for (const double up : {1.02, 1.05}) {
    const scene::SceneReading reading = scene::parse_scene(
        sides(2.0) + materials({"clay", "concrete", "gravel"}) +
            region("clay", fmt::format("[[0, 0], [3, 0], [3, 1], [1.63, {}], [0, 0.87]]", up)) +
            region("concrete", fmt::format("[[1.63, {}], [3, 1], [3, 2], [0, 2], [0, 0.93]]", up)) +
            region("gravel", fmt::format("[[0, 0.87], [1.63, {}], [0, 0.93]]", up)) +
            "name = \"gravel\"\n[[stage]]\nname = \"dig\"\nremove = [\"gravel\"]\nsteps = 1\n",
        "scene");
    for (const auto& complaint : reading.errors) ADD_FAILURE() << complaint.text();
    ASSERT_TRUE(reading.scene);
    const Model<2> model = build_model<2>(scene::scene_of_stage(*reading.scene, 0));
    EXPECT_FALSE(model.joints.empty());
    for (const JointPiece<2>& joint : model.joints) {
      EXPECT_GE(std::min(joint.from.x(), joint.to.x()), 1.63 - 1e-9) << up;
    }
  }
}

// Where the tip's surface is the only thing that is not seen, and nothing presses on it or bounds
// the ground there, as it goes on in images.
TEST(ThinTips, KeepTheirFaceWhereNothingAsksForTheirSurface) {
  const auto under = [](const std::string& top) {
    return model_of(sides(1.0, top) + materials({"soft", "stiff"}) +
                    region("soft", "[[0, 0], [3, 0], [3, 0.45], [1.5, 1], [0, 1]]") +
                    region("stiff", "[[1.5, 1], [3, 0.45], [3, 1]]"));
  };
  const Model<2> pressed = under("\"loaded\"\nlive_pressure = 1e3");
  ASSERT_EQ(joined(pressed), (Pairs{{0, 1}}));
  EXPECT_EQ(pressed.joined_faces[0].place.y(), 1.0);
  EXPECT_EQ(joined(under("\"roller\"")), Pairs{});
}

}  // namespace
}  // namespace model
