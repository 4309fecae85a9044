#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scene/choices.hpp"

namespace scene {

struct Drive;
struct OutlineSide;
struct Scene;
struct Stage;

/// A drive of a run and what it is called.
struct NamedDrive {
  std::string name;     // its own, or that of its stage, or `drive`
  const Drive* drive;   // in the scene
  std::string key;      // `drive`, `stage.2.drive`
  std::size_t stage{};  // whose it is; 0 for [drive]
};

/// Whether a drive's plate is a body of its own on the side, by contact or tied to it.
[[nodiscard]] bool is_rigid_body(const Drive& drive);

/// Makes the plate of a footing a body of its own: tied where it is rough and holds on, else one
/// that touches.
void choose_plate(const OutlineSide& footing, Drive& drive);

/// What a drive of a stage's scene, or the only one, is called.
[[nodiscard]] std::string name_of_drive(const Drive& drive);

/// The drives of a run, [drive] first, be it of kind none, then those that stages carry; not those
/// that only name another one.
[[nodiscard]] std::vector<NamedDrive> drives_of(const Scene& whole);

/// Whether stages carry drives of their own.
[[nodiscard]] bool has_stage_drives(const Scene& scene);

/// Whether a stage's drive only names one that there was: it goes on from where it is.
[[nodiscard]] bool is_reference(const Scene& whole, std::size_t stage);

/// What the drives of a run do in one of its stages, each by its place in `drives_of`.
struct StageDrives {
  std::optional<std::size_t> in_force;  // none: nothing moves or grows
  double begin = 0.0;                   // load parameter of that one, at the stage's beginning
  std::vector<double> load;             // of each at the stage's end; 0 if it does not act
  std::vector<bool> acts;               // has begun, and was not released
  std::vector<std::size_t> since;       // the stage from which it has acted without a break
  std::vector<std::size_t> last;        // the latest stage in which it was in force
};

/// Of each stage. Names that are not known are as if they were not there.
[[nodiscard]] std::vector<StageDrives> courses_of_drives(const Scene& whole);

/// Whether a drive begins after the first stage, or comes back after it was released: the ground
/// has moved by then.
[[nodiscard]] bool comes_later(const Scene& whole, const Drive& drive);

/// The drive that the [[side]] of a footing is for: the first that moves or loads a plate; none if
/// there is none.
[[nodiscard]] Drive* drive_of_footing(Scene& whole);

/// Every drive of a scene, or of a stage's: the one in force first.
[[nodiscard]] std::vector<const Drive*> all_drives(const Scene& scene);

/// A drive that moves, presses or holds its part of a side in the stage at hand.
struct ActingDrive {
  const Drive* drive;
  bool moves;     // it is the one in force
  double held;    // load parameter at which it stays; 0 for the one in force
  bool reported;  // settlement and reaction of the curve are its own
};

/// Those of a stage's scene that displace or press a plate: the one in force first.
[[nodiscard]] std::vector<ActingDrive> acting_drives(const Scene& scene);

/// The one of them that the curve reports; none if nothing is displaced or pressed.
[[nodiscard]] std::optional<ActingDrive> reported_drive(const Scene& scene);

/// Whether a load grows with a drive: weight, or a traction, side or cutout of a name.
[[nodiscard]] bool grows_with(const Scene& scene, const Drive& drive, LoadKind kind,
                              const std::string& name = "");

/// What there is of a load in a stage: a share that stays, and what grows with the load parameter.
struct LoadShare {
  double constant = 1.0;
  double growing = 0.0;
};

/// Of a load that grows with some drive: what that has come to; of others all of it.
[[nodiscard]] LoadShare share_of(const Scene& scene, LoadKind kind, const std::string& name = "");

/// Whether it grows with any drive.
[[nodiscard]] bool grows(const Scene& scene, LoadKind kind, const std::string& name = "");

/// Whether the body has weight.
[[nodiscard]] bool has_gravity(const Scene& scene);
/// Whether anything but weight loads the body from the start.
[[nodiscard]] bool has_dead_loads(const Scene& scene);

}  // namespace scene
