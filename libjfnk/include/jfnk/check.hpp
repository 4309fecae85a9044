#pragma once

#include <string>
#include <vector>

#include "jfnk/misuse.hpp"
#include "jfnk/options.hpp"
#include "jfnk/residual.hpp"

namespace jfnk {

/// What `check` found out about a residual near one point.
struct CheckReport {
  bool evaluable = false;  ///< F has a finite value at u; nothing else is known if not
  /// F(u) comes out bit for bit the same after an evaluation elsewhere: no hidden state, no chance.
  bool repeatable = false;
  /// F(u) comes out the same when evaluated twice in a row; if this holds and `repeatable` does
  /// not, F remembers where it was (see `on_accept`).
  bool deterministic = false;
  double residual_norm = 0.0;  ///< ||F(u)||
  /// ||noise of F|| (ECNoise, Moré & Wild 2011); 0 if none was seen.
  double noise = 0.0;
  /// b for `Jacobian::noise` that fits the noise; the default if it does.
  double suggested_noise = 0.0;
  /// Order p of ||F(u + t v) - F(u) - t J v|| ~ t^p over the best decades: 2 for a right Jacobian
  /// action of a smooth F, 1 for a wrong one. With differences, the error of J v itself is in it.
  double taylor_order = 0.0;
  /// Largest ||J v - (F(u + t v) - F(u - t v)) / 2t|| / ||J v|| over the directions; of the
  /// residual's own action if it has one.
  double action_error = 0.0;
  /// Probes at 1e-8 ... 1e-1 of 1 + ||u|| in each direction and their share out of the domain.
  int probes = 0;
  int probes_out_of_domain = 0;
  /// Smallest distance at which a probe was out of the domain, over 1 + ||u||; infinite if none
  /// was.
  double distance_to_domain_edge = 0.0;
  int evaluations = 0;  ///< of F and of J v

  /// What is wrong or worth knowing, one sentence each; empty if nothing is.
  std::vector<std::string> findings;
  /// True if nothing was found that spoils a solve.
  bool good = false;
};

/// Looks at a residual around u before it is solved: does it repeat itself, is its Jacobian action
/// right, how noisy is it, how near is the end of its domain? Costs about 60 evaluations; u is not
/// changed. Scales of the options are used, bounds are not.
/// @param directions  random directions tried, at least 1
/// @throws std::invalid_argument if u is empty or the options are not valid
[[nodiscard]] CheckReport check(const ResidualRef& residual, const Vector& u,
                                const Options& options = {}, int directions = 3);

/// The same for anything that is a residual.
template <class F>
requires(!std::same_as<std::remove_cvref_t<F>, ResidualRef>) [[nodiscard]] CheckReport
    check(F&& residual, const Vector& u, const Options& options = {}, int directions = 3) {
  detail::explain_residual<std::remove_reference_t<F>, Vector>();
  return check(ResidualRef(residual), u, options, directions);
}

}  // namespace jfnk
