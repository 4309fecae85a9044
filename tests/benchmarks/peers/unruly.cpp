// Solvers that do not behave, to see that the harness ends them and goes on: jfnk-peers-unruly NAME
#include <cstdlib>

#include "trial.hpp"

int main(int argc, char** argv) {
  const auto insatiable = [](peers::Trial& trial) -> peers::Outcome {
    peers::Vector r(trial.size());
    // Never the start itself, which might be a root.
    for (;;) (void)trial.evaluate(trial.problem().start.array() + 1.0, r);
  };
  const auto crashing = [](peers::Trial&) -> peers::Outcome { std::abort(); };
  const auto quitting = [](peers::Trial&) -> peers::Outcome { std::exit(3); };
  const auto honest = [](peers::Trial&) { return peers::Outcome{false, false, 0, "gave up"}; };
  peers::run_all(argc > 1 ? argv[1] : "", {{"insatiable", insatiable},
                                           {"crashing", crashing},
                                           {"quitting", quitting},
                                           {"honest", honest}});
  return 0;
}
