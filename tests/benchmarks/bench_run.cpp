// fpm-bench-run: runs one body and prints what the run cost, as comma-separated values:
//   body, particles, threads, reached (load parameter), steps, evaluations (residuals and Jacobian
//   actions of all attempts), seconds (wall clock, without set-up), peak memory per particle
//   [bytes]
// One process per run, since the peak is the process's.

#include <omp.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "bodies.hpp"
#include "model/build.hpp"
#include "model/model.hpp"
#include "stepping/stepper.hpp"

namespace benchmarks {
namespace {

constexpr const char* usage =
    "usage: fpm-bench-run BODY [--to LOAD] [--threads N]\n"
    "       fpm-bench-run --list\n"
    "LOAD in (0, 1] is the load parameter to stop at; default: the body's own.\n";

constexpr double most_threads = 4096;

struct Request {
  std::string body;
  std::optional<double> to;
  int threads = 1;
};

rusage resources() {
  rusage u{};
  getrusage(RUSAGE_SELF, &u);
  return u;
}

/// Largest resident memory of this process so far.
double peak_bytes() {
  return static_cast<double>(resources().ru_maxrss) * 1024.0;  // Linux counts in KiB
}

/// Processor time of all threads of this process so far [s].
double processor_seconds() {
  const rusage u = resources();
  return static_cast<double>(u.ru_utime.tv_sec + u.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(u.ru_utime.tv_usec + u.ru_stime.tv_usec);
}

/// @returns whether every step converged
template <int Dim>
bool run(const Body& body, const scene::Scene& scene, const Request& request) {
  using Clock = std::chrono::steady_clock;
  const double before = peak_bytes();
  const auto model = model::build_model<Dim>(scene);
  auto state = model::initial_state(model);
  stepping::LoadStepper<Dim> stepper(scene, model, state);
  const double to = request.to.value_or(body.run_to);
  long steps = 0;
  long evaluations = 0;
  bool converged = true;
  const double processor_start = processor_seconds();
  const auto start = Clock::now();
  while (converged && !stepper.finished() && state.programme.load < to) {
    const stepping::StepResult result = stepper.advance();
    converged = result.outcome == stepping::StepOutcome::converged;
    evaluations += result.record.evaluations;
    if (converged) ++steps;
    if (!converged) std::fprintf(stderr, "%s: %s\n", body.name.c_str(), result.reason.c_str());
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  const double processor = processor_seconds() - processor_start;
  const auto n = static_cast<long>(model.size());
  std::printf("%s,%ld,%d,%.6g,%ld,%ld,%.6g,%.6g,%.0f\n", body.name.c_str(), n, request.threads,
              state.programme.load, steps, evaluations, seconds, processor,
              (peak_bytes() - before) / static_cast<double>(n));
  return converged;
}

double number(const char* text) {
  char* end = nullptr;
  const double value = std::strtod(text, &end);
  if (end == text || *end != '\0') throw std::invalid_argument(std::string(text) + ": no number");
  return value;
}

Request read_arguments(int count, char** arguments) {
  Request request;
  for (int k = 1; k < count; ++k) {
    const std::string_view argument = arguments[k];
    if (argument == "--to" && k + 1 < count) {
      request.to = number(arguments[++k]);
      if (!(*request.to > 0.0 && *request.to <= 1.0)) {
        throw std::invalid_argument("--to wants a number in (0, 1]");
      }
    } else if (argument == "--threads" && k + 1 < count) {
      const double threads = number(arguments[++k]);
      if (!(threads >= 1.0 && threads <= most_threads)) {
        throw std::invalid_argument("--threads wants a whole number from 1 to 4096");
      }
      request.threads = static_cast<int>(threads);
    } else if (request.body.empty() && !argument.starts_with("-")) {
      request.body = argument;
    } else {
      throw std::invalid_argument(usage);
    }
  }
  if (request.body.empty()) throw std::invalid_argument(usage);
  return request;
}

int main_of(int count, char** arguments) {
  if (count == 2 && std::string_view(arguments[1]) == "--list") {
    for (const Body& body : bodies()) std::printf("%s\n", body.name.c_str());
    return 0;
  }
  const Request request = read_arguments(count, arguments);
  const Body body = body_named(request.body);
  const auto scene = scene_of(body);
  omp_set_num_threads(request.threads);
  const bool converged =
      dimension_of(*scene) == 2 ? run<2>(body, *scene, request) : run<3>(body, *scene, request);
  return converged ? 0 : 3;
}

}  // namespace
}  // namespace benchmarks

int main(int count, char** arguments) {
  try {
    return benchmarks::main_of(count, arguments);
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "fpm-bench-run: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fpm-bench-run: %s\n", error.what());
    return 1;
  }
}
