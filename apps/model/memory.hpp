#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace model {

/// What some of a run's memory is for.
struct MemoryPart {
  std::string name;
  std::size_t bytes = 0;
};

inline std::size_t total(const std::vector<MemoryPart>& parts) {
  std::size_t sum = 0;
  for (const MemoryPart& part : parts) sum += part.bytes;
  return sum;
}

}  // namespace model
