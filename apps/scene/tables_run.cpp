#include "scene/names.hpp"
#include "scene/scene.hpp"
#include "scene/tables.hpp"
#include "tables/builder.hpp"

namespace scene {

namespace {

SceneTable programme() {
  return tables::TableBuilder<Scene, Programme>("programme", &Scene::programme,
                                                "How the drive is cut into steps.")
      .key("steps", &Programme::steps,
           {.need = tables::Need::optional,
            .range = tables::at_least(0),
            .doc = "Nominal number of equal steps; 0: from increment_over_spacing.",
            .absent = "as 0"})
      .key("increment_over_spacing", &Programme::increment_over_spacing,
           {.range = {0.0, 1.0, true, false},
            .doc = "Nominal displacement per step over spacing, when steps is absent. Small steps "
                   "are cheaper: the cost per step falls faster than their number grows."})
      .key("minimum_increment_ratio", &Programme::minimum_increment_ratio,
           {.range = {0.0, 1.0, true, false},
            .doc = "Smallest step over the nominal one; a step that fails there is the end."})
      .key("maximum_increment_ratio", &Programme::maximum_increment_ratio,
           {.range = tables::positive(), .doc = "Largest step over the nominal one."})
      .key("growth", &Programme::growth,
           {.range = {1.0, 10.0, true, false},
            .doc = "Factor by which an easy stretch enlarges the step; a failure halves it."})
      .key(
          "easy_steps", &Programme::easy_steps,
          {.range = tables::at_least(1), .doc = "Easy steps in a row before the step is enlarged."})
      .key("easy_evaluations", &Programme::easy_evaluations,
           {.range = tables::at_least(0),
            .doc = "A step is easy below this many evaluations of residual and Jacobian action."})
      .key("hard_evaluations", &Programme::hard_evaluations,
           {.range = tables::at_least(1),
            .doc = "Above this many evaluations the next step is halved."})
      .key(
          "patience", &Programme::patience,
          {.range = tables::at_least(0),
           .doc = "A run is given up as hopeless when so many attempts at a step, converged or cut "
                  "back, have not gained one nominal step; 0: never."})
      .key("stop_at_failure", &Programme::stop_at_failure,
           {.doc = "A step that fails at the smallest increment ends the run: true, with exit code "
                   "3; false, with code 0, its last state being the result (a load driven to "
                   "collapse)."})
      .build();
}

SceneTable solver() {
  return tables::TableBuilder<Scene, Solver>("solver", &Scene::solver,
                                             "The nonlinear solver of each step.")
      .key(
          "preset", &Solver::preset,
          {.doc = "default: hybrid, analytic Jacobian action, two_level. appendix_a: the paper's "
                  "Newton-GMRES with differences and no preconditioner. Keys below that are absent "
                  "are the preset's.",
           .source = "Chen, Huang & Lyamin 2020, Appendix A"})
      .key("tolerance", &Solver::tolerance,
           {.need = tables::Need::optional,
            .range = {0.0, 0.01, true, false},
            .doc = "A step is converged when |r_free| <= tolerance max(|r_prescribed|, |f_ext|), "
                   "2-norms. 3e-4 costs about twice 1e-3 and takes the load 0.25 % lower. Where "
                   "ground fails under a load that grows, by its strength or by what a stage does, "
                   "what is left unbalanced of all of it bears part of what fails: 1e-3 some per "
                   "cent.",
            .absent = "1e-3; 1e-4 where what yields or slides by contact is under a load that "
                      "grows, its strength is divided, or a stage digs, fills, releases, floods, "
                      "shakes or changes it"})
      .key("method", &Solver::method,
           {.need = tables::Need::optional,
            .doc =
                "hybrid: multisecant with Newton rescue; conjugate gradients where the residual is "
                "linear, of elastic bodies of small strains.",
            .absent = "the preset's"})
      .key("jacobian", &Solver::jacobian,
           {.need = tables::Need::optional,
            .doc = "Jacobian action by the materials' tangents or by differences of the residual.",
            .absent = "the preset's"})
      .key("preconditioner", &Solver::preconditioner,
           {.need = tables::Need::optional,
            .doc = "two_level: elastic blocks of the particles plus an elastic background grid. "
                   "factors: Cholesky factors of the elastic stiffness of the particles, for the "
                   "plane or few particles.",
            .absent = "the preset's; in the plane factors where some poissons_ratio is above 0.49, "
                      "of elastic bodies in a box of at most 5 000 cells above 0.45 or where a "
                      "side aslant is held, and, of at most 20 000, where a [[region]] has a "
                      "corner sharper than 40 degrees or a body that is no box is in contact"})
      .key("coarse_spacing_over_spacing", &Solver::coarse_spacing_over_spacing,
           {.range = tables::between(1.0, 20.0),
            .doc = "two_level: spacing of the background grid."})
      .key(
          "max_evaluations_per_step", &Solver::max_evaluations_per_step,
          {.range = tables::at_least(10),
           .doc = "A step that needs more evaluations of residual and Jacobian action has failed."})
      .build();
}

SceneTable re_search() {
  return tables::TableBuilder<Scene, ReSearch>(
             "re_search", &Scene::re_search,
             "Local re-search: rows of strongly sheared particles get new "
             "neighbours; stress and history stay on the particles.")
      .formerly("research")
      .key("enabled", &ReSearch::enabled,
           {.doc = "Re-search at all; finite_strain only.",
            .source = "Chen, Huang & Lyamin 2020, section 4.3"})
      .key("trigger", &ReSearch::trigger,
           {.range = tables::positive(),
            .doc = "Equivalent plastic strain gained since the last search, of any row, at which a "
                   "re-search happens."})
      .key("hysteresis", &ReSearch::hysteresis,
           {.range = {0.0, 1.0, true, false},
            .doc = "At a re-search, rows above hysteresis x trigger are rebuilt."})
      .build();
}

SceneTable output() {
  return tables::TableBuilder<Scene, Output>("output", &Scene::output,
                                             "What is written, where and how often.")
      .key("directory", &Output::directory,
           {.need = tables::Need::optional,
            .doc = "Output folder, from where the program is started; --out goes first.",
            .absent = "out/ and the scene file's name without its ending"})
      .key("frames_every", &Output::frames_every,
           {.range = tables::at_least(0),
            .doc = "Converged steps between frames for ParaView; 0: none."})
      .key("checkpoints_every", &Output::checkpoints_every,
           {.range = tables::at_least(0),
            .doc = "Converged steps between checkpoints; 0: not by steps. There is always one of "
                   "the start, of the end, and of a run that is stopped."})
      .key("checkpoints_every_minutes", &Output::checkpoints_every_minutes,
           {.unit = "min",
            .range = tables::at_least(0.0),
            .doc = "Minutes after which the next converged step has a checkpoint in any case; 0: "
                   "not by time."})
      .key("checkpoints_kept", &Output::checkpoints_kept,
           {.range = tables::at_least(1), .doc = "Newest checkpoints kept."})
      .key("checkpoints_kept_every", &Output::checkpoints_kept_every,
           {.range = tables::at_least(0),
            .doc = "Besides, the first checkpoint at or after each multiple of so many steps is "
                   "kept for good; 0: none."})
      .key("compression", &Output::compression,
           {.range = tables::between(0, 9),
            .doc = "Of checkpoints and frames: 0 none, 1 fast .. 9 small."})
      .key("fields", &Output::fields,
           {.need = tables::Need::optional,
            .doc = "Particle fields in the frames.",
            .absent = "all"})
      .among(output_field_names)
      .build();
}

SceneTable limit() {
  return tables::TableBuilder<Scene, Limit>(
             "limit", &Scene::limit,
             "A footing's run held against the bounds of its collapse load, "
             "which fpm-limit computes meanwhile.")
      .key("check", &Limit::check,
           {.doc = "Start fpm-limit beside the run, keep its bracket in limit.json, and say in the "
                   "end how the plateau of the curve lies to it."})
      .key("gap", &Limit::gap,
           {.range = {0.0, 1.0, true, true},
            .doc = "Wanted distance of the bounds, over their mean."})
      .key("max_seconds", &Limit::max_seconds,
           {.unit = "s",
            .range = tables::positive(),
            .doc = "Processor time after which the best bounds so far are taken."})
      .build();
}

}  // namespace

std::vector<SceneTable> run_tables() {
  return {programme(), solver(), re_search(), output(), limit()};
}

}  // namespace scene
