#include "program/thread_waiting.hpp"

#include <unistd.h>

#include <cstdlib>
#include <initializer_list>

namespace program {

void wait_briefly(char** words) {
  for (const char* variable : {thread_waiting_variable, "OMP_WAIT_POLICY"}) {
    if (std::getenv(variable) != nullptr) return;
  }
  if (::setenv(thread_waiting_variable, thread_waiting_count, 0) != 0) return;
  ::execv("/proc/self/exe", words);
}

}  // namespace program
