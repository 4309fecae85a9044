#include "scene/drives.hpp"

#include <algorithm>
#include <cmath>

#include "scene/box.hpp"
#include "scene/scene.hpp"

namespace scene {
namespace {

template <class List, class Item>
bool holds(const List& list, const Item& item) {
  return std::ranges::count(list, item) > 0;
}

// Whether it says nothing but a name.
bool only_names(const Drive& drive) {
  Drive bare;
  bare.name = drive.name;
  return !drive.name.empty() && drive == bare;
}

std::string own_name(const Drive& drive, const std::string& otherwise) {
  return drive.name.empty() ? otherwise : drive.name;
}

std::optional<std::size_t> place_of(const std::vector<NamedDrive>& drives, const std::string& name,
                                    std::size_t before_stage) {
  for (std::size_t d = 0; d < drives.size(); ++d) {
    const bool there = d == 0 || drives[d].stage < before_stage;
    if (there && drives[d].name == name) return d;
  }
  return std::nullopt;
}

bool is_plate(const Drive& drive) {
  return drive.kind == DriveKind::displacement || loads_plate(drive);
}

// Walks from stage to stage.
class Walk {
 public:
  explicit Walk(const Scene& whole) : whole_(whole), drives_(drives_of(whole)) {
    const std::size_t count = drives_.size();
    now_.load.assign(count, 0.0);
    now_.acts.assign(count, false);
    now_.since.assign(count, 0);
    now_.last.assign(count, 0);
    if (drives_[0].drive->kind != DriveKind::none) now_.in_force = 0;
  }

  const StageDrives& enter(std::size_t s) {
    const Stage& stage = whole_.stage[s];
    release(stage);
    bool begins = false;
    if (stage.drive) begins = choose(s);
    if (now_.in_force) drive(s, begins);
    return now_;
  }

 private:
  void release(const Stage& stage) {
    for (std::size_t d = 0; d < drives_.size(); ++d) {
      if (!now_.acts[d] || !holds(stage.release, drives_[d].name)) continue;
      now_.acts[d] = false;
      now_.load[d] = 0.0;
      if (now_.in_force == d) now_.in_force.reset();
    }
  }

  // Which drive the stage's table is; whether it is a new one.
  bool choose(std::size_t s) {
    if (is_reference(whole_, s)) {
      now_.in_force = place_of(drives_, whole_.stage[s].drive->name, s);
      return false;
    }
    now_.in_force.reset();
    for (std::size_t d = 1; d < drives_.size(); ++d) {
      if (drives_[d].stage == s && drives_[d].drive->kind != DriveKind::none) now_.in_force = d;
    }
    return true;
  }

  void drive(std::size_t s, bool begins) {
    const std::size_t d = *now_.in_force;
    const Drive& drive = *drives_[d].drive;
    if (!now_.acts[d]) now_.since[d] = s;
    now_.acts[d] = true;
    now_.last[d] = s;
    now_.begin = now_.load[d];
    if (begins) now_.load[d] = 1.0;
    if (const auto& to = whole_.stage[s].to) {
      now_.load[d] = drive.kind == DriveKind::displacement ? *to / drive.target : *to;
    }
  }

  const Scene& whole_;
  std::vector<NamedDrive> drives_;
  StageDrives now_;
};

}  // namespace

bool is_rigid_body(const Drive& drive) {
  return drive.method == DriveMethod::contact || drive.method == DriveMethod::tied;
}

void choose_plate(const OutlineSide& footing, Drive& drive) {
  const bool ties = footing.base == Base::rough && footing.tension;
  drive.method = ties ? DriveMethod::tied : DriveMethod::contact;
  drive.contact.tension = footing.tension;
}

std::string name_of_drive(const Drive& drive) {
  return own_name(drive, "drive");
}

std::vector<NamedDrive> drives_of(const Scene& whole) {
  std::vector<NamedDrive> drives{{name_of_drive(whole.drive), &whole.drive, "drive", 0}};
  for (std::size_t s = 0; s < whole.stage.size(); ++s) {
    const auto& own = whole.stage[s].drive;
    if (!own || (only_names(*own) && place_of(drives, own->name, s))) continue;
    drives.push_back(
        {own_name(*own, whole.stage[s].name), &*own, "stage." + std::to_string(s) + ".drive", s});
  }
  return drives;
}

bool has_stage_drives(const Scene& scene) {
  return std::ranges::any_of(scene.stage,
                             [](const Stage& stage) { return stage.drive.has_value(); });
}

bool is_reference(const Scene& whole, std::size_t stage) {
  const auto& own = whole.stage[stage].drive;
  return own && only_names(*own) && place_of(drives_of(whole), own->name, stage).has_value();
}

std::vector<StageDrives> courses_of_drives(const Scene& whole) {
  Walk walk(whole);
  std::vector<StageDrives> courses;
  for (std::size_t s = 0; s < whole.stage.size(); ++s) courses.push_back(walk.enter(s));
  return courses;
}

bool comes_later(const Scene& whole, const Drive& drive) {
  const auto drives = drives_of(whole);
  const auto is_it = [&](const NamedDrive& named) { return named.drive == &drive; };
  const auto d = static_cast<std::size_t>(std::ranges::find_if(drives, is_it) - drives.begin());
  return d < drives.size() &&
         std::ranges::any_of(courses_of_drives(whole), [&](const StageDrives& course) {
           return course.acts[d] && course.since[d] > 0;
         });
}

Drive* drive_of_footing(Scene& whole) {
  if (is_plate(whole.drive)) return &whole.drive;
  for (Stage& stage : whole.stage) {
    if (stage.drive && is_plate(*stage.drive)) return &*stage.drive;
  }
  return nullptr;
}

std::vector<const Drive*> all_drives(const Scene& scene) {
  std::vector<const Drive*> all{&scene.drive};
  for (const OtherDrive& other : scene.other_drives) all.push_back(&other.drive);
  for (const Stage& stage : scene.stage) {
    if (scene.other_drives.empty() && stage.drive) all.push_back(&*stage.drive);
  }
  return all;
}

std::vector<ActingDrive> acting_drives(const Scene& scene) {
  std::vector<ActingDrive> acting;
  if (is_plate(scene.drive)) acting.push_back({&scene.drive, true, 0.0, true});
  const OtherDrive* latest = nullptr;
  for (const OtherDrive& other : scene.other_drives) {
    if (!other.acts || !is_plate(other.drive)) continue;
    if (latest == nullptr || other.last >= latest->last) latest = &other;
  }
  for (const OtherDrive& other : scene.other_drives) {
    if (!other.acts || !is_plate(other.drive)) continue;
    const bool reported = &other == latest && !is_plate(scene.drive);
    acting.push_back({&other.drive, false, other.load, reported});
  }
  return acting;
}

std::optional<ActingDrive> reported_drive(const Scene& scene) {
  for (const ActingDrive& acting : acting_drives(scene)) {
    if (acting.reported) return acting;
  }
  return std::nullopt;
}

bool grows_with(const Scene& scene, const Drive& drive, LoadKind kind, const std::string& name) {
  if (drive.kind != DriveKind::load || !holds(drive.scales, kind)) return false;
  if (kind != LoadKind::traction) return true;
  if (!drive.loads.empty()) return holds(drive.loads, name);
  return std::ranges::none_of(all_drives(scene), [&](const Drive* other) {
    return other->kind == DriveKind::load && holds(other->loads, name);
  });
}

LoadShare share_of(const Scene& scene, LoadKind kind, const std::string& name) {
  if (grows_with(scene, scene.drive, kind, name)) return {0.0, 1.0};
  for (const OtherDrive& other : scene.other_drives) {
    if (grows_with(scene, other.drive, kind, name)) return {other.load, 0.0};
  }
  return {1.0, 0.0};
}

bool grows(const Scene& scene, LoadKind kind, const std::string& name) {
  return std::ranges::any_of(
      all_drives(scene), [&](const Drive* drive) { return grows_with(scene, *drive, kind, name); });
}

bool has_gravity(const Scene& scene) {
  return std::ranges::any_of(scene.gravity.acceleration, [](double g) { return g != 0.0; });
}

bool has_dead_loads(const Scene& scene) {
  const auto grown = [&](const std::string& name) {
    return grows(scene, LoadKind::traction, name);
  };
  const auto loaded = [](const auto& side) { return side.pressure != 0.0 || side.shear != 0.0; };
  return std::ranges::any_of(scene.side, loaded) ||
         std::ranges::any_of(scene.traction,
                             [&](const Traction& traction) { return !grown(traction.name); }) ||
         std::ranges::any_of(scene.cutout, [&](const Cutout& cutout) {
           return loaded(cutout) && !grown(cutout.name);
         });
}

}  // namespace scene
