// Boundary area vectors of a scene's body against the divergence theorem.
#include <gtest/gtest.h>

#include "bodies.hpp"
#include "model/loads.hpp"
#include "run.hpp"

namespace verification {
namespace {

// Sums over some hundred boundary points, each interpolated to some tens of particles.
constexpr double round_off = 1e-12;

struct Planes {
  std::string text;       // of [[symmetry]]
  std::vector<int> axes;  // of the planes, at the lower faces
};

template <int Dim>
std::string body(const std::string& layout, double jitter, const Planes& planes) {
  BodyOptions options;
  options.dimension = Dim;
  options.layout = layout;
  options.jitter = jitter;
  options.control = "stiffness";
  options.model = "elastic";
  options.consistency = "on";
  options.extra = planes.text;
  return body_scene(options);
}

// The integral of the outward normal over the whole boundary vanishes, that of normal x position is
// the volume times the identity. A plane of symmetry is no boundary: its own area, with its normal
// and at its place, is what is missing.
template <int Dim>
void expect_divergence_theorem(const std::string& layout, double jitter, const Planes& planes) {
  SCOPED_TRACE(layout + " with " + std::to_string(planes.axes.size()) + " planes");
  const TestScene scene = scene_of(body<Dim>(layout, jitter, planes));
  const auto model = model::build_model<Dim>(scene);
  const fpm::Field<Dim> area = model::boundary_area_vectors(scene, model);
  ASSERT_EQ(area.rows(), model.size());
  const fpm::Vector<Dim> extent = model.box_max - model.box_min;
  const double volume = extent.prod();
  fpm::Vector<Dim> sum = fpm::Vector<Dim>::Zero();
  fpm::Tensor<Dim> moment = volume * fpm::Tensor<Dim>::Identity();
  for (const int axis : planes.axes) {
    const double face = volume / extent[axis];
    sum[axis] += face;  // minus the missing -face
    // Its normal is along the axis alone, its place box_min[axis] and the middle across.
    fpm::Vector<Dim> middle = 0.5 * (model.box_min + model.box_max);
    middle[axis] = model.box_min[axis];
    moment.row(axis) += face * middle.transpose();
  }
  const fpm::Vector<Dim> found = area.colwise().sum().transpose();
  const fpm::Tensor<Dim> found_moment = area.transpose() * model.particles.position;
  EXPECT_LT((found - sum).norm(), round_off * extent.norm());
  EXPECT_LT((found_moment - moment).norm(), round_off * volume);
}

TEST(BoundaryAreaVectors, ObeyTheDivergenceTheorem) {
  const Planes none{"", {}};
  const Planes left{"[[symmetry]]\naxis=\"x\"\nposition=0.0\n", {0}};
  expect_divergence_theorem<2>("vertex", 0.0, none);
  for (const Planes& planes : {none, left}) {
    expect_divergence_theorem<2>("cell", 0.0, planes);
    expect_divergence_theorem<3>("cell", 0.0, planes);
  }
  expect_divergence_theorem<3>("vertex", 0.0, none);
  expect_divergence_theorem<2>("cell", 0.2, none);
  expect_divergence_theorem<2>("vertex", 0.2, none);
}

// On a vertex lattice the particles lie on the faces: each has the face within half a spacing, and
// those inside none.
TEST(BoundaryAreaVectors, OfAVertexLatticeAreTheTributaryAreas) {
  const TestScene scene = scene_of(body<2>("vertex", 0.0, {}));
  const auto model = model::build_model<2>(scene);
  const fpm::Field<2> area = model::boundary_area_vectors(scene, model);
  const double slack = 1e-9 * model.spacing;
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    const Eigen::RowVector2d x = model.particles.position.row(a);
    for (int i = 0; i < 2; ++i) {
      const int across = 1 - i;
      const bool lower = x[i]<model.box_min[i] + slack, upper = x[i]> model.box_max[i] - slack;
      const bool end =
          x[across] < model.box_min[across] + slack || x[across] > model.box_max[across] - slack;
      const double length = model.spacing * (end ? 0.5 : 1.0);
      EXPECT_NEAR(area(a, i), lower ? -length : upper ? length : 0.0, slack) << x;
    }
  }
}

}  // namespace
}  // namespace verification
