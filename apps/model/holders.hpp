#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
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
/// that lies across the direction, or else an equal part of each. Opposite sides of a body that is
/// thinner than images reach have what their own images carry, and of the rest such parts.
template <int Dim>
class Holders {
 public:
  /// Places in the state's reactions, and what part of each is meant.
  struct Shares {
    std::vector<std::pair<Eigen::Index, double>> reaction, side_reaction;
  };

  Holders(const scene::Scene& scene, const Model<Dim>& model);

  /// Whether opposite sides hold the same unknowns, one of them by images: the state then keeps
  /// apart what each bears.
  [[nodiscard]] bool are_opposite() const;
  /// Of a support or a drive; none if it holds no unknowns, or nothing has that name.
  [[nodiscard]] Shares of(const std::string& name) const;
  /// Of all that holds a side of the box; what holds particles of no side counts where they are
  /// next to it.
  [[nodiscard]] Shares on(const scene::Scene& scene, const Model<Dim>& model,
                          scene::Side side) const;

 private:
  struct Holder {
    std::string name;
    std::optional<scene::Side> side;  // of the box
    std::optional<scene::Side>
        faces;              // likewise, or that which a plate on a level of its own faces
    bool anywhere = false;  // by particles of no side
    bool images = false;    // behind the side, but for particles on it
    std::set<Eigen::Index> by_particles{};  // unknowns that are not held by images
  };

  void add(Holder holder, const std::vector<Eigen::Index>& unknowns);
  [[nodiscard]] double share(Eigen::Index unknown, std::size_t holder) const;
  [[nodiscard]] bool are_opposite(Eigen::Index unknown) const;
  void add_share(Eigen::Index unknown, std::size_t holder, double part, Shares& shares) const;

  Eigen::Index particles_ = 0;
  std::vector<Holder> holders_;
  std::map<Eigen::Index, std::vector<std::size_t>> holding_;  // by unknown, ascending
};

}  // namespace model
