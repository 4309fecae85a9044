// The picture of a scene.
#include "run/drawing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

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

// [px2] Of all polygons of a picture.
double area_of_polygons(const std::string& text) {
  const std::string begin = "<polygon points=\"";
  double area = 0.0;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    const std::size_t from = at + begin.size();
    std::string numbers = text.substr(from, text.find('"', from) - from);
    std::ranges::replace(numbers, ',', ' ');
    std::istringstream in(numbers);
    std::vector<Eigen::Vector2d> corners;
    for (Eigen::Vector2d p; in >> p.x() >> p.y();) corners.push_back(p);
    double twice = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Eigen::Vector2d &a = corners[k], &b = corners[(k + 1) % corners.size()];
      twice += a.x() * b.y() - a.y() * b.x();
    }
    area += 0.5 * std::abs(twice);
  }
  return area;
}

// [px2] Of a box seen from both of its corners: each face once, foreshortened by its normal's part
// along (0.5, 0.55, 0.8).
double area_of_box(const Eigen::Vector3d& size) {
  const Eigen::Vector3d d = Eigen::Vector3d(0.5, 0.55, 0.8).normalized();
  const double level = std::hypot(d.x(), d.z());
  const double across = (d.z() * size.x() + d.x() * size.z()) / level;
  const double up = level * size.y() + d.y() * (d.x() * size.x() + d.z() * size.z()) / level;
  const double scale = std::min(460.0 / across, 520.0 / up);
  const double faces =
      d.x() * size.y() * size.z() + d.y() * size.x() * size.z() + d.z() * size.x() * size.y();
  return 2.0 * scale * scale * faces;
}

std::string drawn_in_space(const std::string& text) {
  const auto reading = scene::parse_scene(text, "prism.toml");
  if (!reading.scene) {
    ADD_FAILURE() << (reading.errors.empty() ? "" : reading.errors.front().text());
    return "";
  }
  return run::drawing_of(*reading.scene, model::build_model<3>(*reading.scene));
}

std::string drawn_solid(const std::string& file) {
  const auto reading = scene::read_scene(std::string(FPM_SCENES) + "/" + file);
  return run::drawing_of(*reading.scene, model::build_model<3>(*reading.scene));
}

// Corners are written to 0.1 px, a share of 2.5e-3 of a side of 20 px and less of the sum.
constexpr double rounding = 2e-3;

TEST(SolidDrawing, ShowsEachFaceOfABoxOnce) {
  const std::string picture = drawn_solid("square_footing.toml");
  EXPECT_EQ(count_of(picture, "<polygon"), 2U * (12 * 8 + 8 * 12 + 12 * 12));
  const double exact = area_of_box({3.0, 2.0, 3.0});
  EXPECT_NEAR(area_of_polygons(picture), exact, rounding * exact);
  for (const char* text : {">plate<", ">base<", "base: held in x y z", "front: symmetry",
                           "plate: moved by 0.1 m", "1152 particles", "3 x 2 x 3 m"}) {
    EXPECT_THAT(picture, HasSubstr(text));
  }
}

TEST(SolidDrawing, ShowsTheFacesOfElementsAsTheyAre) {
  const std::string picture = drawn_solid("circle.toml");
  const double exact = area_of_box({4.0, 3.0, 4.0});
  EXPECT_NEAR(area_of_polygons(picture), exact, rounding * exact);
  for (const char* text : {">footing<", ">cuts<", "far: fixed", "plate: moved by 0.08 m"}) {
    EXPECT_THAT(picture, HasSubstr(text));
  }
}

// The ends of a prism are its regions, not what cells make of them.
TEST(SolidDrawing, ShowsTheRegionsOfAPrismAtItsEnds) {
  for (const char* grading :
       {"", "[grading]\nenabled = true\n[[refine]]\nat = [0.5, 0.9, 0.2]\n"}) {
    const std::string picture = drawn_in_space(
        std::string(
            "[geometry]\ndimension = 3\ndepth = [0.0, 0.6]\nspacing = 0.1\n"
            "[[region]]\nmaterial = \"clay\"\noutline = [[0, 0], [2, 0], [2, 0.9], [0, 0.6]]\n"
            "holes = [[[0.6, 0.2], [1, 0.2], [1, 0.5], [0.6, 0.5]]]\n"
            "[[region]]\nmaterial = \"sand\"\noutline = [[0, 0.6], [2, 0.9], [0, 1.5]]\n"
            "[[side]]\nname = \"base\"\nkind = \"fixed\"\nalong = [[0, 0], [2, 0]]\n"
            "[[side]]\nname = \"slope\"\nkind = \"loaded\"\nlive_pressure = 1e3\n"
            "along = [[2, 0.9], [0, 1.5]]\n"
            "[[side]]\nname = \"left\"\nkind = \"free\"\nalong = [[0, 1.5], [0, 0]]\n"
            "[[side]]\nname = \"right\"\nkind = \"free\"\nalong = [[2, 0], [2, 0.9]]\n"
            "[[side]]\nname = \"bore\"\nkind = \"free\"\n"
            "along = [[0.6, 0.2], [1, 0.2], [1, 0.5], [0.6, 0.5], [0.6, 0.2]]\n"
            "[[support]]\nname = \"end\"\nside = \"front\"\ndirections = [\"z\"]\n"
            "[[material]]\nname = \"clay\"\nmodel = \"elastic\"\npoissons_ratio = "
            "0.3\nyoungs_modulus = 1e6\n"
            "[[material]]\nname = \"sand\"\nmodel = \"elastic\"\npoissons_ratio = "
            "0.3\nyoungs_modulus = 1e6\n"
            "[drive]\nkind = \"load\"\nscales = [\"traction\"]\n[programme]\nsteps = 1\n") +
        grading);
    EXPECT_EQ(count_of(picture, "<path"), 4U);  // two regions at each of two ends
    EXPECT_EQ(count_of(picture, "evenodd"), 4U);
    for (const char* text :
         {"base: fixed", "slope: loaded, up to 1000 Pa", "end: held in z", "2 x 1.5 x 0.6 m"}) {
      EXPECT_THAT(picture, HasSubstr(text));
    }
  }
}

}  // namespace
