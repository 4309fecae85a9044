#pragma once

#include "problem.hpp"

namespace peers {

/// The parts of `add_third_set` that fill files of their own.
void add_third_grids(std::vector<Problem>& problems);
void add_third_mechanics(std::vector<Problem>& problems);

/// Those of the grids of which the set has a second form, with noise or in other units.
Problem ginzburg_landau(const char* name, int m, double epsilon);
Problem diode(const char* name, int n, double bias);
Problem warm_cavity(const char* name, int m, double rayleigh);
Problem ornstein_zernike(const char* name, int n);

}  // namespace peers
