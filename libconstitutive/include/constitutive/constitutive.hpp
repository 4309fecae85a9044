#pragma once

// Everything but the Boost archives, which are in constitutive/serialization.hpp.
#include "constitutive/cone.hpp"
#include "constitutive/cone_update.hpp"
#include "constitutive/cut_cone.hpp"
#include "constitutive/drucker_prager.hpp"
#include "constitutive/elastic.hpp"
#include "constitutive/interface_law.hpp"
#include "constitutive/material.hpp"
#include "constitutive/mixed.hpp"
#include "constitutive/mixed_mohr_coulomb.hpp"
#include "constitutive/mohr_coulomb.hpp"
#include "constitutive/objective.hpp"
#include "constitutive/parameters.hpp"
#include "constitutive/rankine.hpp"
#include "constitutive/state.hpp"
#include "constitutive/tensor.hpp"
#include "constitutive/version.hpp"
