#include "equilibrium/loops.hpp"
#include "equilibrium/mixed_law.hpp"

namespace equilibrium {

template LawLoops<3> law_loops<3, MixedLaw<3, true>>();

}  // namespace equilibrium
