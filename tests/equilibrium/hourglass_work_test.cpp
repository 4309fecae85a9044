// The work of the pair control against the virtual work of its forces.
#include "equilibrium/hourglass_work.hpp"

#include <gtest/gtest.h>

#include "equilibrium/equilibrium.hpp"
#include "model/build.hpp"
#include "scene/reader.hpp"
#include "verification/bodies.hpp"

namespace {

using namespace verification;

// Relative to the sum of the magnitudes: a hundred terms a row, some hundred rows, each of a few
// roundings, which add up as a random walk or less.
constexpr double round_off = 1e-12;

struct Law {
  const char* control;
  const char* model;
  const char* kinematics;
};

template <int Dim>
struct Moved {
  explicit Moved(const BodyOptions& body)
      : scene(scene::parse_scene(body_scene(body), "body", {}).scene),
        model(model::build_model<Dim>(*scene)),
        state(model::initial_state(model)),
        equilibrium(model, state) {}

  // Three motions, so that pairs remember deformation and rows have yielded and turned.
  Eigen::VectorXd increment(int step) const {
    Noise noise(static_cast<std::uint64_t>(step));
    return increment_field(model, state,
                           [](const fpm::Vector<Dim>& x) { return bending<Dim>(x, 0.01); }) +
           noise.vector(model.unknowns(), 0.005 * model.spacing);
  }
  double commit(const Eigen::VectorXd& u) {
    equilibrium.begin_step(0.0);
    Eigen::VectorXd residual(u.size());
    if (equilibrium(u, residual) != jfnk::Evaluation::ok) throw std::runtime_error("not evaluated");
    force = equilibrium.unmasked_residual();
    return equilibrium.commit(u).hourglass_work;
  }

  std::shared_ptr<const scene::Scene> scene;
  model::Model<Dim> model;
  model::State<Dim> state;
  equilibrium::Equilibrium<Dim> equilibrium;
  Eigen::VectorXd force;
};

// Two bodies move alike, one without the control: what differs is the force of the control, and its
// work is that on the way of the step. It comes from the transposed operator, the sum over pairs
// from the forward one.
template <int Dim>
void expect_virtual_work(BodyOptions body) {
  body.jitter = 0.1;
  Moved<Dim> with(body);
  body.hourglass = "stiffness_ratio = 0.0\n";
  Moved<Dim> without(body);
  ASSERT_TRUE(with.model.channels.pair);
  ASSERT_FALSE(without.model.channels.pair);
  for (int step = 0; step < 3; ++step) {
    const Eigen::VectorXd u = with.increment(step);
    const double work = with.commit(u);
    EXPECT_EQ(without.commit(u), 0.0);
    ASSERT_EQ(with.state.stress, without.state.stress);
    const Eigen::VectorXd control = with.force - without.force;
    const double magnitude = (with.force.cwiseAbs() + without.force.cwiseAbs()).dot(u.cwiseAbs());
    EXPECT_GT(std::abs(work), 1e3 * round_off * magnitude) << "the control does next to nothing";
    EXPECT_NEAR(work, control.dot(u), round_off * magnitude) << "step " << step;
  }
  EXPECT_EQ(with.state.layout.incremental, with.state.released.sum() > 0.0);
}

TEST(HourglassWork, IsTheWorkOfTheControlsForcesOnTheWayOfTheStep) {
  for (const Law& b :
       {Law{"stiffness", "elastic", "finite_strain"}, Law{"stiffness", "elastic", "small_strain"},
        Law{"incremental", "drucker_prager", "finite_strain"},
        Law{"incremental", "von_mises", "small_strain"},
        Law{"mixed", "drucker_prager", "finite_strain"}}) {
    SCOPED_TRACE(std::string(b.control) + " " + b.kinematics);
    BodyOptions body;
    body.control = b.control;
    body.model = b.model;
    body.kinematics = b.kinematics;
    expect_virtual_work<2>(body);
    if (body.control == "mixed" || body.model == "von_mises") continue;
    body.dimension = 3;
    expect_virtual_work<3>(body);
  }
}

TEST(Commit, RefusesAnIncrementThatInvertsAParticle) {
  BodyOptions body;
  body.control = "incremental";
  Moved<2> moved(body);
  moved.equilibrium.begin_step(0.0);
  const Eigen::VectorXd inversion = increment_field(
      moved.model, moved.state, [](const fpm::Vector<2>& x) -> fpm::Vector<2> { return -2.0 * x; });
  Eigen::VectorXd mirrored = inversion;
  mirrored.tail(moved.model.size()).setZero();  // x -> -x alone: a determinant of -1
  EXPECT_THROW((void)moved.equilibrium.commit(mirrored), std::logic_error);
}

}  // namespace
