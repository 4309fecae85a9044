// fpm-bench: time and traffic per particle of the kernels behind a residual, beside a STREAM triad.
// Names are kernel/body/threads:N. Besides the options of Google Benchmark:
//   --threads=1,2   thread counts
//   --settle=10     converged steps that each body has made before it is measured

#include <benchmark/benchmark.h>
#include <omp.h>

#include <charconv>
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bodies.hpp"
#include "prepared.hpp"
#include "traffic.hpp"
#include "triad.hpp"

namespace benchmarks {
namespace {

struct Settings {
  std::vector<int> threads{1, 2};
  int settle_steps = 10;
};

/// The body of a group of benchmarks, made when the first of them runs: a filter saves the rest.
template <int Dim>
struct Subject {
  Body body;
  int settle_steps;
  std::unique_ptr<Prepared<Dim>> prepared;

  Prepared<Dim>& operator()() {
    if (!prepared) prepared = std::make_unique<Prepared<Dim>>(body, settle_steps);
    return *prepared;
  }
};

// Time [s] and bytes per particle (per element of a triad), and their quotient [bytes/s].
void report(benchmark::State& state, double items, double bytes_per_item) {
  using benchmark::Counter;
  state.counters["particles"] = items;
  state.counters["time"] = Counter(items, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["bytes"] = bytes_per_item;
  state.counters["bandwidth"] = Counter(items * bytes_per_item, Counter::kIsIterationInvariantRate);
}

void measure_triad(benchmark::State& state, std::size_t elements, int threads) {
  omp_set_num_threads(threads);
  Triad triad(elements);
  for (auto _ : state) {
    triad.run();
    benchmark::DoNotOptimize(triad.result());
    benchmark::ClobberMemory();
  }
  report(state, static_cast<double>(elements), Triad::bytes_per_element);
}

/// One kernel: `start` makes a work to repeat, which returns false if it could not.
template <int Dim>
struct Kernel {
  const char* name;
  double Traffic::*bytes;
  std::function<bool()> (*start)(Prepared<Dim>&);
};

template <int Dim>
std::function<bool()> start_gather(Prepared<Dim>& p) {
  using Operator = fpm::MomentOperator<Dim>;
  const Operator& op = p.equilibrium.moment_operator();
  auto field = std::make_shared<Eigen::VectorXd>(op.stride() * Dim);
  op.extend(p.direction.data(), field->data());
  return [&op, field] {
#pragma omp parallel
    {
      alignas(64) double moments[fpm::most_channels<Dim> * Dim * Operator::block_stride];
#pragma omp for schedule(static)
      for (fpm::Index block = 0; block < op.block_count(); ++block) {
        op.gather(block, field->data(), moments);
        benchmark::DoNotOptimize(moments[0]);
        benchmark::ClobberMemory();
      }
    }
    return true;
  };
}

template <int Dim>
std::function<bool()> start_scatter(Prepared<Dim>& p) {
  const fpm::MomentOperator<Dim>& op = p.equilibrium.moment_operator();
  struct Arrays {
    Eigen::VectorXd field, stress, force;
  };
  auto arrays = std::make_shared<Arrays>();
  arrays->field.resize(op.stride() * Dim);
  op.extend(p.direction.data(), arrays->field.data());
  arrays->stress.setOnes(op.stride() * op.stress_count());
  arrays->force.setZero(op.stride() * Dim);
  return [&op, arrays] {
    const double* field = arrays->field.data();
    op.scatter(arrays->stress.data(), field, field, arrays->force.data());
    return true;
  };
}

template <int Dim>
std::function<bool()> start_residual(Prepared<Dim>& p) {
  return [&p] { return p.equilibrium(p.increment, p.result) == jfnk::Evaluation::ok; };
}

template <int Dim>
std::function<bool()> start_linearise(Prepared<Dim>& p) {
  return [&p] { return p.equilibrium.linearise(p.increment); };
}

template <int Dim>
std::function<bool()> start_action(Prepared<Dim>& p) {
  const bool linearised = p.equilibrium.linearise(p.increment);
  return [&p, linearised] {
    if (linearised) p.equilibrium.apply_jacobian(p.direction, p.result);
    return linearised;
  };
}

template <int Dim>
std::function<bool()> start_preconditioner(Prepared<Dim>& p) {
  return [&p] {
    p.preconditioner.apply(p.direction, p.result);
    return true;
  };
}

template <int Dim>
void measure(benchmark::State& state, Subject<Dim>& subject, const Kernel<Dim>& kernel,
             int threads) {
  omp_set_num_threads(threads);
  Prepared<Dim>& prepared = subject();
  const auto work = kernel.start(prepared);
  if (!work()) {  // also fills the caches and lets the first call allocate
    state.SkipWithError("could not be evaluated");
    return;
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(work());
    benchmark::ClobberMemory();
  }
  report(state, static_cast<double>(prepared.model.size()), traffic_of(prepared).*kernel.bytes);
}

std::string name_of(std::string_view kernel, const std::string& body, int threads) {
  return std::string(kernel) + '/' + body + "/threads:" + std::to_string(threads);
}

template <int Dim>
void add_body(const Body& body, const Settings& settings) {
  const auto subject = std::make_shared<Subject<Dim>>(body, settings.settle_steps);
  const Kernel<Dim> kernels[] = {
      {"gather", &Traffic::gather, start_gather<Dim>},
      {"scatter", &Traffic::scatter, start_scatter<Dim>},
      {"residual", &Traffic::residual, start_residual<Dim>},
      {"linearise", &Traffic::linearise, start_linearise<Dim>},
      {"action", &Traffic::action, start_action<Dim>},
      {"preconditioner", &Traffic::preconditioner, start_preconditioner<Dim>},
  };
  for (const int threads : settings.threads) {
    const auto fitted = [subject, threads](benchmark::State& state) {
      // Three arrays that together are as large as the operator.
      const std::size_t bytes = (*subject)().equilibrium.moment_operator().bytes();
      measure_triad(state, bytes / static_cast<std::size_t>(Triad::bytes_per_element), threads);
    };
    benchmark::RegisterBenchmark(name_of("triad", body.name, threads).c_str(), fitted)
        ->UseRealTime();
    for (const Kernel<Dim>& kernel : kernels) {
      const auto run = [subject, kernel, threads](benchmark::State& state) {
        measure(state, *subject, kernel, threads);
      };
      benchmark::RegisterBenchmark(name_of(kernel.name, body.name, threads).c_str(), run)
          ->UseRealTime();
    }
  }
}

void add_all(const Settings& settings) {
  constexpr std::size_t large = (std::size_t{64} << 20U) / sizeof(double);  // 64 MB per array
  for (const int threads : settings.threads) {
    benchmark::RegisterBenchmark(
        name_of("triad", "large", threads).c_str(),
        [threads](benchmark::State& state) { measure_triad(state, large, threads); })
        ->UseRealTime();
  }
  for (const Body& body : bodies()) {
    if (dimension_of(*scene_of(body)) == 2) {
      add_body<2>(body, settings);
    } else {
      add_body<3>(body, settings);
    }
  }
}

/// Whole numbers of at least `least`, separated by commas; empty if it is anything else.
std::vector<int> whole_numbers(std::string_view text, int least) {
  std::vector<int> numbers;
  for (;;) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || number < least) return {};
    numbers.push_back(number);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (text.empty()) return numbers;
    if (text.front() != ',') return {};
    text.remove_prefix(1);
  }
}

bool read_arguments(int count, char** arguments, Settings& settings) {
  constexpr std::string_view threads = "--threads=";
  constexpr std::string_view settle = "--settle=";
  for (int k = 1; k < count; ++k) {
    const std::string_view argument = arguments[k];
    if (argument.starts_with(threads)) {
      settings.threads = whole_numbers(argument.substr(threads.size()), 1);
      if (!settings.threads.empty()) continue;
    } else if (argument.starts_with(settle)) {
      const auto steps = whole_numbers(argument.substr(settle.size()), 1);
      if (steps.size() == 1) {
        settings.settle_steps = steps.front();
        continue;
      }
    }
    std::fprintf(stderr, "fpm-bench: %s: expected --threads=1,2, --settle=10 or --help\n",
                 arguments[k]);
    return false;
  }
  return true;
}

}  // namespace
}  // namespace benchmarks

int main(int count, char** arguments) {
  benchmark::Initialize(&count, arguments);
  benchmarks::Settings settings;
  if (!benchmarks::read_arguments(count, arguments, settings)) return 2;
  try {
    benchmarks::add_all(settings);
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fpm-bench: %s\n", error.what());
    return 1;
  }
  benchmark::Shutdown();
  return 0;
}
