#pragma once

/// The whole of libjfnk: roots of F(u) = 0 without a Jacobian matrix.
#include "jfnk/gmres.hpp"
#include "jfnk/options.hpp"
#include "jfnk/preconditioner.hpp"
#include "jfnk/report.hpp"
#include "jfnk/residual.hpp"
#include "jfnk/solver.hpp"
