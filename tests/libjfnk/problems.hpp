#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "jfnk/options.hpp"
#include "jfnk/residual.hpp"

namespace jfnk_test {

using jfnk::Evaluation;
using jfnk::Vector;
using Sparse = Eigen::SparseMatrix<double>;

inline constexpr jfnk::Method all_methods[] = {jfnk::Method::newton_krylov,
                                               jfnk::Method::multisecant, jfnk::Method::hybrid};

/// A sparse Cholesky factorisation made once, as a preconditioner.
class CholeskyPreconditioner {
 public:
  explicit CholeskyPreconditioner(const Sparse& matrix) : factor_(matrix) {}
  void apply(const Vector& r, Vector& z) const { z = factor_.solve(r); }

 private:
  Eigen::SimplicialLLT<Sparse> factor_;
};

/// Five-point Laplacian of the unit square with m x m interior nodes, times h^2.
Sparse laplacian(int m);

/// -Laplace(u) = lambda exp(u) on the unit square, u = 0 around; times h^2, m x m unknowns.
/// With one exact Jacobian action for comparison.
class Bratu {
 public:
  Bratu(int m, double lambda);
  [[nodiscard]] int size() const { return m_ * m_; }
  void operator()(const Vector& u, Vector& r) const;

 protected:
  int m_;
  double weight_;  // lambda h^2
  Sparse laplacian_;
};

/// Bratu with its own Jacobian action.
class BratuWithJacobian : public Bratu {
 public:
  using Bratu::Bratu;
  void linearise(const Vector& u);
  void apply_jacobian(const Vector& v, Vector& Jv) const;

 private:
  Vector slope_;
};

/// Chandrasekhar's H-equation at albedo c by the midpoint rule (Kelley 1995, section 5.6);
/// u = sqrt of a negative number is out of its domain nowhere, but a zero denominator is.
class HEquation {
 public:
  HEquation(int n, double c) : n_(n), c_(c) {}
  [[nodiscard]] int size() const { return n_; }
  Evaluation operator()(const Vector& u, Vector& r) const;

 private:
  int n_;
  double c_;
};

/// Extended Rosenbrock function as a system (More, Garbow & Hillstrom 1981, no. 21).
struct Rosenbrock {
  void operator()(const Vector& u, Vector& r) const;
};

/// Powell's singular function (no. 13): the Jacobian at the root has rank 2.
struct PowellSingular {
  void operator()(const Vector& u, Vector& r) const;
};

/// Braced frame of elastic, perfectly plastic bars whose top is pushed aside: semismooth, and near
/// its collapse as ill-conditioned as plasticity is.
///
/// Unknowns: total displacements of the free nodes, 2 per node. The history (plastic strains) moves
/// on only by `accept`.
class PlasticTruss {
 public:
  /// columns x rows cells of unit size, Young's modulus 1, yield strain `yield`; beyond it the
  /// force grows by `hardening` times the strain (only for one step from rest).
  PlasticTruss(int columns, int rows, double yield, double hardening = 0.0);
  [[nodiscard]] int size() const { return free_; }
  /// Prescribed sideways displacement of the top from here on.
  void push(double displacement) { push_ = displacement; }
  Evaluation operator()(const Vector& u, Vector& r);
  [[nodiscard]] double reference_norm() const { return reaction_norm_; }
  /// Ends the step at u; returns the number of bars that yielded in it.
  int accept(const Vector& u);
  /// Stiffness of the elastic truss.
  [[nodiscard]] Sparse elastic_stiffness() const;

 private:
  struct Bar {
    int a;
    int b;
    double nx;
    double ny;
    double length;
    double plastic;
  };
  [[nodiscard]] double displacement(const Vector& u, int node, int axis) const;
  [[nodiscard]] double strain(const Vector& u, const Bar& bar) const;
  void add_bar(int a, int b);

  int columns_;
  int rows_;
  double yield_;
  double hardening_;
  double push_ = 0.0;
  int free_ = 0;
  double reaction_norm_ = 0.0;
  std::vector<int> index_;  // 2 per node: unknown, -1 fixed, -2 pushed
  std::vector<Bar> bars_;
};

}  // namespace jfnk_test
