#include "equilibrium/loops.hpp"
#include "equilibrium/plain_law.hpp"

namespace equilibrium {

template LawLoops<2> law_loops<2, PlainLaw<2, true>>();

}  // namespace equilibrium
