#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/model.hpp"
#include "scene/choices.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// Who holds the body at which unknowns, by the particles there or by images of them: the supports
/// and the drives of a scene. Where several hold one, as at a corner, the reaction there is shared,
/// so that all of them together are the force by which the body is held: it is that of the side
/// that lies across the direction, or else an equal part of each.
template <int Dim>
class Holders {
 public:
  /// Places in a field over unknowns, and what part of the reaction there is meant.
  using Shares = std::vector<std::pair<Eigen::Index, double>>;

  Holders(const scene::Scene& scene, const Model<Dim>& model);

  /// Of a support or a drive; none if it holds no unknowns, or nothing has that name.
  [[nodiscard]] Shares of(const std::string& name) const;
  /// Of all that holds a side of the box; what holds particles of no side counts where they are
  /// next to it.
  [[nodiscard]] Shares on(const scene::Scene& scene, const Model<Dim>& model,
                          scene::Side side) const;

 private:
  struct Holder {
    std::string name;
    std::optional<scene::Side> side;
    bool anywhere = false;  // by particles of no side
  };

  void add(Holder holder, const std::vector<Eigen::Index>& unknowns);
  [[nodiscard]] double share(Eigen::Index unknown, std::size_t holder) const;

  Eigen::Index particles_ = 0;
  std::vector<Holder> holders_;
  std::map<Eigen::Index, std::vector<std::size_t>> holding_;  // by unknown, ascending
};

}  // namespace model
