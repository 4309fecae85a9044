#pragma once

/// Vectors of other kinds than Eigen::VectorXd: see jfnk/vector_traits.hpp.
#include "jfnk/solver.hpp"
#include "jfnk/vector_traits.hpp"
