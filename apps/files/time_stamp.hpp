#pragma once

#include <ctime>
#include <string>

namespace files {

/// A time in UTC as `2024-05-17T08:30:00Z`.
[[nodiscard]] std::string time_stamp(std::time_t time);

}  // namespace files
