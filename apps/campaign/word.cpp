#include "campaign/word.hpp"

#include <algorithm>
#include <charconv>

#include "files/durable_file.hpp"

namespace campaign {

std::optional<double> number_after(std::string_view text, std::string_view word) {
  const std::size_t at = text.find(word);
  if (at == std::string_view::npos) return std::nullopt;
  const std::size_t first = text.find_first_not_of(' ', at + word.size());
  if (first == std::string_view::npos) return std::nullopt;
  double number = 0.0;
  const auto [stop, failure] =
      std::from_chars(text.data() + first, text.data() + text.size(), number);
  return failure == std::errc{} ? std::optional(number) : std::nullopt;
}

double fraction_reached(const std::filesystem::path& curve) {
  std::error_code failure;
  if (!std::filesystem::exists(curve, failure)) return 0.0;
  const std::string text = files::read_text(curve);
  const std::size_t end = text.rfind('\n');
  if (end == std::string::npos || end == 0) return 0.0;
  const std::size_t begin = text.rfind('\n', end - 1);
  if (begin == std::string::npos) return 0.0;  // the header only
  const std::size_t comma = text.find(',', begin);
  return std::clamp(number_after(std::string_view(text).substr(comma), ",").value_or(0.0), 0.0,
                    1.0);
}

}  // namespace campaign
