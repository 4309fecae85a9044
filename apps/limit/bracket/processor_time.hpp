#pragma once

#include <ctime>

namespace limit::bracket {

/// Of this process so far.
inline double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace limit::bracket
