#pragma once

#include <cstdint>
#include <stdexcept>

namespace fpm::detail {

inline void check_jitter(double jitter) {
  if (!(jitter >= 0.0 && jitter <= 0.45)) {
    throw std::invalid_argument("lattice jitter must be between 0 and 0.45");
  }
}

// splitmix64 (Steele, Lea & Flood 2014): the standard distributions differ between libraries, and
// a scene must give the same particles everywhere.
inline double uniform_minus_one_to_one(std::uint64_t& state) {
  state += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = state;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  z ^= z >> 31U;
  return static_cast<double>(z >> 11U) * 0x1.0p-52 - 1.0;
}

}  // namespace fpm::detail
