#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace model {

/// What the scene asks for cannot be, as only its particles show: its key, what was found there
/// and what is allowed.
struct Refusal : std::runtime_error {
  Refusal(std::string key_asked, std::string what_found, std::string what_allowed)
      : std::runtime_error(key_asked + ": " + what_found + "; " + what_allowed),
        key(std::move(key_asked)),
        found(std::move(what_found)),
        allowed(std::move(what_allowed)) {}
  std::string key, found, allowed;
};

}  // namespace model
