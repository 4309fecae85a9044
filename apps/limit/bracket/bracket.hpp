#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "limit/certificate/lower_certificate.hpp"
#include "limit/certificate/upper_certificate.hpp"
#include "limit/problem/case.hpp"
#include "limit/solver/cone_solver.hpp"

namespace limit::bracket {

/// Who is asked first; the other one is the fall-back.
enum class Engine { interior_point, ipopt };

struct BracketOptions {
  double gap = 0.02;           // wanted: (upper - lower) / their mean, > 0
  int max_triangles = 12000;   // of one mesh
  double max_seconds = 120.0;  // of processor time, for all attempts together
  int max_iterations = 300;    // of the solver, per attempt
  Engine engine = Engine::interior_point;
  bool fall_back = true;  // ask the other engine, and other forms, where the first one fails
};

/// One attempt at one bound.
struct Attempt {
  bool is_lower = true;
  int triangles = 0;
  solver::ConeForm form = solver::ConeForm::cones;
  solver::SolverStatus status = solver::SolverStatus::failed;
  std::string message;  // the solver's
  int iterations = 0;
  double seconds = 0.0;             // of processor time, certificate included
  std::optional<double> certified;  // the bound, if the certificate holds
  double proposed = 0.0;            // what the solver claims; not a number if nothing
};

/// A certified bound, the mesh it was found on and the attempt that found it.
template <class Certificate>
struct Bound {
  mesh::Mesh mesh;
  Attempt attempt;
  Certificate certificate;
};

/// The best bounds found, in the problem's units.
struct Bracket {
  std::optional<Bound<certificate::LowerCertificate>> lower;
  std::optional<Bound<certificate::UpperCertificate>> upper;
  std::vector<Attempt> attempts;
  bool reached = false;  // both certified and no further apart than asked

  [[nodiscard]] double lower_bound() const;  // less than the certified one by rounding's share
  [[nodiscard]] double upper_bound() const;
  /// (upper - lower) / their mean; infinite unless both are there and the mean is positive.
  [[nodiscard]] double gap() const;
};

/// Brackets the multiplier: solves and certifies a bound on each side, then refines in turn, where
/// the soil flows most, the side whose last refinement brought more for its time, until the gap is
/// reached or the budget spent. The best certified bound of each side is kept, so that no
/// refinement loosens the bracket. An attempt that fails is repeated with another form of the
/// cones, and so by another solver.
/// @param lower, upper  the same problem in units of order one, on the meshes to begin with
/// @param watch  told of every attempt as it ends
[[nodiscard]] Bracket bracket(problem::Problem lower, problem::Problem upper,
                              const BracketOptions& options,
                              const std::function<void(const Attempt&)>& watch = {});

/// Brackets a case in its units. The bracket's multiplier times `units.multiplier()` is the answer.
[[nodiscard]] Bracket bracket(const problem::Case& problem, const BracketOptions& options,
                              const std::function<void(const Attempt&)>& watch);

}  // namespace limit::bracket
