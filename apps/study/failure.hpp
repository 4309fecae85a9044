#pragma once

namespace scene {
struct Scene;
}

namespace study {

struct Quantity;

/// Whether a quantity says where a run fails: its last load parameter, or what strength is divided
/// by then. A run that ends without equilibrium is its answer.
[[nodiscard]] bool is_of_a_failure(const Quantity& quantity);

/// How far such a quantity may be off since a failure is met in increments, the smallest of the
/// programme's.
[[nodiscard]] double failure_resolution(const scene::Scene& scene, const Quantity& quantity);

}  // namespace study
