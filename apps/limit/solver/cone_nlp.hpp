#pragma once

#include <IpTNLP.hpp>

#include "limit/solver/cone_solution.hpp"
#include "limit/solver/scaled_program.hpp"

namespace limit::solver {

/// A cone program as Ipopt wants it: scaled, minimised, with the cones in one of their forms.
class ConeNlp : public Ipopt::TNLP {
 public:
  ConeNlp(const programme::ConeProgram& program, ConeForm form);

  /// Weight of the logarithmic barrier, for the form that has one.
  double barrier = 0.0;

  /// In the units of the program.
  [[nodiscard]] Eigen::VectorXd variables() const { return program_.variables(point_); }
  [[nodiscard]] Eigen::VectorXd multipliers() const { return program_.multipliers(dual_); }
  [[nodiscard]] double objective() const { return -program_.cost.dot(point_); }

  bool get_nlp_info(Ipopt::Index& n, Ipopt::Index& m, Ipopt::Index& jacobian_entries,
                    Ipopt::Index& hessian_entries, IndexStyleEnum& style) override;
  bool get_bounds_info(Ipopt::Index n, Ipopt::Number* lower, Ipopt::Number* upper, Ipopt::Index m,
                       Ipopt::Number* constraint_lower, Ipopt::Number* constraint_upper) override;
  bool get_starting_point(Ipopt::Index n, bool init_x, Ipopt::Number* x, bool init_z,
                          Ipopt::Number* z_lower, Ipopt::Number* z_upper, Ipopt::Index m,
                          bool init_lambda, Ipopt::Number* lambda) override;
  bool eval_f(Ipopt::Index n, const Ipopt::Number* x, bool new_x, Ipopt::Number& value) override;
  bool eval_grad_f(Ipopt::Index n, const Ipopt::Number* x, bool new_x,
                   Ipopt::Number* gradient) override;
  bool eval_g(Ipopt::Index n, const Ipopt::Number* x, bool new_x, Ipopt::Index m,
              Ipopt::Number* values) override;
  bool eval_jac_g(Ipopt::Index n, const Ipopt::Number* x, bool new_x, Ipopt::Index m,
                  Ipopt::Index entries, Ipopt::Index* rows, Ipopt::Index* columns,
                  Ipopt::Number* values) override;
  bool eval_h(Ipopt::Index n, const Ipopt::Number* x, bool new_x, Ipopt::Number objective_factor,
              Ipopt::Index m, const Ipopt::Number* lambda, bool new_lambda, Ipopt::Index entries,
              Ipopt::Index* rows, Ipopt::Index* columns, Ipopt::Number* values) override;
  void finalize_solution(Ipopt::SolverReturn status, Ipopt::Index n, const Ipopt::Number* x,
                         const Ipopt::Number* z_lower, const Ipopt::Number* z_upper, Ipopt::Index m,
                         const Ipopt::Number* constraints, const Ipopt::Number* lambda,
                         Ipopt::Number value, const Ipopt::IpoptData* data,
                         Ipopt::IpoptCalculatedQuantities* quantities) override;

 private:
  [[nodiscard]] bool has_rows() const { return form_ != ConeForm::barrier; }

  ConeForm form_;
  ScaledProgram program_;
  Eigen::VectorXd point_, dual_;  // scaled; the next start
};

}  // namespace limit::solver
