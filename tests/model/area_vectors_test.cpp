// The boundary of a body as the consistency correction knows it: its free faces and those that its
// bodies share.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "model/build.hpp"
#include "model/loads.hpp"
#include "scene/derived.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

// A box 2 m wide and 1 m high under a plate 0.75 m wide; images hold its base and sides.
std::string box(const std::string& layout, const std::string& kind) {
  std::string text = fmt::format(
      "[geometry]\ndimension = 2\nmin = [0.0, 0.0]\nmax = [2.0, 1.0]\nspacing = 0.125\nlayout = "
      "\"{}\"\n[approximation]\nconsistency = \"on\"\ninterfaces = \"{}\"\n",
      layout, kind);
  for (const char* name : {"lower", "upper"}) {
    text += fmt::format(
        "[[material]]\nname = \"{}\"\nmodel = \"elastic\"\nyoungs_modulus = 1e6\npoissons_ratio = "
        "0.3\n",
        name);
  }
  text += "region_min = [0.0, 0.5]\nregion_max = [2.0, 1.0]\n";
  for (const char* side : {"left", "right", "bottom"}) {
    text += fmt::format(
        "[[support]]\nname = \"{0}\"\nside = \"{0}\"\ndirections = [\"x\", \"y\"]\nmethod = "
        "\"ghosts\"\n",
        side);
  }
  return text +
         "[drive]\nkind = \"displacement\"\nside = \"top\"\nrange_min = 0.5\nrange_max = 1.25\n"
         "direction = [0.0, -1.0]\ntarget = 0.1\nwidth = 0.75\nmethod = \"ghosts\"\n";
}

TEST(AreaVectors, AreThoseOfFreeAndSharedFaces) {
  constexpr double round_off = 1e-13;
  for (const char* layout : {"cell", "vertex"}) {
    for (const char* kind : {"through", "tied"}) {
      SCOPED_TRACE(testing::Message() << layout << ", " << kind);
      const auto reading = scene::parse_scene(box(layout, kind), "box");
      ASSERT_TRUE(reading.scene) << (reading.errors.empty() ? "" : reading.errors[0].text());
      const Model<2> model = build_model<2>(*reading.scene);
      const fpm::Field<2> area = boundary_area_vectors(*reading.scene, model);
      // Of the top what the plate leaves free.
      fpm::Vector<2> sum = area.colwise().sum().transpose();
      // A range holds what round-off has put next to its ends.
      const double slack = 2.0 * scene::same_place(reading.scene->geometry);
      EXPECT_LE((sum - fpm::Vector<2>(0.0, 1.25)).norm(), slack + round_off);
      ASSERT_EQ(model.particles.body.empty(), std::string("through") == kind);
      if (model.particles.body.empty()) continue;
      sum.setZero();
      for (Eigen::Index a = 0; a < model.size(); ++a) {
        if (model.particles.body[static_cast<std::size_t>(a)] == 0) sum += area.row(a).transpose();
      }
      EXPECT_LE((sum - fpm::Vector<2>(0.0, 2.0)).norm(), round_off);  // the lower one's upper face
    }
  }
}

}  // namespace
}  // namespace model
