#include "wiring/equilibrium_loops.hpp"
#include "wiring/mixed_law.hpp"

template wiring::LawLoops<2> wiring::law_loops<2, wiring::MixedLaw<true>>();
