#pragma once

#include <string>

namespace tables {

/// A number in its shortest form that reads back to the same double; always a TOML float.
[[nodiscard]] std::string number_text(double value);
/// A TOML basic string; control characters escaped, UTF-8 as it is.
[[nodiscard]] std::string quoted_text(const std::string& text);

}  // namespace tables
