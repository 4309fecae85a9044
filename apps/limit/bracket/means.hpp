#pragma once

#include <ctime>
#include <functional>

#include "limit/solver/cone_solver.hpp"

namespace limit::bracket {

/// Of this process so far.
inline double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// What solves the programmes of a bracket, and the clock that its budget is measured by.
struct Means {
  std::function<solver::ConeSolution(const programme::ConeProgram&, const solver::SolverOptions&)>
      solve = solver::solve;
  std::function<double()> seconds = processor_seconds;
};

}  // namespace limit::bracket
