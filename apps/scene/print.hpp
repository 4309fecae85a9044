#pragma once

#include <string>

namespace scene {

struct Scene;

/// The whole scene as TOML, every key with its unit, range and meaning; keys that are absent stand
/// as comments. Reads back to an equal scene.
[[nodiscard]] std::string effective_toml(const Scene& scene);

/// The reference of all tables and keys as Markdown (share/doc/scene.md).
[[nodiscard]] std::string scene_reference();

}  // namespace scene
