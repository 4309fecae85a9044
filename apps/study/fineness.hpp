#pragma once

#include <cstddef>

namespace study {

/// How fine a run is, beside the scene's own settings.
struct Fineness {
  std::size_t level = 0;   // of the spacings on offer, coarsest first
  double steps = 1.0;      // times the scene's at that spacing
  double tolerance = 1.0;  // times the scene's
  double control = 1.0;    // times the scene's stiffness of the zero-energy control
  double box = 1.0;        // times as far to the sides that are far
  bool operator==(const Fineness&) const = default;
};

}  // namespace study
