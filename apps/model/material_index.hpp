#pragma once

#include <cstdint>

namespace model {

/// Which of a scene's materials a particle is made of.
using MaterialIndex = std::uint16_t;

}  // namespace model
