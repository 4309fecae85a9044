#pragma once

#include <vector>

#include "study/fineness.hpp"

namespace study {

/// What the runs of a ladder took, and what others are expected to take.
class Expense {
 public:
  /// @param spacings  [m] of the levels
  /// @param growth    a run costs (coarse / fine)^growth times as much
  Expense(const std::vector<double>& spacings, double growth)
      : spacings_(spacings), growth_(growth) {}

  /// @return false if it was known: a run is paid once
  bool note(const Fineness& fineness, double seconds);

  [[nodiscard]] bool knows(const Fineness& fineness) const;
  /// Processor time of a run [s], after the most similar one that was made; 0 before the first.
  [[nodiscard]] double expected(const Fineness& fineness) const;
  [[nodiscard]] double spent() const { return spent_; }

 private:
  struct Paid {
    Fineness fineness;
    double seconds = 0.0;
  };
  [[nodiscard]] double ratio(const Fineness& to, const Fineness& from) const;

  const std::vector<double>& spacings_;
  double growth_;
  std::vector<Paid> paid_;
  double spent_ = 0.0;
};

}  // namespace study
