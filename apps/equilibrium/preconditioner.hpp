#pragma once

#include <variant>

#include "equilibrium/stiffness_factors.hpp"
#include "equilibrium/two_level_preconditioner.hpp"

namespace equilibrium {

/// One or the other approximate inverse of the stiffness, as a scene asks for it.
template <int Dim>
class Preconditioner {
 public:
  explicit Preconditioner(TwoLevelPreconditioner<Dim> two_level) : way_(std::move(two_level)) {}
  explicit Preconditioner(StiffnessFactors<Dim> factors) : way_(std::move(factors)) {}

  void apply(const Eigen::VectorXd& r, Eigen::VectorXd& z) {
    std::visit([&](auto& way) { way.apply(r, z); }, way_);
  }
  std::size_t bytes() const {
    return std::visit([](const auto& way) { return way.bytes(); }, way_);
  }

 private:
  std::variant<TwoLevelPreconditioner<Dim>, StiffnessFactors<Dim>> way_;
};

}  // namespace equilibrium
