#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "limit/bracket/attempt.hpp"
#include "limit/bracket/means.hpp"
#include "limit/problem/problem.hpp"
#include "limit/programme/parabolas.hpp"

namespace limit::bracket {

/// One side of the bracket: its mesh, and what refining it has brought.
class Side {
 public:
  /// For an upper bound without the corners of rigid ground that no velocity may leave.
  Side(problem::Problem problem, bool is_lower, Means means = {});

  [[nodiscard]] int triangles() const { return static_cast<int>(problem_.mesh.triangles.size()); }
  /// Relative gain of the last attempt for its work; infinite as long as it is not known. By work
  /// and not by time, so that what is refined next does not depend on what else a machine does.
  [[nodiscard]] double promise() const { return promise_; }
  /// Of the last attempt, in all its forms.
  [[nodiscard]] double work() const { return work_; }
  [[nodiscard]] bool can_refine() const { return !indicators_.empty(); }
  /// Attempts in a row without a good answer.
  [[nodiscard]] int failures() const { return failures_; }
  /// The same ground with other strengths, on the mesh as it is.
  void set_soils(const std::vector<problem::Soil>& soils);

  /// Bisects where the last attempt says that most of the flow is, until there are `growth` times
  /// as many triangles.
  void refine(double growth);

  /// Asks the solvers in turn until one has a good answer; what they certify is kept in the bracket
  /// if it is better than what is there, and each attempt is noted. A fall-back that has failed
  /// here is not asked again: it costs many times what the first solver does.
  void attempt(Bracket& bracket, const BracketOptions& options,
               const std::function<void(const Attempt&)>& watch);

 private:
  /// One form, and as often again as parabolas for curved envelopes are to follow the stresses.
  Attempt ask(solver::ConeForm form, bool is_first, Bracket& bracket, const BracketOptions& options,
              const std::function<void(const Attempt&)>& watch);
  [[nodiscard]] bool is_good(const Attempt& attempt, const std::optional<double>& before) const;
  [[nodiscard]] std::optional<double> best(const Bracket& bracket) const;
  void certify(Bracket& bracket, Attempt& attempt, const solver::ConeSolution& solution);

  problem::Problem problem_;
  bool is_lower_;
  Means means_;
  programme::Parabolas parabolas_;
  bool is_new_ = true;  // nothing is known of its stresses
  std::vector<double> indicators_;
  std::vector<solver::ConeForm> given_up_;
  int failures_ = 0;
  double work_ = 0.0;
  double promise_ = std::numeric_limits<double>::infinity();
};

}  // namespace limit::bracket
