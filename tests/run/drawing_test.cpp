// The picture of a scene.
#include "run/drawing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/build.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace {

using ::testing::HasSubstr;

std::size_t count_of(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
    ++count;
  }
  return count;
}

std::string drawn(const std::string& file, std::size_t& particles) {
  const auto reading = scene::read_scene(std::string(FPM_SCENES) + "/" + file);
  const auto model = model::build_model<2>(*reading.scene);
  particles = static_cast<std::size_t>(model.size());
  return run::drawing_of(*reading.scene, model);
}

TEST(Drawing, ShowsParticlesSidesAndWhatMoves) {
  std::size_t particles = 0;
  const std::string picture = drawn("crest.toml", particles);
  EXPECT_EQ(count_of(picture, "<circle"), particles);
  for (const char* text : {"base: fixed", "left: roller", "footing: footing", "moved by 0.06 m",
                           "soft clay: mohr_coulomb", "stiff clay: mohr_coulomb", "0.0625 to "}) {
    EXPECT_THAT(picture, HasSubstr(text));
  }
  EXPECT_THAT(picture, ::testing::StartsWith("<svg "));
  EXPECT_THAT(picture, ::testing::EndsWith("</svg>\n"));
}

TEST(Drawing, ShowsBoxesAndCutouts) {
  std::size_t particles = 0;
  const std::string cylinder = drawn("cylinder.toml", particles);
  EXPECT_EQ(count_of(cylinder, "<circle"), particles);
  EXPECT_THAT(cylinder, HasSubstr(">symmetry<"));
  const std::string footing = drawn("footing.toml", particles);
  EXPECT_EQ(count_of(footing, "<circle"), particles);
  EXPECT_THAT(footing, HasSubstr("moved by "));
}

}  // namespace
