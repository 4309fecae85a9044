#include "equilibrium/loops.hpp"
#include "equilibrium/plain_law.hpp"

namespace equilibrium {

template LawLoops<3> law_loops<3, PlainLaw<3, false>>();

}  // namespace equilibrium
