// A scene of polygons of any content, with a setting of any content: the text before a zero is the
// scene, what follows a setting. What is accepted must become meshes that conform.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limit/ground/ground_case.hpp"
#include "limit/ground/ground_outline.hpp"

namespace {

// Meshes of much ground only cost time.
bool is_small(const limit::ground::GroundOutline& outline) {
  constexpr std::size_t most_points = 16;
  return outline.points.size() <= most_points;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view whole(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(whole.find('\0'), size);
  std::vector<std::string> settings;
  if (end < size) settings.emplace_back(whole.substr(end + 1));
  tables::Diagnosis diagnosis("ground.toml");
  std::optional<tables::Complaint> unreadable;
  const auto scene =
      limit::ground::read_ground_scene(whole.substr(0, end), settings, diagnosis, unreadable);
  const auto is_refused = [&] { return unreadable || !diagnosis.errors().empty(); };
  if (!scene) {
    if (!is_refused()) std::abort();  // refused without a reason
    return 0;
  }
  const limit::ground::GroundOutline outline = limit::ground::ground_outline(*scene, diagnosis);
  if (is_refused() || !is_small(outline)) return 0;
  const auto made = limit::ground::ground_case(*scene, diagnosis);
  if (!made && !is_refused()) std::abort();
  if (!made) return 0;
  (void)limit::mesh::edges_of(made->associated.lower.mesh);
  (void)limit::mesh::edges_of(made->associated.upper.mesh);
  return 0;
}
