#include "wiring/equilibrium_loops.hpp"
#include "wiring/plain_law.hpp"

template wiring::LawLoops<3> wiring::law_loops<3, wiring::PlainLaw<3, true>>();
