#include "picture/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace picture {

namespace {

constexpr double width = 760.0, height = 520.0;  // [px]
constexpr double left = 90.0, right = 20.0, top = 40.0, bottom = 60.0;
constexpr std::array<std::string_view, 6> colours{"#1b4f8a", "#b3401e", "#3b7d3b",
                                                  "#7a4fa3", "#8a6d1b", "#444444"};
constexpr std::array<std::string_view, 6> dashes{"", "6 3", "2 3", "8 3 2 3", "10 4", "1 2"};

/// One axis: which values it shows, and where.
class Scale {
 public:
  Scale(const Axis& axis, double from, double to) : axis_(axis), from_(from), to_(to) {}

  void take(double value) {
    if (!shows(value)) return;
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }

  /// Room around what was taken.
  void settle() {
    if (low_ > high_) {  // nothing was taken
      low_ = axis_.logarithmic ? 0.1 : 0.0;
      high_ = 1.0;
    }
    constexpr double share = 0.05;
    if (axis_.logarithmic) {
      const double room = std::max(share * std::log(high_ / low_), 0.2);
      low_ *= std::exp(-room);
      high_ *= std::exp(room);
    } else {
      const double room = high_ > low_ ? share * (high_ - low_) : 0.5 * std::abs(high_) + 1e-300;
      low_ -= room;
      high_ += room;
    }
  }

  [[nodiscard]] bool shows(double value) const {
    return std::isfinite(value) && (!axis_.logarithmic || value > 0.0);
  }
  [[nodiscard]] double place(double value) const {
    const double share = axis_.logarithmic ? std::log(value / low_) / std::log(high_ / low_)
                                           : (value - low_) / (high_ - low_);
    return from_ + share * (to_ - from_);
  }
  [[nodiscard]] std::vector<double> ticks() const {
    return ticks_of(low_, high_, axis_.logarithmic);
  }

 private:
  const Axis& axis_;
  double from_, to_;  // [px]
  double low_ = std::numeric_limits<double>::max(), high_ = std::numeric_limits<double>::lowest();
};

class Drawing {
 public:
  explicit Drawing(const Picture& picture)
      : picture_(picture), x_(picture.x, left, width - right), y_(picture.y, height - bottom, top) {
    for (const Series& series : picture.series) {
      if (series.x.size() != series.y.size()) {
        throw std::invalid_argument(fmt::format("series {}: {} values of x, {} of y", series.name,
                                                series.x.size(), series.y.size()));
      }
      for (std::size_t i = 0; i < series.x.size(); ++i) {
        if (!x_.shows(series.x[i]) || !y_.shows(series.y[i])) continue;
        x_.take(series.x[i]);
        y_.take(series.y[i]);
      }
    }
    x_.settle();
    y_.settle();
  }

  std::string text() {
    add("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
        "viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\" font-size=\"12\">\n"
        "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
        width, height);
    axes();
    for (std::size_t i = 0; i < picture_.series.size(); ++i) draw(i);
    legend();
    out_ += "</svg>\n";
    return std::move(out_);
  }

 private:
  template <class... Parts>
  void add(fmt::format_string<Parts...> form, Parts&&... parts) {
    fmt::format_to(std::back_inserter(out_), form, std::forward<Parts>(parts)...);
  }

  void axes() {
    for (const double tick : x_.ticks()) {
      add("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"#ddd\"/>\n"
          "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4:.6g}</text>\n",
          x_.place(tick), top, height - bottom, height - bottom + 18.0, tick);
    }
    for (const double tick : y_.ticks()) {
      add("<line x1=\"{1}\" x2=\"{2}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\" stroke=\"#ddd\"/>\n"
          "<text x=\"{3}\" y=\"{4:.1f}\" text-anchor=\"end\">{5:.6g}</text>\n",
          y_.place(tick), left, width - right, left - 6.0, y_.place(tick) + 4.0, tick);
    }
    add("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#444\"/>\n",
        left, top, width - left - right, height - top - bottom);
    add("<text x=\"{}\" y=\"24\" text-anchor=\"middle\" font-size=\"15\">{}</text>\n", width / 2.0,
        escaped(picture_.title));
    add("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", (left + width - right) / 2.0,
        height - 16.0, escaped(picture_.x.label));
    const double middle = (top + height - bottom) / 2.0;
    add("<text x=\"20\" y=\"{0}\" text-anchor=\"middle\" transform=\"rotate(-90 20 {0})\">{1}"
        "</text>\n",
        middle, escaped(picture_.y.label));
  }

  void draw(std::size_t number) {
    const Series& series = picture_.series[number];
    const std::string_view colour = colours[number % colours.size()];
    std::string path;
    bool parted = true;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!x_.shows(series.x[i]) || !y_.shows(series.y[i])) {
        parted = true;
        continue;
      }
      const double x = x_.place(series.x[i]), y = y_.place(series.y[i]);
      path += fmt::format("{}{:.1f} {:.1f}", parted ? "M" : "L", x, y);
      parted = false;
      if (series.marks) {
        add("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"/>\n", x, y, colour);
      }
      if (i < series.labels.size() && !series.labels[i].empty()) {
        add("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"10\">{}</text>\n", x + 6.0, y - 5.0,
            escaped(series.labels[i]));
      }
    }
    if (series.line && !path.empty()) {
      add("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\" "
          "stroke-dasharray=\"{}\"/>\n",
          path, colour, dashes[number % dashes.size()]);
    }
  }

  void legend() {
    if (picture_.series.size() < 2) return;
    for (std::size_t i = 0; i < picture_.series.size(); ++i) {
      const double y = top + 16.0 + 16.0 * static_cast<double>(i);
      add("<text x=\"{}\" y=\"{}\" text-anchor=\"end\" fill=\"{}\">{} {}</text>\n",
          width - right - 8.0, y, colours[i % colours.size()], escaped(picture_.series[i].name),
          picture_.series[i].line ? "—" : "•");
    }
  }

  const Picture& picture_;
  Scale x_, y_;
  std::string out_;
};

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

std::vector<double> ticks_of(double low, double high, bool logarithmic) {
  std::vector<double> ticks;
  if (logarithmic) {
    const int first = static_cast<int>(std::floor(std::log10(low)));
    const int last = static_cast<int>(std::ceil(std::log10(high)));
    constexpr int few = 2;  // decades, between whose powers 2 and 5 are shown as well
    const bool fine = last - first <= few + 1;
    for (int power = first; power <= last; ++power) {
      for (const double factor : {1.0, 2.0, 5.0}) {
        const double tick = factor * std::pow(10.0, power);
        if (tick >= low && tick <= high && (fine || factor == 1.0)) ticks.push_back(tick);
      }
    }
    return ticks;
  }
  constexpr double wanted = 6.0;
  const double raw = (high - low) / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  double stride = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (raw <= factor * power) stride = factor * power;
  }
  // Of a range that is nothing beside its place, numbers cannot tell the ends apart.
  const double first = std::ceil(low / stride);
  constexpr double most = 20.0;
  for (double i = 0.0; i < most && (first + i) * stride <= high; i += 1.0) {
    ticks.push_back(first + i == 0.0 ? 0.0 : (first + i) * stride);
  }
  return ticks;
}

std::string svg_text(const Picture& picture) {
  return Drawing(picture).text();
}

}  // namespace picture
