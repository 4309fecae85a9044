#pragma once

#include <optional>
#include <string>
#include <utility>

#include "fpm/types.hpp"
#include "model/refusal.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// Numbers of two materials, the smaller first.
using MaterialPair = std::pair<fpm::Index, fpm::Index>;

/// An interface that the scene asks for lies where one of its materials has no rows of its own.
struct InterfaceRefused : Refusal {
  using Refusal::Refusal;
};

/// The key by which the scene itself says what happens between two materials, if it does, and that
/// rows do not go through.
std::optional<std::string> key_of_given(const scene::Scene& scene, const MaterialPair& pair);

}  // namespace model
