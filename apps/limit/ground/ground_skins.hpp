#pragma once

#include "limit/ground/ground_outline.hpp"
#include "limit/problem/case.hpp"

namespace limit::ground {

/// Faces of soil without cohesion, with nothing on them: a skin, however thin, slides parallel to a
/// face as soon as tan(friction angle) is less than tan(inclination), and falls off one that hangs
/// over, as soil without tension does. Says so in the notes of a case that seeks the factor of its
/// strength, with what is known of it in closed form.
/// @param soils  of the problem, by material
void say_skins(const GroundScene& scene, const GroundOutline& outline,
               const problem::Problem& soils, problem::Case& result);

/// Refuses ground without cohesion that is not at rest under what is given, whatever else acts:
/// which water lifts off a face with nothing on it, as where it rises steeply, or which is steeper
/// there than its friction. Not where weights are sought, nor the latter where the strength is.
void check_bare_faces(const GroundScene& scene, const GroundOutline& outline,
                      const problem::Problem& problem, tables::Diagnosis& diagnosis);

/// Refuses a given pressure or shear that ends beside a bare face of ground without cohesion, which
/// bears nothing there.
void check_ends_of_pressure(const GroundScene& scene, const GroundOutline& outline,
                            const problem::Problem& problem, tables::Diagnosis& diagnosis);

/// Of a traction that grows and ends there the upper bound is known, nothing: says so in the notes.
void say_ends_of_live_pressure(const GroundScene& scene, const GroundOutline& outline,
                               const problem::Problem& problem, problem::Case& result);

}  // namespace limit::ground
