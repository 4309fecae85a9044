#pragma once

#include "model/model.hpp"
#include "model/state.hpp"

namespace model {

/// Calls visit(support, target) for each support by penalty, with the displacement [m] at which it
/// holds its points: none, or that with which it began in a stage.
template <int Dim, class Visitor>
void for_each_penalty(const Model<Dim>& model, const State<Dim>& state, Visitor&& visit) {
  Eigen::Index first = 0;
  for (const PenaltySupport<Dim>& support : model.penalty_supports) {
    const Eigen::Index count = support.points.weight.size();
    if (state.penalty_target.rows() == 0) {
      visit(support, fpm::FieldView<Dim>(support.target));
    } else {
      visit(support, fpm::FieldView<Dim>(state.penalty_target.middleRows(first, count)));
    }
    first += count;
  }
}

}  // namespace model
