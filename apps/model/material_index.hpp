#pragma once

#include <cstdint>

namespace model {

/// Which of a scene's materials a particle is made of.
using MaterialIndex = std::uint16_t;

/// Which of a model's laws a particle follows.
using LawIndex = std::uint32_t;

}  // namespace model
