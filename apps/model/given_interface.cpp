#include "model/given_interface.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/derived.hpp"
#include "scene/scene.hpp"

namespace model {

std::optional<std::string> key_of_given(const scene::Scene& scene, const MaterialPair& pair) {
  const auto one = static_cast<std::size_t>(pair.first);
  const auto other = static_cast<std::size_t>(pair.second);
  const scene::Interface rule = scene::interface_between(scene, one, other);
  const auto found = std::ranges::find(scene.interface, rule);
  if (rule.kind == scene::InterfaceKind::through) return std::nullopt;
  if (found != scene.interface.end()) {
    return fmt::format("interface.{}.kind", found - scene.interface.begin());
  }
  if (rule.kind == scene::InterfaceKind::tied) return std::nullopt;
  return "approximation.interfaces";
}

}  // namespace model
