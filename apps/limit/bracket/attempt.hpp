#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limit/certificate/lower_certificate.hpp"
#include "limit/certificate/upper_certificate.hpp"
#include "limit/mesh/mesh.hpp"
#include "limit/solver/cone_solver.hpp"

namespace limit::bracket {

/// Who is asked first; the other one is the fall-back.
enum class Engine { interior_point, ipopt };

struct BracketOptions {
  double gap = 0.02;           // wanted: (upper - lower) / their mean, > 0
  int max_triangles = 12000;   // of one mesh
  double max_seconds = 120.0;  // of processor time, for all attempts together
  int max_iterations = 300;    // of the solver, per attempt
  double solver_gap = 1e-5;    // at which the interior-point method ends, over the multiplier
  Engine engine = Engine::interior_point;
  bool wants_mechanism = false;  // a velocity field even where a turning block is a bound
  bool fall_back = true;         // ask the other engine, and other forms, where the first one fails
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
  double work = 0.0;                // of the solver, in operations, roughly
  std::optional<double> certified;  // the bound, if the certificate holds
  double proposed = 0.0;            // what the solver claims; not a number if nothing
  std::optional<double> factor{};   // that divided the strength, where one is sought
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

}  // namespace limit::bracket
