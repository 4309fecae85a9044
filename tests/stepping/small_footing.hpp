#pragma once

#include <omp.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "model/build.hpp"
#include "scene/reader.hpp"
#include "stepping/stepper.hpp"
#include "support/small_footing.hpp"

namespace stepping {

/// The small footing with settings as --set takes them, and what advances it.
struct SmallFooting {
  explicit SmallFooting(const std::vector<std::string>& settings = {},
                        const std::string& tables = "")
      : checked(read(settings, tables)),
        scene(*checked),
        model(model::build_model<2>(scene)),
        state(model::initial_state(model)),
        stepper(scene, model, state) {
    omp_set_num_threads(1);  // so few particles keep no more of them busy
  }
  SmallFooting(const SmallFooting&) = delete;
  SmallFooting& operator=(const SmallFooting&) = delete;

  static std::shared_ptr<const scene::Scene> read(const std::vector<std::string>& settings,
                                                  const std::string& tables) {
    const auto reading =
        scene::parse_scene(support::small_footing + tables, "small footing", settings);
    if (!reading.scene) throw std::runtime_error(reading.errors.front().text());
    return reading.scene;
  }

  const std::shared_ptr<const scene::Scene> checked;
  const scene::Scene& scene;
  model::Model<2> model;
  model::State<2> state;
  LoadStepper<2> stepper;
  double load = 0.0;  // of the plate, for a test to note [N/m]
};

}  // namespace stepping
