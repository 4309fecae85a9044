#pragma once

#include "jfnk/options.hpp"

namespace jfnk::detail {

/// The sequence of relative linear tolerances eta of one Newton phase.
class ForcingSequence {
 public:
  explicit ForcingSequence(const Forcing& rule) : rule_(rule) {}

  /// eta for the system at ||F|| = norm, when `tolerance` ends the solve.
  double next(double norm, double tolerance);

 private:
  const Forcing& rule_;
  double previous_norm_ = 0.0;
  double previous_eta_ = 0.0;
  bool first_ = true;
};

}  // namespace jfnk::detail
