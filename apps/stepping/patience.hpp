#pragma once

namespace stepping {

/// Tells a run that gets nowhere from one that is only slow: every nominal increment of load gained
/// buys a number of attempts at a step, converged or cut back.
///
/// It is not part of the state: a run that is resumed starts with new patience, since something was
/// changed for it.
class Patience {
 public:
  /// @param attempts  granted per increment; 0: without end
  Patience(int attempts, double increment, double load)
      : granted_(attempts), increment_(increment), mark_(load) {}

  void attempted() { ++attempts_; }
  void reached(double load) {
    constexpr double round_off = 1e-9;
    if (load - mark_ < (1.0 - round_off) * increment_) return;
    mark_ = load;
    attempts_ = 0;
  }

  bool lost() const { return granted_ > 0 && attempts_ >= granted_; }
  int attempts() const { return attempts_; }  // since `mark`
  double mark() const { return mark_; }       // load parameter

 private:
  int granted_;
  double increment_;
  double mark_;
  int attempts_ = 0;
};

}  // namespace stepping
