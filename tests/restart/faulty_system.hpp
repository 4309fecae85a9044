#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "files/system_calls.hpp"

namespace restart {

/// A call as a fault sees it, before it is made.
struct Call {
  std::string name;  // pwrite, fsync, ...
  std::string path;  // of the file it is about
};

/// Sees every call by number, from 0, and says what becomes of it.
struct Fault {
  enum class Kind { none, fails, falls_short };
  Kind kind = Kind::none;
  int number = 0;  // errno of a call that fails
};
using Fate = std::function<Fault(std::int64_t number, const Call& call)>;

/// System calls that end as `fate` says; those it lets be are the real ones. What it does before it
/// returns (kill the process, say) it does before the call.
[[nodiscard]] files::SystemCalls faulty_system(Fate fate);

/// All the calls that `work` makes.
[[nodiscard]] std::vector<Call> calls_of(
    const std::function<void(const files::SystemCalls&)>& work);

}  // namespace restart
