#pragma once

namespace program {

/// The environment variable of GCC's OpenMP that says how often an idle thread looks for work
/// before it sleeps, and what it is set to: some tenths of a millisecond. Asleep from the start
/// (passive), threads are woken for each of the many short loops of an evaluation, which takes
/// longer than one thread alone; never asleep (active), they burn a processor that others may need.
inline constexpr char thread_waiting_variable[] = "GOMP_SPINCOUNT";
inline constexpr char thread_waiting_count[] = "10000";

/// Sets that variable unless the environment says itself how threads wait (it, or OMP_WAIT_POLICY).
/// As OpenMP has read its environment before `main`, the program starts anew, in the same process;
/// where it cannot, it goes on as it is. To be called first of all.
/// @param words  of the command line, as `main` has them
void wait_briefly(char** words);

}  // namespace program
