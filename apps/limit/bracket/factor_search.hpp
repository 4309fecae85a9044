#pragma once

#include <optional>

namespace limit::bracket {

/// Where a multiplier that falls as a factor grows, and is known at a few of them, is one. The
/// values may come from anywhere: what is found here is only what to try next. Between two of them
/// the multiplier's inverse is taken as linear in the factor, which it is for clay, in proportion,
/// and for an infinite slope, from tan(phi) / tan(beta) on.
class FactorSearch {
 public:
  /// @param first  where to begin
  /// @param reach  how far the root is from there at first sight, as a factor; what is not enclosed
  ///               by then is looked for further and further away
  explicit FactorSearch(double first, double reach = 3.0) : first_(first), reach_(reach) {}

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
    double factor, inverse;  // of the multiplier
    bool has_no_end;
  };
  void learn_slope(const Seen& now);
  [[nodiscard]] double enclosed_root() const;

  double first_, reach_;
  std::optional<Seen> carried_, failed_;  // the nearest to the root on either side
  double without_end_ = 1.0 / 3.0;  // where the inverse would be nothing, over the factor seen
  int again_ = 0;                   // times in a row that the same end of the enclosure has moved
  bool was_carried_ = false;        // the last one seen
};

}  // namespace limit::bracket
