#include "tables/sample_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

namespace tables {
namespace {

// More would not be read and printed with a scene in good time.
constexpr std::size_t most_values = 1000000;

struct Line {
  std::size_t number = 0;
  std::vector<std::string_view> words;
};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blank = " \t\r";
  const auto first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

// Between commas, which may be next to each other, or between blanks.
std::vector<std::string_view> words_of(std::string_view line, bool by_commas) {
  std::vector<std::string_view> words;
  while (!line.empty()) {
    const auto end = std::min(line.find_first_of(by_commas ? "," : " \t\r"), line.size());
    const std::string_view word = trimmed(line.substr(0, end));
    if (by_commas || !word.empty()) words.push_back(word);
    const bool ends = end == line.size();
    line.remove_prefix(ends ? end : end + 1);
    if (by_commas && !ends && line.empty()) words.emplace_back();
  }
  return words;
}

std::vector<Line> lines_of(std::string_view text, bool by_commas) {
  std::vector<Line> lines;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const auto end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    line = trimmed(line.substr(0, line.find('#')));
    if (!line.empty()) lines.push_back({number, words_of(line, by_commas)});
  }
  return lines;
}

std::optional<double> number_of(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

std::string quoted(std::string_view word) {
  constexpr std::size_t longest = 40;
  return fmt::format("\"{}{}\"", word.substr(0, longest), word.size() > longest ? "..." : "");
}

std::string allowed_values(const Range& range) {
  return range.text().empty() ? "a number" : "a number " + range.text();
}

class GridReader {
 public:
  GridReader(std::string_view text, double factor, const Range& range)
      : lines_(lines_of(text, false)), factor_(factor), range_(range) {}

  Samples read() {
    read_head();
    Samples raster;
    raster.kind = Samples::Kind::raster;
    raster.columns = count("ncols");
    const std::size_t rows = count("nrows");
    if (raster.columns * rows > most_values) {
      throw SampleError(0, fmt::format("found {} x {} cells", raster.columns, rows),
                        fmt::format("allowed are at most {} cells", most_values));
    }
    set_place(raster);
    if (lines_.size() - at_ != rows) {
      throw SampleError(
          lines_.back().number,
          fmt::format("found {} rows of values, and nrows is {}", lines_.size() - at_, rows),
          "needed is one line of values for each row");
    }
    raster.values.resize(raster.columns * rows);
    for (std::size_t row = rows; row > 0; --row) read_row(raster, row - 1);
    return raster;
  }

 private:
  static constexpr const char* head_keys =
      "an ESRI ASCII grid begins with ncols, nrows, xllcorner or xllcenter, yllcorner or "
      "yllcenter, "
      "cellsize (or dx and dy)";

  void read_head() {
    constexpr std::array<std::string_view, 10> known{
        "ncols",     "nrows",    "xllcorner", "xllcenter", "yllcorner",
        "yllcenter", "cellsize", "dx",        "dy",        "nodata_value"};
    for (; at_ < lines_.size() && !number_of(lines_[at_].words.front()); ++at_) {
      const Line& line = lines_[at_];
      std::string key(line.words.front());
      std::ranges::transform(key, key.begin(), [](unsigned char c) { return std::tolower(c); });
      if (std::ranges::count(known, key) == 0) {
        throw SampleError(line.number, "found " + quoted(line.words.front()), head_keys);
      }
      const auto value = line.words.size() == 2 ? number_of(line.words[1]) : std::nullopt;
      if (!value) {
        throw SampleError(line.number, fmt::format("found {} without one number", key),
                          "needed is a key and its value");
      }
      head_[key] = *value;
    }
    if (lines_.empty()) throw SampleError(0, "found nothing in it", head_keys);
  }

  std::optional<double> told(const std::string& key) const {
    const auto found = head_.find(key);
    return found == head_.end() ? std::nullopt : std::optional(found->second);
  }
  double need(const std::string& key) const {
    if (const auto value = told(key)) return *value;
    throw SampleError(0, "found no " + key, head_keys);
  }
  std::size_t count(const std::string& key) const {
    const double value = need(key);
    if (value < 1.0 || value > static_cast<double>(most_values) || value != std::floor(value)) {
      throw SampleError(0, fmt::format("found {} = {:g}", key, value),
                        fmt::format("allowed is a whole number 1 .. {}", most_values));
    }
    return static_cast<std::size_t>(value);
  }

  void set_place(Samples& raster) const {
    for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
      const std::string axis = i == 0 ? "x" : "y";
      const auto width = told("d" + axis);
      raster.step[i] = width ? *width : need("cellsize");
      if (raster.step[i] <= 0.0) {
        throw SampleError(0, fmt::format("found cells {:g} wide along {}", raster.step[i], axis),
                          "allowed is a width of more than zero");
      }
      const auto corner = told(axis + "llcorner");
      raster.lower[i] = corner ? *corner + 0.5 * raster.step[i] : need(axis + "llcenter");
    }
  }

  void read_row(Samples& raster, std::size_t row) {
    const Line& line = lines_[at_++];
    if (line.words.size() != raster.columns) {
      throw SampleError(
          line.number,
          fmt::format("found {} values, and ncols is {}", line.words.size(), raster.columns),
          "needed is a value for each cell of the row");
    }
    for (std::size_t column = 0; column < raster.columns; ++column) {
      const auto value = number_of(line.words[column]);
      const bool is_missing = value && told("nodata_value") == value;
      if (!value || is_missing || !range_.holds(*value * factor_)) {
        throw SampleError(line.number,
                          fmt::format("found {}{} in column {}", quoted(line.words[column]),
                                      is_missing ? ", no data," : "", column + 1),
                          "allowed is " + allowed_values(range_));
      }
      raster.values[row * raster.columns + column] = *value * factor_;
    }
  }

  std::vector<Line> lines_;
  double factor_;
  const Range& range_;
  std::size_t at_ = 0;
  std::map<std::string, double> head_;
};

template <std::size_t Count>
std::vector<std::array<double, Count>> read_columns(std::string_view text, const SampleFile& file,
                                                    const Range& range) {
  const char* const columns = Count == 2 ? "lines of coordinate,value" : "lines of x,y,value";
  const auto lines = lines_of(text, true);
  std::vector<std::array<double, Count>> all;
  for (const Line& line : lines) {
    const bool names =
        &line == &lines.front() &&
        std::ranges::none_of(line.words, [](const auto& w) { return number_of(w).has_value(); });
    if (names && line.words.size() == Count) continue;
    if (line.words.size() != Count) {
      throw SampleError(line.number, fmt::format("found {} columns", line.words.size()),
                        fmt::format("needed are {}", columns));
    }
    auto& numbers = all.emplace_back();
    for (std::size_t i = 0; i < Count; ++i) {
      const auto number = number_of(line.words[i]);
      const double factor = i + 1 == Count ? file.factor : 1.0;
      if (!number || (i + 1 == Count && !range.holds(*number * factor))) {
        throw SampleError(
            line.number, fmt::format("found {} in column {}", quoted(line.words[i]), i + 1),
            i + 1 == Count ? "allowed is " + allowed_values(range) : "allowed is a number");
      }
      numbers[i] = *number * factor;
    }
    if (all.size() > most_values) {
      throw SampleError(line.number, "found more than a file may have",
                        fmt::format("allowed are at most {} lines", most_values));
    }
  }
  if (all.empty()) {
    throw SampleError(0, "found no values in it", fmt::format("needed are {}", columns));
  }
  return all;
}

}  // namespace

std::string objection(const Samples& samples, const Range& range) {
  for (std::size_t i = 0; i < samples.values.size(); ++i) {
    if (range.holds(samples.values[i])) continue;
    const auto [x, y] = samples.place(i);
    return samples.kind == Samples::Kind::table
               ? fmt::format("found {:g} at {} = {:g}", samples.values[i],
                             samples.axis == 0 ? "x" : "y", samples.coordinates[i])
               : fmt::format("found {:g} at ({:g}, {:g})", samples.values[i], x, y);
  }
  if (samples.kind == Samples::Kind::table) {
    if (samples.values.size() < 2) return "found a table of one line";
    const auto& at = samples.coordinates;
    const auto stuck = std::ranges::adjacent_find(at, [](double a, double b) { return a >= b; });
    if (stuck != at.end()) return fmt::format("found {:g} followed by {:g}", stuck[0], stuck[1]);
  }
  for (std::size_t i = 0; samples.kind == Samples::Kind::points && i < samples.values.size(); ++i) {
    const auto here = samples.place(i);
    for (std::size_t j = i + 1; j < samples.values.size() && samples.place(j)[0] == here[0]; ++j) {
      if (samples.place(j) == here) {
        return fmt::format("found two points at ({:g}, {:g})", here[0], here[1]);
      }
    }
  }
  return "";
}

Samples read_samples(std::string_view text, const SampleFile& file, const Range& range) {
  Samples samples;
  switch (file.kind) {
    case Samples::Kind::raster:
      samples = GridReader(text, file.factor, range).read();
      samples.nearest = file.nearest;
      return samples;
    case Samples::Kind::table:
      samples = table_samples(read_columns<2>(text, file, range), file.axis, file.below);
      break;
    case Samples::Kind::points:
      samples = point_samples(read_columns<3>(text, file, range));
      break;
  }
  if (const std::string found = objection(samples, range); !found.empty()) {
    throw SampleError(0, found,
                      file.kind == Samples::Kind::table
                          ? "allowed is a table of two lines or more whose coordinates rise"
                          : "allowed is one value in one place");
  }
  return samples;
}

}  // namespace tables
