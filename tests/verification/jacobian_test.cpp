// The analytic Jacobian action against central differences of the residual, for every control,
// kinematics and material, on a yielded and rotated body with history.

#include "bodies.hpp"
#include "run.hpp"

namespace verification {
namespace {

// A particle that passes between elasticity and yield within the step h of the difference shows as
// an error of order one, so h is small; then truncation, (h / dx)^2, is nothing and round-off,
// 1e-16 / (h / dx) = 1e-8 relative to stiffness times direction, times the hundred terms of a row,
// is what remains.
constexpr double step_over_spacing = 1e-8;
constexpr double relative_tolerance = 1e-6;

struct Case {
  BodyOptions body;
  std::string name;
};

template <int Dim>
double jacobian_error(const BodyOptions& body) {
  const TestScene scene = scene_of(body_scene(body));
  const auto model = model::build_model<Dim>(scene);
  auto state = model::initial_state(model);
  equilibrium::Equilibrium<Dim> equilibrium(model, state);
  Noise noise(7);
  move(equilibrium, increment_field(model, state, [](const fpm::Vector<Dim>& x) {
         return bending<Dim>(x, 0.01);
       }));
  const double dx = model.spacing;
  const Eigen::VectorXd u =
      increment_field(model, state,
                      [](const fpm::Vector<Dim>& x) { return bending<Dim>(x, 0.004); }) +
      noise.vector(model.unknowns(), 0.002 * dx);
  const Eigen::VectorXd v = noise.vector(model.unknowns(), 1.0);
  equilibrium.begin_step(1.0);
  Eigen::VectorXd forward(u.size()), backward(u.size()), action(u.size());
  if (!equilibrium.linearise(u)) throw std::runtime_error("cannot linearise");
  equilibrium.apply_jacobian(v, action);
  const double h = step_over_spacing * dx;
  equilibrium(u + h * v, forward);
  equilibrium(u - h * v, backward);
  const Eigen::VectorXd difference = (forward - backward) / (2.0 * h);
  return (action - difference).norm() / difference.norm();
}

class JacobianAction : public testing::TestWithParam<Case> {};

TEST_P(JacobianAction, EqualsCentralDifferences) {
  const BodyOptions& body = GetParam().body;
  const double error = body.dimension == 2 ? jacobian_error<2>(body) : jacobian_error<3>(body);
  EXPECT_LT(error, relative_tolerance);
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::string kinematics : {"finite_strain", "small_strain"}) {
    for (const std::string model : {"elastic", "von_mises", "drucker_prager", "mohr_coulomb"}) {
      for (const std::string control : {"none", "stiffness", "incremental", "mixed"}) {
        if (control == "mixed" && model == "elastic") continue;
        if (control == "stiffness" && model != "elastic") continue;
        BodyOptions body;
        body.kinematics = kinematics;
        body.model = model;
        body.control = control;
        body.jitter = 0.1;
        all.push_back({body, kinematics + "_" + model + "_" + control});
        if (control != "mixed" && model == "von_mises") continue;
        body.dimension = 3;
        all.push_back({body, "solid_" + all.back().name});
      }
    }
  }
  BodyOptions held;
  held.jitter = 0.1;
  held.control = "mixed";
  held.extra =
      "[[support]]\nname=\"base\"\nside=\"bottom\"\ndirections=[\"x\", \"y\"]\nmethod=\"ghosts\"\n";
  all.push_back({held, "held_by_ghosts"});
  const std::string upper =
      "[[material]]\nname=\"rock\"\nmodel=\"elastic\"\nyoungs_modulus=1e7\npoissons_ratio=0.2\n"
      "region_min=[-1.0, 0.5]\nregion_max=[2.0, 2.0]\n[[interface]]\nbetween=[\"soil\", "
      "\"rock\"]\n";
  BodyOptions parted;
  parted.jitter = 0.1;
  parted.control = "incremental";
  parted.extra = upper + "kind=\"tied\"\n";
  all.push_back({parted, "tied"});
  BodyOptions clay = parted;  // which slides at its cohesion
  clay.kinematics = "small_strain";
  clay.model = "von_mises";
  all.push_back({clay, "tied_and_sliding"});
  parted.extra = upper +
                 "kind=\"contact\"\nfriction_angle=20.0\nadhesion=1e3\n[[support]]\nname=\"base\"\n"
                 "side=\"bottom\"\ndirections=[\"y\"]\nmethod=\"contact\"\nfriction_angle=30.0\n";
  all.push_back({parted, "in_contact"});
  BodyOptions plate = parted;
  plate.extra =
      "[drive]\nkind=\"load\"\nscales=[\"plate\"]\nmethod=\"contact\"\nfriction_angle=30.0\n"
      "adhesion=1e3\nlateral=\"free\"\nside=\"top\"\nrange_min=0.2\nrange_max=0.9\nat=0.7\n"
      "force=[100.0, -2e3]\n[programme]\nsteps=1\n";
  all.push_back({plate, "below_a_plate"});
  plate.dimension = 3;
  plate.extra =
      "[drive]\nkind=\"load\"\nscales=[\"plate\"]\nmethod=\"contact\"\nfriction_angle=30.0\n"
      "lateral=\"free\"\nside=\"top\"\nrange_min=[0.1, 0.1]\nrange_max=[0.6, 0.4]\nat=[0.4, 0.3]\n"
      "force=[50.0, -500.0, 20.0]\n[programme]\nsteps=1\n";
  all.push_back({plate, "solid_below_a_plate"});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Laws, JacobianAction, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace verification
