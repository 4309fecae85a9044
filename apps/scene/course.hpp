#pragma once

#include <cstddef>
#include <string>

namespace scene {

struct Course;
struct Scene;
struct Stage;

/// How many stages a run has: 1 if the scene lists none.
[[nodiscard]] std::size_t stage_count(const Scene& scene);

/// `stage 2 of 5, "unload"`.
[[nodiscard]] std::string stage_title(const Scene& scene, std::size_t stage);

/// Whether a stage begins with a change of the body, of values, of supports or of the drive, rather
/// than that its drive merely goes on.
[[nodiscard]] bool changes_ground(const Stage& stage);

/// Whether some stage does.
[[nodiscard]] bool changes_ground(const Scene& scene);

/// Whether stages put regions down, or change what they are made of: ground that must not remember
/// where that of before was.
[[nodiscard]] bool has_new_ground(const Scene& scene);

/// Whether stages load the ground by its weight, weaken it or take away what holds it: dig, fill,
/// release, flood, shake, change strength or material. Whether it still stands is the question
/// then.
[[nodiscard]] bool tries_ground(const Scene& scene);

/// Whether a region is there, or a support holds, once so many stages have begun: what they put
/// down or hold before it was taken away or released is not there at first.
[[nodiscard]] bool region_is_there(const Scene& whole, std::size_t stages,
                                   const std::string& region);
[[nodiscard]] bool support_is_there(const Scene& whole, std::size_t stages,
                                    const std::string& support);

/// Whether a support holds in a stage, by its name; without stages it does.
[[nodiscard]] bool holds_in_stage(const Scene& whole, std::size_t stage,
                                  const std::string& support);

/// Whether stages let a support begin, the first time or once more.
[[nodiscard]] bool begins_later(const Scene& whole, const std::string& support);

/// Whether strength is divided by more and more, in some stage at least.
[[nodiscard]] bool reduces_strength(const Scene& scene);

/// Whether a material's strength is divided when strength is.
[[nodiscard]] bool is_weakened(const Scene& scene, const std::string& material);

/// What strength is divided by, at a share of the way through its stage.
[[nodiscard]] double reduction_at(const Course& course, double progress);

}  // namespace scene
