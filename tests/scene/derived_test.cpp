#include "scene/derived.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.hpp"

namespace scene {
namespace {

Scene scene_of(const char* model, int dimension = 2) {
  Scene scene;
  scene.geometry.dimension = dimension;
  scene.material.resize(1);
  scene.material[0].model = model;
  return scene;
}

TEST(HourglassControl, AutoFollowsMaterialAndDimension) {
  using C = HourglassControl;
  EXPECT_EQ(resolve_control(scene_of("elastic")), C::stiffness);
  EXPECT_EQ(resolve_control(scene_of("elastic", 3)), C::stiffness);
  EXPECT_EQ(resolve_control(scene_of("von_mises")), C::mixed);
  EXPECT_EQ(resolve_control(scene_of("drucker_prager")), C::mixed);
  EXPECT_EQ(resolve_control(scene_of("drucker_prager", 3)), C::incremental);
  EXPECT_EQ(resolve_control(scene_of("mohr_coulomb")), C::incremental);
  Scene without_tension = scene_of("drucker_prager");
  without_tension.material[0].tension_cutoff = 0.0;
  EXPECT_EQ(resolve_control(without_tension), C::incremental) << "sub-points have no cut-off";
  Scene softening = scene_of("drucker_prager");
  softening.material[0].residual_strain = 0.1;
  EXPECT_EQ(resolve_control(softening), C::incremental) << "nor a strength of their own";
  for (const char* model : {"modified_cam_clay", "hoek_brown", "power_law"}) {
    EXPECT_EQ(resolve_control(scene_of(model)), C::incremental) << model;
  }
}

TEST(CurvedEnvelope, IsAssociatedIfItsDilationRatioIsOne) {
  Scene scene = scene_of("hoek_brown");
  EXPECT_FALSE(is_associated(scene));
  scene.material[0].curve.dilation_ratio = 1.0;
  EXPECT_TRUE(is_associated(scene));
  scene.material[0].curve.dilation_ratio = 0.9;
  EXPECT_FALSE(is_associated(scene));
}

TEST(HourglassControl, AutoIsThatOfWhatYieldsWhateverElasticPartsThereAre) {
  for (const char* model : {"drucker_prager", "von_mises", "mohr_coulomb"}) {
    Scene scene = scene_of(model);
    const HourglassControl alone = resolve_control(scene);
    scene.material.emplace_back().model = "elastic";
    EXPECT_EQ(resolve_control(scene), alone) << model;
  }
}

TEST(HourglassControl, HasItsStiffnessRatioUnlessTheSceneSaysOtherwise) {
  Scene scene = scene_of("drucker_prager");
  EXPECT_EQ(resolve_stiffness_ratio(scene), 0.01);
  scene.hourglass.control = HourglassControl::incremental;
  EXPECT_EQ(resolve_stiffness_ratio(scene), 0.1);
  scene.hourglass.stiffness_ratio = 0.0;
  EXPECT_EQ(resolve_stiffness_ratio(scene), 0.0);
  scene.hourglass = {};
  scene.hourglass.control = HourglassControl::viscosity;
  EXPECT_EQ(resolve_stiffness_ratio(scene), 0.0);
}

// Whether ground still stands after a stage has tried it is a question of its collapse.
TEST(Stages, ThatTryTheGroundHaveControlAndToleranceOfACollapse) {
  const std::vector<std::pair<std::string, std::function<void(Stage&)>>> changes{
      {"digs", [](Stage& stage) { stage.remove = {"pit"}; }},
      {"fills", [](Stage& stage) { stage.place = {"lift"}; }},
      {"releases", [](Stage& stage) { stage.release = {"strut"}; }},
      {"floods",
       [](Stage& stage) {
         stage.water_table = {{0.0, 0.0}, {1.0, 0.0}};
       }},
      {"is told a pressure", [](Stage& stage) { stage.pore_pressure = 1e3; }},
      {"shakes", [](Stage& stage) { stage.kh = 0.1; }},
      {"lifts", [](Stage& stage) { stage.kv = 0.1; }},
      {"weakens", [](Stage& stage) { stage.materials = {"m"}; }},
      {"changes", [](Stage& stage) { stage.regions = {"ring"}; }}};
  for (const auto& [what, change] : changes) {
    for (const char* model : {"von_mises", "drucker_prager", "mohr_coulomb"}) {
      Scene scene = scene_of(model);
      scene.stage.resize(2);
      change(scene.stage[1]);
      EXPECT_EQ(resolve_control(scene), HourglassControl::incremental) << what;
      EXPECT_EQ(resolve_stiffness_ratio(scene), 0.01) << what;
      EXPECT_EQ(resolve_solver(scene).tolerance, 1e-4) << what;
      scene.drive.kind = DriveKind::load;
      EXPECT_EQ(resolve_stiffness_ratio(scene), 0.001) << "the load grows until it collapses";
    }
    Scene elastic = scene_of("elastic");
    elastic.stage.resize(1);
    change(elastic.stage[0]);
    EXPECT_EQ(resolve_solver(elastic).tolerance, 1e-3) << what;
    EXPECT_EQ(resolve_stiffness_ratio(elastic), 0.1) << what;
    elastic.support.emplace_back().method = SupportMethod::contact;
    EXPECT_EQ(resolve_solver(elastic).tolerance, 1e-4) << what << ", and it may slide";
  }
  Scene pushed = scene_of("von_mises");
  pushed.stage.resize(2);
  pushed.stage[0].to = 0.1;
  pushed.stage[1].hold = {"strut"};
  EXPECT_EQ(resolve_control(pushed), HourglassControl::mixed);
  EXPECT_EQ(resolve_solver(pushed).tolerance, 1e-3);
}

TEST(Solver, PresetFillsAbsentKeysOnly) {
  Scene scene;
  EXPECT_EQ(resolve_solver(scene).method, SolverMethod::hybrid);
  scene.solver.preset = SolverPreset::appendix_a;
  scene.solver.jacobian = JacobianKind::analytic;
  const SolverSettings paper = resolve_solver(scene);
  EXPECT_EQ(paper.method, SolverMethod::newton_krylov);
  EXPECT_EQ(paper.preconditioner, PreconditionerKind::none);
  EXPECT_EQ(paper.jacobian, JacobianKind::analytic);
}

TEST(Solver, IsTighterWhereWhatYieldsMayFail) {
  Scene scene = scene_of("mohr_coulomb");
  EXPECT_EQ(resolve_solver(scene).tolerance, 1e-3);
  for (const DriveKind kind : {DriveKind::load, DriveKind::strength}) {
    scene.drive.kind = kind;
    EXPECT_EQ(resolve_solver(scene).tolerance, 1e-4);
  }
  scene.solver.tolerance = 3e-3;
  EXPECT_EQ(resolve_solver(scene).tolerance, 3e-3);
  scene.solver = {};
  scene.solver.preset = SolverPreset::appendix_a;
  EXPECT_EQ(resolve_solver(scene).tolerance, 1e-3) << "the paper's";
  Scene elastic = scene_of("elastic");
  elastic.drive.kind = DriveKind::load;
  EXPECT_EQ(resolve_solver(elastic).tolerance, 1e-3);
}

TEST(Solver, TakesFactorsNextToIncompressibilityInThePlane) {
  Scene scene;
  scene.geometry.dimension = 2;
  scene.material.resize(2);
  const auto taken = [&] { return resolve_solver(scene).preconditioner; };
  scene.material[1].poissons_ratio = 0.45;
  EXPECT_EQ(taken(), PreconditionerKind::two_level);
  scene.material[1].poissons_ratio = 0.46;
  EXPECT_EQ(taken(), PreconditionerKind::factors);
  EXPECT_EQ(resolve_stiffness_ratio(scene), 0.1);
  scene.material[0].model = "von_mises";
  EXPECT_EQ(taken(), PreconditionerKind::two_level);
  scene.material[1].poissons_ratio = 0.4999;
  EXPECT_EQ(taken(), PreconditionerKind::factors);
  scene.material[0].model = "elastic";
  EXPECT_EQ(resolve_stiffness_ratio(scene), 0.03);
  scene.geometry.dimension = 3;
  EXPECT_EQ(taken(), PreconditionerKind::two_level);
  EXPECT_EQ(resolve_stiffness_ratio(scene), 0.1);
}

TEST(Solver, TakesFactorsOfSmallElasticBodiesThatAreHard) {
  Scene scene;
  scene.geometry = {.dimension = 2, .min = {0.0, 0.0}, .max = {2.0, 1.0}, .spacing = 0.02};
  scene.material.resize(1);
  const auto taken = [&] { return resolve_solver(scene).preconditioner; };
  EXPECT_EQ(taken(), PreconditionerKind::two_level);
  scene.region.resize(1);
  scene.region[0].outline = {{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {0.0, 1.0}};
  EXPECT_EQ(taken(), PreconditionerKind::two_level);
  // 5 000 cells, held aslant.
  scene.side.resize(1);
  scene.side[0].along = {{2.0, 0.0}, {2.0, 1.0}, {1.0, 0.5}};
  EXPECT_EQ(taken(), PreconditionerKind::two_level);
  scene.side[0].kind = OutlineKind::roller;
  EXPECT_EQ(taken(), PreconditionerKind::factors);
  scene.geometry.spacing = 0.0199;
  EXPECT_EQ(taken(), PreconditionerKind::two_level);
  // A corner of 27 degrees, 20 000 cells.
  scene.region[0].outline = {{0.0, 0.0}, {2.0, 0.0}, {0.0, 1.0}};
  scene.geometry.spacing = 0.01;
  EXPECT_EQ(taken(), PreconditionerKind::factors);
  scene.geometry.spacing = 0.0099;
  EXPECT_EQ(taken(), PreconditionerKind::two_level);
  scene.geometry.spacing = 0.1;
  scene.material[0].model = "von_mises";
  EXPECT_EQ(taken(), PreconditionerKind::two_level);
}

TEST(Springs, CountByTheStiffnessOfTheVolumeNextToIncompressibility) {
  Material material;
  material.poissons_ratio = 0.45;
  EXPECT_EQ(modulus_ratio_of_springs(material), 1.0);
  material.poissons_ratio = 0.4999;  // 0.5001 / (1.4999 * 0.0002)
  EXPECT_NEAR(modulus_ratio_of_springs(material), 1667.11, 0.01);
}

TEST(Lattice, CountsCellsOrVertices) {
  Geometry geometry{.min = {0.0, -0.66}, .max = {1.1, 0.0}, .spacing = 0.01};
  EXPECT_EQ(particle_count(geometry), 7260);
  geometry.layout = Layout::vertex;
  EXPECT_EQ(particle_count(geometry), 111 * 67);
  const Geometry block{.dimension = 3, .min = {0, 0, 0}, .max = {1, 2, 3}, .spacing = 0.5};
  EXPECT_EQ(particle_count(block), 2 * 4 * 6);
}

TEST(Programme, TakesStepsFromTheSpacingWhenNoneAreGiven) {
  Scene scene = scene_of("elastic");
  scene.geometry.spacing = 0.01;
  scene.drive.kind = DriveKind::displacement;
  scene.drive.target = 0.033;
  EXPECT_EQ(nominal_steps(scene), 165);
  scene.drive.target = 0.0331;
  EXPECT_EQ(nominal_steps(scene), 166);
  scene.programme.steps = 0;
  EXPECT_EQ(nominal_steps(scene), 166);
  scene.programme.steps = 40;
  EXPECT_EQ(nominal_steps(scene), 40);
  scene.drive.kind = DriveKind::none;
  scene.programme.steps.reset();
  EXPECT_EQ(nominal_steps(scene), 1);
}

TEST(Consistency, AutoIsOnForJitteredSetsAndSidesHeldByImages) {
  Scene scene;
  EXPECT_FALSE(resolve_consistency(scene));
  scene.geometry.jitter = 0.2;
  EXPECT_TRUE(resolve_consistency(scene));
  scene.approximation.consistency = Switch::off;
  EXPECT_FALSE(resolve_consistency(scene));
  Scene held;
  held.support.resize(1);
  held.support[0].method = SupportMethod::direct;
  EXPECT_FALSE(resolve_consistency(held));
  held.support[0].method = SupportMethod::ghosts;
  EXPECT_TRUE(resolve_consistency(held));
}

// A box whose base, far side and driven top images can hold.
Scene held_box() {
  Scene scene = scene_of("drucker_prager");
  scene.geometry.min = {0.0, -1.0};
  scene.geometry.max = {2.0, 0.0};
  scene.geometry.spacing = 0.1;
  scene.support.resize(2);
  scene.support[0].side = Side::bottom;
  scene.support[0].directions = {Axis::x, Axis::y};
  scene.support[1].side = Side::right;
  scene.support[1].directions = {Axis::x};
  scene.drive.kind = DriveKind::displacement;
  scene.drive.direction = {0.0, -1.0};
  return scene;
}

std::vector<SupportMethod> methods_of(const Scene& scene) {
  std::vector<SupportMethod> all;
  for (const Support& support : scene.support) all.push_back(resolve_method(scene, support));
  return all;
}

TEST(Methods, AutoIsGhostsWhereImagesCanHoldASide) {
  using S = SupportMethod;
  const Scene box = held_box();
  EXPECT_EQ(methods_of(box), (std::vector{S::ghosts, S::ghosts}));
  EXPECT_EQ(resolve_drive_method(box), DriveMethod::ghosts);
  EXPECT_TRUE(resolve_consistency(box));

  Scene named = box;
  named.support[0].method = S::penalty;
  named.drive.method = DriveMethod::direct;
  EXPECT_EQ(methods_of(named), (std::vector{S::penalty, S::ghosts}));
  EXPECT_EQ(resolve_drive_method(named), DriveMethod::direct);

  // A side may be held by several supports, one of them across it.
  Scene shared = box;
  shared.support[0].directions = {Axis::x};
  EXPECT_EQ(methods_of(shared), (std::vector{S::direct, S::ghosts}));
  shared.support.push_back(shared.support[0]);
  shared.support[2].directions = {Axis::y};
  EXPECT_EQ(methods_of(shared), (std::vector{S::ghosts, S::ghosts, S::ghosts}));
  shared.support[2].method = S::penalty;
  EXPECT_EQ(methods_of(shared), (std::vector{S::direct, S::ghosts, S::penalty}));
}

TEST(Methods, AutoIsDirectElsewhere) {
  using S = SupportMethod;
  const auto expect_direct = [](const Scene& scene) {
    EXPECT_EQ(methods_of(scene), (std::vector{S::direct, S::direct}));
    EXPECT_EQ(resolve_drive_method(scene), DriveMethod::direct);
    EXPECT_FALSE(resolve_consistency(scene));
  };
  Scene vertex = held_box();
  vertex.geometry.layout = Layout::vertex;
  expect_direct(vertex);
  Scene viscous = held_box();
  viscous.hourglass.control = HourglassControl::viscosity;
  expect_direct(viscous);

  Scene places = held_box();
  places.support[0].side.reset();
  places.support[0].at = {0.0, 0.0};
  places.symmetry = {{Axis::x, 2.0}};
  EXPECT_EQ(methods_of(places), (std::vector{S::direct, S::direct}));

  Scene lid = held_box();  // drawn along itself
  lid.drive.direction = {1.0, 0.0};
  EXPECT_EQ(resolve_drive_method(lid), DriveMethod::ghosts);
  lid.drive.lateral = Lateral::free;
  EXPECT_EQ(resolve_drive_method(lid), DriveMethod::direct);
  lid.drive.lateral = Lateral::fixed;
  lid.support[1].side = Side::top;
  lid.support[1].directions = {Axis::y};
  EXPECT_EQ(resolve_drive_method(lid), DriveMethod::direct);
  EXPECT_EQ(methods_of(lid), (std::vector{S::ghosts, S::direct}));
  Scene mirrored = held_box();
  mirrored.symmetry = {{Axis::y, 0.0}};
  EXPECT_EQ(resolve_drive_method(mirrored), DriveMethod::direct);
}

TEST(Interfaces, AreThoseOfTheirTableOrTheRest) {
  Scene scene;
  for (const char* name : {"clay", "sand", "rock"}) scene.material.emplace_back().name = name;
  scene.interface.resize(1);
  scene.interface[0].between = {"rock", "clay"};
  scene.interface[0].kind = InterfaceKind::contact;
  scene.interface[0].contact.friction_angle = 12.0;
  for (const auto& [one, other] : {std::pair{0U, 2U}, std::pair{2U, 0U}}) {
    EXPECT_EQ(interface_between(scene, one, other), scene.interface[0]);
  }
  EXPECT_EQ(interface_between(scene, 0, 1).kind, InterfaceKind::tied);
  scene.approximation.interfaces = InterfaceKind::through;
  EXPECT_EQ(interface_between(scene, 1, 2).kind, InterfaceKind::through);
  EXPECT_EQ(interface_between(scene, 0, 2).kind, InterfaceKind::contact);

  EXPECT_EQ(resolve_stiffness_factor({}, true), 10.0);
  EXPECT_EQ(resolve_stiffness_factor({}, false), 100.0);
  EXPECT_EQ(resolve_stiffness_factor({.stiffness_factor = 3.0}, true), 3.0);
}

TEST(Side, KnowsItsAxisAndEnd) {
  const Geometry geometry{.dimension = 3, .min = {1, 2, 3}, .max = {4, 5, 6}};
  EXPECT_EQ(side_position(geometry, Side::left), 1);
  EXPECT_EQ(side_position(geometry, Side::right), 4);
  EXPECT_EQ(side_position(geometry, Side::bottom), 2);
  EXPECT_EQ(side_position(geometry, Side::top), 5);
  EXPECT_EQ(side_position(geometry, Side::front), 3);
  EXPECT_EQ(side_position(geometry, Side::back), 6);
}

}  // namespace
}  // namespace scene
