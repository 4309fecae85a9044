#pragma once

#include "jfnk/options.hpp"

namespace jfnk::detail {

/// What the sequence of relative linear tolerances eta remembers.
struct ForcingState {
  double previous_norm = 0.0;
  double previous_eta = 0.0;
  bool first = true;

  template <class Visitor>
  void for_each_field(Visitor& visit) {
    visit(previous_norm);
    visit(previous_eta);
    visit(first);
  }
};

/// eta for the system at ||F|| = norm, when `tolerance` ends the solve.
[[nodiscard]] double next_forcing(const Forcing& rule, ForcingState& state, double norm,
                                  double tolerance);

}  // namespace jfnk::detail
