// How idle threads wait is set before OpenMP reads its environment: in a program started anew.
#include "program/thread_waiting.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <vector>

namespace {

constexpr char marker[] = "FPM_TEST_OF_THREAD_WAITING";
constexpr int went_on = 7;

/// Exit code of a child whose environment has a variable, which waits briefly and then runs the
/// test below; `went_on` if it was not started anew.
int child_with(const char* variable, const char* value) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::unsetenv(program::thread_waiting_variable);
    ::unsetenv("OMP_WAIT_POLICY");
    ::setenv(marker, "1", 1);
    if (variable != nullptr) ::setenv(variable, value, 1);
    std::vector<std::string> words = {"program_tests", "--gtest_filter=ThreadWaiting.WasSet"};
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    program::wait_briefly(pointers.data());
    ::_exit(went_on);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(ThreadWaiting, WasSet) {
  if (std::getenv(marker) == nullptr) GTEST_SKIP() << "for a program started anew";
  EXPECT_STREQ(std::getenv(program::thread_waiting_variable), program::thread_waiting_count);
}

TEST(ThreadWaiting, IsSetInAProgramStartedAnewOnce) {
  EXPECT_EQ(child_with(nullptr, nullptr), 0);
}

TEST(ThreadWaiting, IsTheUsersIfTheEnvironmentSaysSo) {
  EXPECT_EQ(child_with("OMP_WAIT_POLICY", "passive"), went_on);
  EXPECT_EQ(child_with(program::thread_waiting_variable, "1"), went_on);
}

}  // namespace
