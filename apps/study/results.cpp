#include "study/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "files/file_error.hpp"
#include "program/command_line.hpp"
#include "program/exit_code.hpp"
#include "study/failure.hpp"

namespace study {

namespace {

double sum_of(const Columns& table, std::string_view name) {
  const auto found = std::ranges::find(table.names, name);
  if (found == table.names.end()) return 0.0;
  const auto& values = table.values[static_cast<std::size_t>(found - table.names.begin())];
  return std::accumulate(values.begin(), values.end(), 0.0);
}

std::vector<convergence::Sample> samples_of(const Vary& vary, std::size_t key,
                                            const std::vector<std::size_t>& series,
                                            const std::vector<Result>& results, bool errors) {
  std::vector<convergence::Sample> samples;
  for (const std::size_t i : series) {
    const std::optional<double>& value = errors ? results[i].error : results[i].value;
    if (value) samples.push_back({vary.numbers[results[i].combination[key]], *value});
  }
  return samples;
}

std::string words_for_others(const std::vector<Vary>& varied, const Combination& combination,
                             std::size_t key) {
  std::vector<Vary> others;
  Combination rest;
  for (std::size_t k = 0; k < varied.size(); ++k) {
    if (k == key) continue;
    others.push_back(varied[k]);
    rest.push_back(combination[k]);
  }
  return words_for(others, rest);
}

}  // namespace

Result result_of(const campaign::Status& status, const Quantity& quantity) {
  Result result;
  result.digest = status.outcome.digest;
  result.exit_code = status.outcome.exit_code;
  result.cost = status.outcome.cost;
  result.obstacle = status.complaint;
  if (!status.outcome.finished()) {
    if (result.obstacle.empty()) result.obstacle = "not finished";
    return result;
  }
  try {
    // A run that did not converge has a curve as well, and may have passed what is asked for.
    const Columns table = read_columns(status.folder / "curve.csv");
    result.steps = static_cast<std::int64_t>(table.values[0].back());
    result.evaluations = static_cast<std::int64_t>(sum_of(table, "evaluations"));
    const bool failed = status.outcome.exit_code == to_int(program::ExitCode::not_converged);
    const bool whole = status.outcome.exit_code == 0 || quantity.kind == Quantity::Kind::at ||
                       (failed && is_of_a_failure(quantity));
    const Reading reading = value_in(table, quantity);
    result.no_such_column = reading.no_such_column;
    if (whole && reading.value && std::isfinite(*reading.value)) result.value = reading.value;
    if (result.value) result.obstacle.clear();
    if ((whole || reading.no_such_column) && !reading.value) result.obstacle = reading.obstacle;
  } catch (const files::FileError& failure) {
    if (result.obstacle.empty()) result.obstacle = failure.what();
  }
  return result;
}

Reference richardson_reference(const std::vector<Vary>& varied, std::size_t key,
                               const std::vector<Result>& results) {
  std::vector<convergence::Sample> samples;
  std::string why;
  for (const Result& result : results) {
    bool finest = true;
    for (std::size_t k = 0; k < varied.size(); ++k) {
      finest = finest && (k == key || result.combination[k] + 1 == varied[k].values.size());
    }
    if (finest && result.value) {
      samples.push_back({varied[key].numbers[result.combination[key]], *result.value});
    }
    if (finest && !result.value && why.empty()) why = ": " + result.obstacle;
  }
  if (samples.size() < 2) {
    throw program::UsageError(
        fmt::format("--reference richardson: {} of the runs along {} has a value; two are needed "
                    "at least{}",
                    samples.size(), varied[key].key, why));
  }
  const convergence::Extrapolation found = convergence::extrapolate(samples);
  std::string words =
      fmt::format("Richardson along {}, {}", varied[key].key, convergence::name_of(found.course));
  if (found.order) words += fmt::format(", order {:.2f}", *found.order);
  // What the finest value may be off, the limit may be off as well.
  return {found.limit, found.uncertainty, words};
}

void judge(std::vector<Result>& results, const Reference& reference) {
  for (Result& result : results) {
    result.on_front = false;
    result.error.reset();
    if (result.value) result.error = *result.value - reference.value;
  }
  const auto counts = [](const Result& one) { return one.error && one.cost.complete; };
  for (Result& result : results) {
    if (!counts(result)) continue;
    const double error = std::abs(*result.error);
    result.on_front = std::ranges::none_of(results, [&](const Result& other) {
      if (!counts(other)) return false;
      const double of_other = std::abs(*other.error);
      return of_other <= error && other.cost.cpu <= result.cost.cpu &&
             (of_other < error || other.cost.cpu < result.cost.cpu);
    });
  }
}

std::vector<Order> orders_of(const std::vector<Vary>& varied, const std::vector<Result>& results,
                             bool independent) {
  std::vector<Order> orders;
  std::vector<Combination> all;
  for (const Result& result : results) all.push_back(result.combination);
  for (std::size_t key = 0; key < varied.size(); ++key) {
    if (varied[key].numbers.size() < 2) continue;
    for (const std::vector<std::size_t>& series : series_along(varied, all, key)) {
      const auto values = samples_of(varied[key], key, series, results, false);
      if (values.size() < 2) continue;
      Order order{varied[key].key, words_for_others(varied, all[series.front()], key),
                  convergence::extrapolate(values), std::nullopt};
      if (independent) {
        order.slope =
            convergence::slope_of_errors(samples_of(varied[key], key, series, results, true));
      }
      orders.push_back(std::move(order));
    }
  }
  return orders;
}

}  // namespace study
