#include "study/grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "program/command_line.hpp"

namespace study {

namespace {

std::vector<std::string> values_in(std::string_view text) {
  std::vector<std::string> values(1);
  int depth = 0;
  char quote = 0;
  for (const char c : text) {
    if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',' && depth == 0) {
      values.emplace_back();
      continue;
    }
    values.back() += c;
  }
  return values;
}

std::vector<double> positive_numbers(const std::vector<std::string>& values) {
  std::vector<double> numbers;
  for (const std::string& value : values) {
    double number = 0.0;
    const char* end = value.data() + value.size();
    const auto [stop, failure] = std::from_chars(value.data(), end, number);
    if (failure != std::errc{} || stop != end || !(number > 0.0) || !std::isfinite(number)) {
      return {};
    }
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

Vary parse_vary(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    throw program::UsageError(
        fmt::format("--vary {}: the form is KEY=V1,V2,..., as geometry.spacing=0.04,0.02", text));
  }
  Vary vary{text.substr(0, equals), values_in(std::string_view(text).substr(equals + 1)), {}};
  vary.numbers = positive_numbers(vary.values);
  for (std::size_t i = 0; i < vary.values.size(); ++i) {
    if (vary.values[i].empty()) {
      throw program::UsageError(fmt::format("--vary {}: a value is missing", text));
    }
    const auto same = [&](std::size_t j) {
      return vary.numbers.empty() ? vary.values[i] == vary.values[j]
                                  : vary.numbers[i] == vary.numbers[j];
    };
    for (std::size_t j = 0; j < i; ++j) {
      if (!same(j)) continue;
      throw program::UsageError(fmt::format("--vary {}: {} is there twice", text, vary.values[i]));
    }
  }
  return vary;
}

std::vector<Combination> all_combinations(const std::vector<Vary>& varied) {
  std::vector<Combination> all{Combination{}};
  for (const Vary& vary : varied) {
    std::vector<Combination> longer;
    for (const Combination& begun : all) {
      for (std::size_t i = 0; i < vary.values.size(); ++i) {
        longer.push_back(begun);
        longer.back().push_back(i);
      }
    }
    all = std::move(longer);
  }
  return all;
}

std::vector<std::string> settings_of(const std::vector<Vary>& varied,
                                     const Combination& combination) {
  std::vector<std::string> settings;
  for (std::size_t k = 0; k < varied.size(); ++k) {
    settings.push_back(varied[k].key + "=" + varied[k].values[combination[k]]);
  }
  return settings;
}

std::string words_for(const std::vector<Vary>& varied, const Combination& combination) {
  std::string words;
  for (std::size_t k = 0; k < varied.size(); ++k) {
    const std::string& key = varied[k].key;
    words += fmt::format("{}{}={}", k == 0 ? "" : " ", key.substr(key.rfind('.') + 1),
                         varied[k].values[combination[k]]);
  }
  return words;
}

std::vector<std::vector<std::size_t>> series_along(const std::vector<Vary>& varied,
                                                   const std::vector<Combination>& all,
                                                   std::size_t key) {
  std::map<Combination, std::vector<std::size_t>> by_others;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Combination others = all[i];
    others[key] = varied[key].values.size();
    by_others[others].push_back(i);
  }
  std::vector<std::vector<std::size_t>> series;
  for (auto& entry : by_others) series.push_back(std::move(entry.second));
  return series;
}

}  // namespace study
