#include "equilibrium/loops.hpp"
#include "equilibrium/mixed_law.hpp"

namespace equilibrium {

template LawLoops<2> law_loops<2, MixedLaw<2, false>>();

}  // namespace equilibrium
