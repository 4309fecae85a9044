#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace scene {
struct Scene;
}

namespace benchmarks {

/// A shipped scene with the settings that make a benchmark of it.
struct Body {
  std::string name;
  std::string scene;                  // file of share/scenes
  std::vector<std::string> settings;  // as --set takes them
  double run_to = 1.0;                // load parameter that a run goes to unless told otherwise
};

/// The bodies of the table: the footing with either control on a lattice (rows share stencils), on
/// a jittered set (they do not) and on a fine lattice; and a block in 3D.
std::vector<Body> bodies();

/// The body of that name.
/// @throws std::invalid_argument naming those that exist
Body body_named(std::string_view name);

/// The scene of a body.
/// @throws std::runtime_error with every complaint if the scene is refused
std::shared_ptr<const scene::Scene> scene_of(const Body& body);

/// Of its space, 2 or 3.
int dimension_of(const scene::Scene& scene);

/// Of the solver's preconditioner, over the spacing.
double coarse_spacing_of(const scene::Scene& scene);

}  // namespace benchmarks
