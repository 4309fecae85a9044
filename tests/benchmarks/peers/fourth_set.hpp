#pragma once

#include "problem.hpp"

namespace peers {

/// The parts of `add_fourth_set` that fill files of their own.
void add_fourth_grids(std::vector<Problem>& problems);
void add_fourth_mechanics(std::vector<Problem>& problems);

/// Those of which the set has a second form, with noise or in other units.
Problem hexagons(const char* name, int m);
Problem karman_plate(const char* name, int m, double load);
Problem tubular_reactor(const char* name, int n);
Problem two_walls(const char* name, int m);

}  // namespace peers
