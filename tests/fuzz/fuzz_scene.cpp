// A scene file of any content, with a setting of any content: the text before a zero is the scene,
// what follows a setting. A scene that is accepted must print to one that is accepted and equal.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "scene/print.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view whole(reinterpret_cast<const char*>(data), size);
  const std::size_t end = std::min(whole.find('\0'), size);
  std::vector<std::string> settings;
  if (end < size) settings.emplace_back(whole.substr(end + 1));
  const auto reading = scene::parse_scene(whole.substr(0, end), "scene.toml", settings);
  if (!reading.scene) {
    if (reading.errors.empty()) std::abort();  // refused without a reason
    return 0;
  }
  const auto again = scene::parse_scene(scene::effective_toml(*reading.scene), "effective", {});
  if (!again.scene || *again.scene != *reading.scene) std::abort();
  return 0;
}
