#include "wiring/equilibrium_loops.hpp"
#include "wiring/plain_law.hpp"

template wiring::LawLoops<2> wiring::law_loops<2, wiring::PlainLaw<2, true>>();
