#pragma once

#include <optional>

namespace limit::bracket {

/// Where a multiplier that falls as a factor grows, and is known at a few of them, is one. The
/// values may come from anywhere: what is found here is only what to try next.
class FactorSearch {
 public:
  explicit FactorSearch(double first) : first_(first) {}

  /// @param has_no_end  the multiplier is at least this, and was not followed any further
  void saw(double factor, double multiplier, bool has_no_end);

  /// The multiplier has become another one, whose root is about the last one's times `shift`.
  void begin_anew(double shift = 1.0);

  /// The factor at which the multiplier should be one; the first one if nothing is known.
  [[nodiscard]] double root() const;

  /// The root moved by a share of the way to the factor, of those that enclose it, that is carried
  /// or is not; the root itself unless it is enclosed.
  [[nodiscard]] double root_towards(bool carried, double share) const;

  /// How far the root may be from the nearer of the two factors that enclose it, as a share of it;
  /// infinite unless it is enclosed.
  [[nodiscard]] double width() const;

 private:
  struct Seen {
    double x, y;  // logarithms of factor and multiplier
    bool has_no_end;
  };
  [[nodiscard]] double enclosed_root() const;

  double first_;
  std::optional<Seen> carried_, failed_;  // the nearest to the root on either side
  double slope_ = -1.5;                   // of y over x, as far as it is known
  int stalled_ = 0;                       // times in a row that the enclosure was hardly narrowed
};

}  // namespace limit::bracket
