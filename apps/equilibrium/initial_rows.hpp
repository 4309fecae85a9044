#pragma once

#include <optional>

#include "model/model.hpp"
#include "model/state.hpp"

namespace equilibrium {

/// The rows of the initial configuration, whatever was re-searched since: those of the state, while
/// a run has not begun to change them, and else searched for anew.
template <int Dim>
class InitialRows {
 public:
  /// @param state  must outlive this
  InitialRows(const model::Model<Dim>& model, const model::State<Dim>& state) {
    const bool at_first = state.programme.step == 0 && state.programme.stage == 0;
    if (at_first && state.rows.size() == model.size() && state.rows.as_first_searched()) {
      of_state_ = &state.rows;
    } else {
      anew_.emplace(model.particles, model.ghosts, model.row_options);
    }
  }

  const fpm::Rows<Dim>& operator*() const { return of_state_ != nullptr ? *of_state_ : *anew_; }

 private:
  const fpm::Rows<Dim>* of_state_ = nullptr;
  std::optional<fpm::Rows<Dim>> anew_;
};

}  // namespace equilibrium
