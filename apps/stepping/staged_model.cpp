#include "stepping/staged_model.hpp"

#include "equilibrium/equilibrium.hpp"
#include "model/build.hpp"
#include "model/carry.hpp"
#include "scene/stages.hpp"
#include "stepping/settle.hpp"

namespace stepping {

namespace {

// Where something bears a reaction, by particles or by their images.
template <int Dim>
std::vector<char> held_unknowns(const model::Model<Dim>& model) {
  std::vector<char> held = model.prescribed;
  const auto& planes = model.ghosts.planes();
  for (std::size_t p = 0; p < planes.size(); ++p) {
    if (planes[p].symmetry) continue;
    for (const fpm::Index a : model.ghosts.sources_of(p)) {
      for (int i = 0; i < Dim; ++i) {
        const bool holds = planes[p].held[static_cast<std::size_t>(i)];
        if (holds) held[static_cast<std::size_t>(i * model.size() + a)] = 1;
      }
    }
  }
  return held;
}

}  // namespace

template <int Dim>
StagedModel<Dim>::StagedModel(const scene::Scene& whole, std::size_t stage)
    : whole_(whole), first_(model_at_rest<Dim>(scene::scene_before_stages(whole))) {
  if (scene::changes_ground(whole) && first_.initial_stress.size() > 0) {
    model::State<Dim> state = model::initial_state(first_);
    rest_ = equilibrium::Equilibrium<Dim>(first_, state).balance();
  }
  build(stage);
}

template <int Dim>
void StagedModel<Dim>::build(std::size_t stage) {
  scene_ = scene::scene_of_stage(whole_, stage);
  if (!scene::changes_ground(whole_)) return;
  changed_ = model::build_model<Dim>(scene_);
  model::carry_initial_tractions(first_, *changed_);
  model::keep_consolidation(first_, *changed_);
  take_stress_at_rest();
}

// Of each particle what it was before the stages, whatever they have changed since; nothing of
// ground that they put down.
template <int Dim>
void StagedModel<Dim>::take_stress_at_rest() {
  const bool is_told = changed_->initial_stress.size() > 0;
  if (first_.initial_stress.size() == 0 || (scene::has_new_ground(whole_) && !is_told)) return;
  const auto source = model::same_particles(*changed_, first_);
  auto& stress = is_told ? changed_->initial_stress : changed_->stress_at_rest;
  stress.setZero(Eigen::NoChange, changed_->size());
  for (Eigen::Index a = 0; a < changed_->size(); ++a) {
    const fpm::Index b = source[static_cast<std::size_t>(a)];
    if (b >= 0) stress.col(a) = first_.initial_stress.col(b);
  }
}

template <int Dim>
bool StagedModel<Dim>::is_last() const {
  return scene_.course.stage + 1 >= scene::stage_count(whole_);
}

template <int Dim>
model::State<Dim> StagedModel<Dim>::initial_state() const {
  model::State<Dim> state = model::initial_state(first_);
  return changed_ ? model::carry_state(first_, state, *changed_, false, scene_.course.load_begin)
                  : state;
}

// By particle as the model at hand has them.
template <int Dim>
std::optional<equilibrium::InitialBalance<Dim>> StagedModel<Dim>::rest() const {
  if (!changed_) return std::nullopt;
  equilibrium::InitialBalance<Dim> here;
  if (rest_.load.size() == 0) return here;
  const Eigen::Index n = changed_->size(), first = first_.size();
  here.load.setZero(n * Dim);
  here.reaction.setZero(n, Dim);
  here.plane_force = rest_.plane_force;
  here.plane_force.resize(changed_->plane_drive.size(), fpm::Vector<Dim>::Zero());
  const bool thin = changed_->layout.thin;
  if (thin) here.side_reaction.setZero(Eigen::NoChange, n);
  const auto source = model::same_particles(*changed_, first_);
  const std::vector<char> held = held_unknowns(*changed_);
  for (Eigen::Index a = 0; a < n; ++a) {
    const fpm::Index b = source[static_cast<std::size_t>(a)];
    if (b < 0) continue;
    if (thin && rest_.side_reaction.cols() > 0)
      here.side_reaction.col(a) = rest_.side_reaction.col(b);
    for (int i = 0; i < Dim; ++i) {
      here.load[i * n + a] = rest_.load[i * first + b];
      if (held[static_cast<std::size_t>(i * n + a)] != 0)
        here.reaction(a, i) = rest_.reaction(b, i);
    }
  }
  return here;
}

template <int Dim>
std::unique_ptr<LoadStepper<Dim>> StagedModel<Dim>::stepper(model::State<Dim>& state) const {
  return std::make_unique<LoadStepper<Dim>>(scene_, model(), state, rest());
}

template <int Dim>
void StagedModel<Dim>::go_on(model::State<Dim>& state) {
  if (!changed_) {
    build(scene_.course.stage + 1);
    return;
  }
  const model::Model<Dim> before = std::move(*changed_);
  build(scene_.course.stage + 1);
  const scene::Stage& next = whole_.stage[scene_.course.stage];
  const bool keeps_rows = next.remove.empty() && next.place.empty() && next.release.empty() &&
                          next.hold.empty() && next.regions.empty();
  state = model::carry_state(before, state, *changed_, keeps_rows, scene_.course.load_begin);
}

template class StagedModel<2>;
template class StagedModel<3>;

}  // namespace stepping
