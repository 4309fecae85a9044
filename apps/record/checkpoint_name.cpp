#include "record/checkpoint_name.hpp"

#include <fmt/format.h>

#include <charconv>
#include <string_view>

namespace record {

namespace {

constexpr std::string_view name_begins = "step-";
constexpr std::string_view name_ends = ".hdf";

}  // namespace

std::string checkpoint_name(std::int64_t step) {
  return fmt::format("{}{:06}{}", name_begins, step, name_ends);
}

std::optional<std::int64_t> step_of(const std::filesystem::path& checkpoint) {
  const std::string name = checkpoint.filename().string();
  if (!name.starts_with(name_begins) || !name.ends_with(name_ends)) return std::nullopt;
  const char* first = name.data() + name_begins.size();
  const char* last = name.data() + name.size() - name_ends.size();
  std::int64_t step = 0;
  if (first >= last) return std::nullopt;
  const auto [stop, failure] = std::from_chars(first, last, step);
  if (failure != std::errc{} || stop != last || step < 0) return std::nullopt;
  return step;
}

}  // namespace record
