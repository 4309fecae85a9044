#pragma once

// Everything of the library.
#include "fpm/boundary.hpp"
#include "fpm/boundary_loads.hpp"
#include "fpm/consistency.hpp"
#include "fpm/ghosts.hpp"
#include "fpm/hourglass.hpp"
#include "fpm/kernel.hpp"
#include "fpm/moment_operator.hpp"
#include "fpm/neighbour_search.hpp"
#include "fpm/particles.hpp"
#include "fpm/points.hpp"
#include "fpm/recovery.hpp"
#include "fpm/rows.hpp"
#include "fpm/stencil.hpp"
#include "fpm/subpoints.hpp"
#include "fpm/types.hpp"
#include "fpm/viscosity.hpp"
