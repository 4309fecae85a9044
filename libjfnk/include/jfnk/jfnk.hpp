#pragma once

/// The whole of libjfnk: roots of F(u) = 0 without a Jacobian matrix. The archives of
/// jfnk/serialization.hpp need Boost and are included by themselves.
#include "jfnk/bicgstab.hpp"
#include "jfnk/block_jacobi.hpp"
#include "jfnk/check.hpp"
#include "jfnk/coloured_jacobian.hpp"
#include "jfnk/conjugate_gradients.hpp"
#include "jfnk/gmres.hpp"
#include "jfnk/options.hpp"
#include "jfnk/preconditioner.hpp"
#include "jfnk/report.hpp"
#include "jfnk/residual.hpp"
#include "jfnk/solver.hpp"
#include "jfnk/vector.hpp"
