#include "jfnk/options.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "jfnk/solver.hpp"

namespace {

using jfnk::Options;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Bad {
  const char* field;
  std::function<void(Options&)> spoil;
};

const Bad bad_options[] = {
    {"tolerances.relative", [](Options& o) { o.tolerances.relative = 1.0; }},
    {"tolerances.relative", [](Options& o) { o.tolerances.relative = nan; }},
    {"tolerances.absolute", [](Options& o) { o.tolerances.absolute = -1.0; }},
    {"tolerances.absolute", [](Options& o) { o.tolerances.absolute = infinity; }},
    {"tolerances.step", [](Options& o) { o.tolerances.step = -0.1; }},
    {"max_iterations", [](Options& o) { o.max_iterations = 0; }},
    {"max_evaluations", [](Options& o) { o.max_evaluations = 0; }},
    {"krylov.restart", [](Options& o) { o.krylov.restart = 0; }},
    {"krylov.max_iterations", [](Options& o) { o.krylov.max_iterations = -3; }},
    {"krylov.forcing.initial", [](Options& o) { o.krylov.forcing.initial = 0.0; }},
    {"krylov.forcing.gamma", [](Options& o) { o.krylov.forcing.gamma = 1.5; }},
    {"krylov.forcing.alpha", [](Options& o) { o.krylov.forcing.alpha = 1.0; }},
    {"krylov.forcing.maximum", [](Options& o) { o.krylov.forcing.maximum = 1.0; }},
    {"krylov.forcing.end_game", [](Options& o) { o.krylov.forcing.end_game = nan; }},
    {"globalisation.factor", [](Options& o) { o.globalisation.factor = 1.0; }},
    {"globalisation.domain_factor", [](Options& o) { o.globalisation.domain_factor = 0.0; }},
    {"globalisation.max_cuts", [](Options& o) { o.globalisation.max_cuts = -1; }},
    {"globalisation.sufficient_decrease",
     [](Options& o) { o.globalisation.sufficient_decrease = 1.0; }},
    {"jacobian.noise", [](Options& o) { o.jacobian.noise = 0.0; }},
    {"jacobian.length_scale", [](Options& o) { o.jacobian.length_scale = -1.0; }},
    {"jacobian.length_scale",
     [](Options& o) { o.jacobian.step = jfnk::Jacobian::Step::length_scale; }},
    {"jacobian.max_attempts", [](Options& o) { o.jacobian.max_attempts = 0; }},
    {"multisecant.memory", [](Options& o) { o.multisecant.memory = 0; }},
    {"multisecant.patience", [](Options& o) { o.multisecant.patience = -1; }},
    {"multisecant.progress", [](Options& o) { o.multisecant.progress = 1.1; }},
    {"multisecant.rejection", [](Options& o) { o.multisecant.rejection = 1.0; }},
    {"multisecant.mixing", [](Options& o) { o.multisecant.mixing = 0.0; }},
    {"multisecant.max_condition", [](Options& o) { o.multisecant.max_condition = 1.1e6; }},
    {"multisecant.max_cuts", [](Options& o) { o.multisecant.max_cuts = -1; }},
    {"multisecant.wild", [](Options& o) { o.multisecant.wild = 1.0; }},
    {"multisecant.wild_patience", [](Options& o) { o.multisecant.wild_patience = 0; }},
    {"multisecant.given_patience", [](Options& o) { o.multisecant.given_patience = 0; }},
    {"globalisation.greatest_cut", [](Options& o) { o.globalisation.greatest_cut = 1.0; }},
    {"globalisation.least_cut", [](Options& o) { o.globalisation.least_cut = 0.6; }},
    {"globalisation.window", [](Options& o) { o.globalisation.window = 11; }},
    {"stagnation.window", [](Options& o) { o.stagnation.window = 1; }},
    {"stagnation.left", [](Options& o) { o.stagnation.left = 1.5; }},
    {"pseudo_transient.max_steps", [](Options& o) { o.pseudo_transient.max_steps = 0; }},
    {"pseudo_transient.gain", [](Options& o) { o.pseudo_transient.gain = nan; }},
    {"setup_cost", [](Options& o) { o.setup_cost = -1.0; }},
    {"u_scale[1]", [](Options& o) { o.u_scale = Eigen::Vector2d(1.0, 0.0); }},
    {"f_scale[0]", [](Options& o) { o.f_scale = Eigen::Vector2d(nan, 1.0); }},
    {"lower and upper", [](Options& o) { o.lower = Eigen::Vector2d(nan, 1.0); }},
    {"lower", [](Options& o) { o.lower = o.upper = Eigen::Vector2d(0.0, 1.0); }},
    {"learning.after", [](Options& o) { o.learning.after = 0; }},
    {"learning.after_preconditioned", [](Options& o) { o.learning.after_preconditioned = 0; }},
    {"learning.worth", [](Options& o) { o.learning.worth = -1.0; }},
    {"learning.worth", [](Options& o) { o.learning.worth = nan; }},
    {"learning.least_unknowns", [](Options& o) { o.learning.least_unknowns = 0; }},
    {"learning.most_rows", [](Options& o) { o.learning.most_rows = 0; }},
    {"learning.most_entries", [](Options& o) { o.learning.most_entries = 0.5; }},
    {"learning.most_entries", [](Options& o) { o.learning.most_entries = nan; }},
    {"learning.operations", [](Options& o) { o.learning.operations = 0.0; }},
    {"learning.operations", [](Options& o) { o.learning.operations = nan; }},
    {"hybrid.back_off", [](Options& o) { o.hybrid.back_off = 0.5; }},
    {"hybrid.rounds", [](Options& o) { o.hybrid.rounds = 0; }},
    {"hybrid.newton_steps", [](Options& o) { o.hybrid.newton_steps = 0; }},
    {"hybrid.final_newton_steps", [](Options& o) { o.hybrid.final_newton_steps = -1; }},
};

TEST(Options, PresetsAndDefaultsAreValid) {
  EXPECT_TRUE(jfnk::validate(Options{}).empty());
  EXPECT_TRUE(jfnk::validate(jfnk::appendix_a()).empty());
  EXPECT_TRUE(jfnk::validate(jfnk::hybrid()).empty());
  EXPECT_TRUE(jfnk::validate(jfnk::newton_krylov()).empty());
  EXPECT_TRUE(jfnk::validate(jfnk::plasticity()).empty());
}

TEST(Options, EachBadValueGivesOneMessageThatNamesIt) {
  for (const Bad& bad : bad_options) {
    Options options;
    bad.spoil(options);
    const auto messages = jfnk::validate(options);
    ASSERT_EQ(messages.size(), 1u) << bad.field;
    EXPECT_EQ(messages.front().rfind(bad.field, 0), 0u) << messages.front();
    EXPECT_NE(messages.front().find("must "), std::string::npos) << messages.front();
  }
}

TEST(Options, SolverRefusesThemWithAllMessages) {
  Options options;
  options.max_evaluations = -5;
  options.tolerances.relative = 2.0;
  try {
    const jfnk::Solver solver(options);
    FAIL() << "invalid options were accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "jfnk::Options: tolerances.relative = 2 must be in [0, 1);"
                 " max_evaluations = -5 must be at least 1");
  }
}

}  // namespace
