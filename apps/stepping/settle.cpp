#include "stepping/settle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "model/build.hpp"
#include "model/initial_equilibrium.hpp"
#include "model/initial_stress.hpp"
#include "scene/derived.hpp"
#include "scene/driven_side.hpp"
#include "scene/drives.hpp"
#include "scene/grading.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"
#include "stepping/stepper.hpp"

namespace stepping {
namespace {

bool is_held_across(const scene::Scene& scene, scene::Side side) {
  const auto across = static_cast<scene::Axis>(scene::axis_of(side));
  return std::ranges::any_of(scene.support, [&](const scene::Support& support) {
    return support.side == side && std::ranges::count(support.directions, across) > 0;
  });
}

// Whether a wall holds the ground that settles: it must go all along its side.
bool wall_holds(const scene::Scene& scene) {
  return scene::drives_wall(scene) && scene::drives_whole_side(scene) &&
         !is_held_across(scene, scene.drive.side);
}

void hold_wall(const scene::Scene& scene, scene::Scene& ground) {
  const scene::Drive& drive = scene.drive;
  scene::Support wall;
  wall.name = scene::name_of_drive(drive);
  wall.side = drive.side;
  wall.directions = {static_cast<scene::Axis>(scene::axis_of(drive.side))};
  ground.support.push_back(wall);
}

// That a plate did not hold the ground, if that may be why it does not stand.
std::string words_of_drive(const scene::Scene& scene) {
  const scene::Drive& drive = scene.drive;
  if (drive.kind != scene::DriveKind::displacement || drive.later || drive.level) return "";
  if (drive.side == scene::Side::top || wall_holds(scene) || is_held_across(scene, drive.side)) {
    return "";
  }
  return fmt::format(", while the plate of the drive does not hold its side, the {}",
                     scene::name_of(drive.side));
}

// The scene before its drive begins: weight, or else its dead loads, grow on the same particles.
scene::Scene settling(const scene::Scene& scene) {
  scene::Scene ground = scene;
  ground.initial_stress = {};
  ground.stage.clear();
  ground.course = {};
  ground.approximation.kinematics = scene::KinematicsKind::small_strain;
  // Where the drive's plate ends particles stay fine.
  for (const scene::FinePlace& place : scene::fine_places(scene)) {
    scene::Refine refine;
    refine.region_min = place.min;
    refine.region_max = place.max;
    refine.spacing = place.spacing;
    refine.radius = place.radius;
    ground.refine.push_back(refine);
  }
  ground.grading.length = scene::resolve_grading_length(scene);
  ground.grading.growth = scene::resolve_growth(scene);
  // What grows later is not there yet.
  const auto grows = [&](const std::string& name) {
    return scene::grows(scene, scene::LoadKind::traction, name);
  };
  for (scene::OutlineSide& side : ground.side) side.live_pressure = side.live_shear = 0.0;
  std::erase_if(ground.traction, [&](const auto& traction) { return grows(traction.name); });
  for (scene::Cutout& cutout : ground.cutout) {
    if (grows(cutout.name)) cutout.pressure = cutout.shear = 0.0;
  }
  if (wall_holds(scene)) hold_wall(scene, ground);
  ground.drive = {};
  ground.other_drives.clear();
  ground.drive.kind = scene::DriveKind::load;
  ground.drive.scales = {scene::LoadKind::gravity};
  if (!scene::has_gravity(scene)) {
    // Then it is the dead loads that grow.
    ground.drive.scales = {scene::LoadKind::traction};
    for (scene::OutlineSide& side : ground.side) {
      side.live_pressure = std::exchange(side.pressure, 0.0);
      side.live_shear = std::exchange(side.shear, 0.0);
    }
  }
  ground.programme = {};
  ground.programme.steps = 10;
  ground.re_search = {};
  return ground;
}

template <int Dim>
void take_stress(const model::Model<Dim>& ground, const model::State<Dim>& rest,
                 model::Model<Dim>& model) {
  model.initial_stress = rest.stress;
  model.initial_load = model::constant_loads(model);
  // The drive's plate bears nothing yet; all other faces are those of the ground, in its order.
  Eigen::Index point = 0;
  std::size_t k = 0;
  for (model::Interface<Dim>& interface : model.interfaces) {
    if (!interface.of_drive.empty()) continue;
    const Eigen::Index count = ground.interfaces.at(k++).faces.points.size();
    interface.initial_traction = rest.interface_traction.middleCols(point, count).transpose();
    point += count;
  }
}

template <int Dim>
void finish(LoadStepper<Dim>& stepper, const model::State<Dim>& state, const std::string& failure) {
  while (!stepper.finished()) {
    const StepResult result = stepper.advance();
    if (result.outcome == StepOutcome::converged) continue;
    throw DoesNotSettle(fmt::format("{} beyond {:.3g} of it ({})", failure,
                                    state.programme.progress, result.reason));
  }
}

// The ground at rest with K0 times its vertical stress across, as far as it can be: what that
// leaves unbalanced, where the surface or a joint is not level, fades while all yield.
template <int Dim>
model::State<Dim> with_lateral_stress(const scene::Scene& scene, model::Model<Dim>& ground,
                                      const model::State<Dim>& rest) {
  constexpr int up = 1;
  take_stress(ground, rest, ground);
  for (Eigen::Index a = 0; a < ground.size(); ++a) {
    auto stress = ground.initial_stress.col(a);
    const auto& initial = scene.initial_stress;
    if (initial.K0) stress[0] = *initial.K0 * stress[up];
    const auto along_z = initial.K0_z ? initial.K0_z : initial.K0;
    stress[2] = *along_z * stress[up];
  }
  ground.layout.staged = true;
  model::State<Dim> state = model::initial_state(ground);
  state.programme.balanced = 0;
  scene::Scene fading = settling(scene);
  fading.course.load_begin = fading.course.load_end;
  LoadStepper<Dim> stepper(fading, ground, state);
  if (!stepper.begin_stage()) {
    throw DoesNotSettle("initial_stress.K0: the stress that it asks for cannot be evaluated");
  }
  finish(stepper, state,
         "initial_stress.K0: what it leaves unbalanced where the surface or a joint is not level "
         "cannot be taken away: no equilibrium");
  return state;
}

}  // namespace

template <int Dim>
model::Model<Dim> model_at_rest(const scene::Scene& scene) {
  model::Model<Dim> model = model::build_model<Dim>(scene);
  model::check_stress_at_rest(scene, model);
  if (scene.initial_stress.kind != scene::InitialStressKind::gravity) return model;
  const scene::Scene ground_scene = settling(scene);
  model::Model<Dim> ground = model::build_model<Dim>(ground_scene);
  model::State<Dim> rest = model::initial_state(ground);
  LoadStepper<Dim> stepper(ground_scene, ground, rest);
  finish(stepper, rest,
         fmt::format("initial_stress.kind = \"gravity\": the ground does not stand under its "
                     "weight and dead loads{}: no equilibrium",
                     words_of_drive(scene)));
  if (scene.initial_stress.K0 || scene.initial_stress.K0_z)
    rest = with_lateral_stress(scene, ground, rest);
  take_stress(ground, rest, model);
  model.wall_bears = wall_holds(scene);
  model::take_wall_force(scene, model);
  return model;
}

template model::Model<2> model_at_rest<2>(const scene::Scene&);
template model::Model<3> model_at_rest<3>(const scene::Scene&);

}  // namespace stepping
