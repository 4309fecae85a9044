#pragma once

namespace constitutive {

/// Version of this library as written in its CMake package, "major.minor.patch".
inline constexpr const char* version = "0.2.0";

}  // namespace constitutive
