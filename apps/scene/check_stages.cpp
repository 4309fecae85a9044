// Rules on stages: what they name, what they change, how far they go.
#include <fmt/format.h>

#include <algorithm>

#include "constitutive/parameters.hpp"
#include "scene/check.hpp"
#include "scene/contacts.hpp"
#include "scene/derived.hpp"
#include "scene/drives.hpp"
#include "scene/ground.hpp"
#include "scene/names.hpp"
#include "scene/outline_faces.hpp"
#include "scene/stages.hpp"
#include "tables/nearest_name.hpp"

namespace scene {
namespace {

// Whether it has a strength that a reduction divides.
bool may_be_weaker(const Material& material) {
  return yields(material) && !model_of(material).critical_state;
}

using Names = std::vector<std::string>;

// That a thing is there when it is taken away, and not when it is put down.
void check_order(const Scene& scene, const std::string& name, const char* taken, const char* put,
                 Names Stage::*take, Names Stage::*give, tables::Diagnosis& diagnosis) {
  std::optional<bool> there;
  for (std::size_t s = 0; s < scene.stage.size(); ++s) {
    const auto count = [&](const Names& list) { return std::ranges::count(list, name); };
    const auto takes = count(scene.stage[s].*take), gives = count(scene.stage[s].*give);
    if (takes + gives == 0) continue;
    const std::string key = key_of_stage(s, takes > 0 ? taken : put);
    if (!diagnosis.good({key})) return;
    if (takes + gives > 1) {
      diagnosis.error(key, fmt::format("found \"{}\" more than once in a stage", name),
                      fmt::format("it is either {} or {}, once", taken, put));
      return;
    }
    if (there == (gives > 0)) {
      diagnosis.error(key, fmt::format("found \"{}\" again", name),
                      gives > 0 ? "it is there already" : "it is no longer there");
      return;
    }
    there = gives > 0;
  }
}

void check_regions(const Scene& scene, tables::Diagnosis& diagnosis) {
  const auto known = names_of_all(scene.region);
  bool all = true;
  for (std::size_t s = 0; s < scene.stage.size(); ++s) {
    all =
        check_known(scene.stage[s].remove, known, key_of_stage(s, "remove"), "region", diagnosis) &&
        all;
    all = check_known(scene.stage[s].place, known, key_of_stage(s, "place"), "region", diagnosis) &&
          all;
  }
  if (!all) return;
  for (const std::string_view name : known) {
    check_order(scene, std::string(name), "remove", "place", &Stage::remove, &Stage::place,
                diagnosis);
  }
  for (std::size_t s = 0; s < scene.stage.size() && diagnosis.errors().empty(); ++s) {
    const Scene then = scene_of_stage(scene, s);
    const bool any =
        scene.region.empty() ||
        std::ranges::any_of(then.region, [](const Region& region) { return region.present; });
    if (any) continue;
    diagnosis.error(key_of_stage(s, "remove"), "found every region that is left",
                    "some ground must stay");
    return;
  }
}

void check_names_of_regions(const Scene& scene, tables::Diagnosis& diagnosis) {
  for (std::size_t s = 0; s < scene.stage.size(); ++s) {
    for (const std::string& name : scene.stage[s].remove) {
      if (std::ranges::count(scene.region, name, &Region::name) < 2) continue;
      diagnosis.warning(key_of_stage(s, "remove"),
                        fmt::format("\"{}\" is the name of several", name),
                        "all of them are taken away");
    }
  }
}

// Whether the drive of the footing acts in a stage.
bool footing_acts(const Scene& scene, const StageDrives& course) {
  const auto drives = drives_of(scene);
  for (std::size_t d = 0; d < drives.size(); ++d) {
    if (course.acts[d] && drives[d].drive->on_footing) return true;
  }
  return false;
}

// What carries the plate of a drive is there while it acts.
void check_plate_stays(const Scene& scene, tables::Diagnosis& diagnosis) {
  const auto footing = footing_of(scene);
  if (!footing || !diagnosis.errors().empty()) return;
  const auto courses = courses_of_drives(scene);
  for (const std::size_t region : regions_at(scene, *footing)) {
    const std::string& name = scene.region[region].name;
    for (std::size_t s = 0; s < scene.stage.size(); ++s) {
      if (!footing_acts(scene, courses[s]) || scene_of_stage(scene, s).region[region].present) {
        continue;
      }
      const auto takes = [&](std::size_t k) {
        return std::ranges::count(scene.stage[k].remove, name) > 0;
      };
      std::size_t taken = s;
      while (taken > 0 && !takes(taken)) --taken;
      const auto puts = [&](const Stage& stage) {
        return std::ranges::count(stage.place, name) > 0;
      };
      const auto put = std::ranges::find_if(scene.stage, puts) - scene.stage.begin();
      const std::string key = takes(taken) ? key_of_stage(taken, "remove")
                                           : key_of_stage(static_cast<std::size_t>(put), "place");
      diagnosis.error(key, fmt::format("found \"{}\"", name),
                      fmt::format("it carries the plate \"{}\" in {}: be it there as long as that "
                                  "is driven or held, which release ends",
                                  scene.side[*footing].name, stage_title(scene, s)));
      return;
    }
  }
}

// Images cannot come.
void check_method(const Scene& scene, const Support& support, tables::Diagnosis& diagnosis) {
  if (support.method != SupportMethod::ghosts) return;
  for (std::size_t s = 0; s < scene.stage.size(); ++s) {
    const std::string key = key_of_stage(s, "hold");
    if (std::ranges::count(scene.stage[s].hold, support.name) == 0 || !diagnosis.good({key})) {
      continue;
    }
    diagnosis.error(key, fmt::format("found \"{}\", by ghosts", support.name),
                    "images would be where they were before anything moved: auto, which then holds "
                    "particles where they are, direct, penalty or contact");
    return;
  }
}

// That a drive acts when it is released.
void check_released_drives(const Scene& scene, const std::vector<NamedDrive>& drives,
                           tables::Diagnosis& diagnosis) {
  const auto courses = courses_of_drives(scene);
  for (std::size_t s = 0; s < scene.stage.size(); ++s) {
    const std::string key = key_of_stage(s, "release");
    for (std::size_t d = 0; d < drives.size(); ++d) {
      if (std::ranges::count(scene.stage[s].release, drives[d].name) == 0) continue;
      if ((s > 0 && courses[s - 1].acts[d]) || !diagnosis.good({key})) continue;
      diagnosis.error(key, fmt::format("found \"{}\"", drives[d].name),
                      "that drive does not act when the stage begins");
      return;
    }
  }
}

void check_supports(const Scene& scene, tables::Diagnosis& diagnosis) {
  const auto known = names_of_all(scene.support);
  // Drives are released by their names as well.
  std::vector<std::string_view> released = known;
  const auto drives = drives_of(scene);
  for (const NamedDrive& drive : drives) {
    if (drive.drive->kind != DriveKind::none) released.push_back(drive.name);
  }
  bool all = true;
  for (std::size_t s = 0; s < scene.stage.size(); ++s) {
    const Stage& stage = scene.stage[s];
    const char* what = released.size() > known.size() ? "supports' and drives' name" : "support";
    all = check_known(stage.release, released, key_of_stage(s, "release"), what, diagnosis) && all;
    all = check_known(stage.hold, known, key_of_stage(s, "hold"), "support", diagnosis) && all;
  }
  if (!all) return;
  for (const Support& support : scene.support) {
    check_order(scene, support.name, "release", "hold", &Stage::release, &Stage::hold, diagnosis);
    check_method(scene, support, diagnosis);
  }
  check_released_drives(scene, drives, diagnosis);
}

// That values fit each other once they have changed.
void check_flow(const Scene& scene, std::size_t s, tables::Diagnosis& diagnosis) {
  if (scene.stage[s].materials.empty() || !diagnosis.errors().empty()) return;
  const Scene then = scene_of_stage(scene, s);
  for (const Material& material : then.material) {
    const auto index = static_cast<std::size_t>(&material - then.material.data());
    const auto objection = dilation_objection(then, index, diagnosis);
    if (objection.empty()) continue;
    diagnosis.error(key_of_stage(s, "friction_angle"),
                    fmt::format("\"{}\" then {}", material.name, objection),
                    "a material dilates by its friction angle at most: give dilation_angle, too");
  }
}

// Whether it changes anything but which drive is in force.
bool changes_besides(Stage stage) {
  stage.drive.reset();
  return changes_ground(stage);
}

void check_way(const Scene& scene, std::size_t s, tables::Diagnosis& diagnosis) {
  const Stage& stage = scene.stage[s];
  const std::string to = key_of_stage(s, "to");
  const auto in_force = courses_of_drives(scene)[s].in_force;
  const auto drives = drives_of(scene);
  const DriveKind kind = in_force ? drives[*in_force].drive->kind : DriveKind::none;
  const bool drives_on = kind == DriveKind::displacement || kind == DriveKind::load;
  if (stage.to && !drives_on && diagnosis.good({to, "drive.kind", key_of_stage(s, "drive")})) {
    diagnosis.error(to, fmt::format("found {}, and no drive", *stage.to),
                    "what moves or grows is a [drive] of kind displacement or load");
    return;
  }
  const bool begins = in_force && drives[*in_force].stage == s && *in_force > 0;
  const bool displaced = (stage.to || begins) && kind == DriveKind::displacement;
  const bool has_steps = stage.steps || scene.programme.steps.value_or(0) > 0;
  if (!displaced && !has_steps && diagnosis.good({key_of_stage(s, "steps")})) {
    diagnosis.error(key_of_stage(s, "steps"), "is missing",
                    "a stage needs the number of its steps, >= 1, unless a displacement goes on");
  }
  if (!diagnosis.errors().empty()) return;
  const Course course = scene_of_stage(scene, s).course;
  const bool moves = course.load_begin != course.load_end ||
                     course.reduction_begin != course.reduction_end || changes_besides(stage);
  const bool fades_on = s > 0 && scene.stage[s - 1].fades < 1.0;
  if (moves || fades_on) return;
  diagnosis.error(fmt::format("stage.{}", s), fmt::format("nothing happens in \"{}\"", stage.name),
                  "give it a way to go (to, reduction) or something to change");
}

void check_stage(const Scene& scene, std::size_t s, tables::Diagnosis& diagnosis) {
  const Stage& stage = scene.stage[s];
  if (stage.name.empty() && diagnosis.good({key_of_stage(s, "name")})) {
    diagnosis.error(key_of_stage(s, "name"), "found an empty one",
                    "stages are known by their names");
  }
  if (!stage.water_table.empty() && scene.water.table.empty()) {
    diagnosis.error(key_of_stage(s, "water_table"), "found without water.table",
                    "a table moves that is there from the first: give water.table, below the body "
                    "if it is dry");
  }
  if (stage.pore_pressure && !scene.water.pore_pressure) {
    diagnosis.error(key_of_stage(s, "pore_pressure"), "found without water.pore_pressure",
                    "a pressure changes that is there from the first: give water.pore_pressure, 0 "
                    "if there is none");
  }
  check_flow(scene, s, diagnosis);
  check_way(scene, s, diagnosis);
}

}  // namespace

void check_reduction(const Scene& scene, tables::Diagnosis& diagnosis) {
  const Drive& drive = scene.drive;
  if (!check_known(drive.weakened, names_of_all(scene.material), "drive.weakened", "material",
                   diagnosis)) {
    return;
  }
  const bool any = std::ranges::any_of(scene.material, [&](const Material& material) {
    return may_be_weaker(material) && is_weakened(scene, material.name);
  });
  for (const Material& material : scene.material) {
    if (!yields(material) || may_be_weaker(material) || !is_weakened(scene, material.name))
      continue;
    diagnosis.error("drive.weakened", fmt::format("would weaken \"{}\"", material.name),
                    fmt::format("what is divided is cohesion and tan(phi), and material model {} "
                                "has neither: name the others",
                                material.model));
    return;
  }
  // Faces by contact are divided, too, whatever is beside them.
  if (!any && !has_weakened_contact(scene) && diagnosis.good({"drive.weakened", "material"})) {
    diagnosis.error("drive.weakened", "no material of them has a strength",
                    "what is divided is cohesion and tan(phi)");
  }
  if (drive.kind == DriveKind::strength && scene.stage.empty() && drive.target <= 1.0 &&
      diagnosis.good({"drive.target"})) {
    diagnosis.error(
        "drive.target",
        diagnosis.given("drive.target") ? fmt::format("found {}", drive.target) : "is missing",
        "strength is divided by a factor that grows from 1 to this one, > 1");
  }
}

void check_stages(const Scene& scene, tables::Diagnosis& diagnosis) {
  if (scene.stage.empty()) return;
  const HourglassControl control = scene.hourglass.control;
  if (has_new_ground(scene) && diagnosis.good({"hourglass.control"}) &&
      (control == HourglassControl::stiffness || control == HourglassControl::viscosity ||
       control == HourglassControl::none)) {
    diagnosis.error(
        "hourglass.control",
        fmt::format("found {}, and stages that put regions down or change what they are "
                    "made of",
                    name_of(control)),
        "allowed are auto, incremental and mixed, which forget where the ground was");
  }
  check_names(scene.stage, "stage", diagnosis);
  // The scene of a stage takes them as they are.
  const std::size_t complaints = diagnosis.errors().size();
  for (std::size_t s = 0; s < scene.stage.size(); ++s)
    check_materials_of_stage(scene, s, diagnosis);
  if (diagnosis.errors().size() > complaints) return;
  if (scene.drive.kind == DriveKind::strength && diagnosis.good({"drive.kind"})) {
    diagnosis.error("drive.kind", "found strength with stages",
                    "a stage says to which reduction it goes: leave the drive out");
  }
  if (scene.limit.check && diagnosis.good({"limit.check"})) {
    diagnosis.error("limit.check", "found true with stages",
                    "bounds are computed for a footing that is driven in one go");
  }
  if (reduces_strength(scene)) check_reduction(scene, diagnosis);
  check_regions(scene, diagnosis);
  check_names_of_regions(scene, diagnosis);
  check_plate_stays(scene, diagnosis);
  check_supports(scene, diagnosis);
  for (std::size_t s = 0; s < scene.stage.size(); ++s) check_stage(scene, s, diagnosis);
  const std::string fades = key_of_stage(scene.stage.size() - 1, "fades");
  if (scene.stage.back().fades < 1.0 && diagnosis.good({fades})) {
    diagnosis.warning(fades, fmt::format("found {} in the last stage", scene.stage.back().fades),
                      "the rest of what changes leave unbalanced never fades: the run ends out of "
                      "equilibrium");
  }
}

}  // namespace scene
