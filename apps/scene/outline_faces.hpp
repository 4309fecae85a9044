#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scene/choices.hpp"
#include "shape/outline.hpp"

namespace scene {

struct Scene;
struct ElementBody;

/// A piece of the surface of all regions together: its side, and the face of the box that it is on.
struct OuterPiece {
  std::size_t side = 0;
  std::optional<Side> face;
};
[[nodiscard]] std::vector<OuterPiece> outer_pieces(const Scene& scene,
                                                   const shape::Outline& outline);
[[nodiscard]] std::vector<OuterPiece> outer_pieces(const Scene& scene, const ElementBody& body);
/// Of a completed scene.
[[nodiscard]] std::vector<OuterPiece> outer_pieces(const Scene& scene);

/// Indices of the regions whose surface a side is.
[[nodiscard]] std::vector<std::size_t> regions_at(const Scene& scene, std::size_t side);

/// Names of the surfaces that particles are tied to: cutouts and sides that hold the body where no
/// support or mirror does.
[[nodiscard]] std::vector<std::string> tied_surfaces(const Scene& scene);

/// The sides of regions on the faces of the box.
class OutlineFaces {
 public:
  OutlineFaces(const Scene& scene, std::vector<OuterPiece> pieces)
      : scene_(scene), pieces_(std::move(pieces)) {}

  /// The sides that hold all there is on a face in one way; none, if they do not.
  [[nodiscard]] std::vector<std::size_t> holders_of(Side face) const;
  /// Of a face's holders: theirs, with the face where one of them holds others, too.
  [[nodiscard]] std::string name_of_holders(const std::vector<std::size_t>& sides, Side face) const;

 private:
  [[nodiscard]] std::size_t faces_of(std::size_t side) const;

  const Scene& scene_;
  std::vector<OuterPiece> pieces_;
};

}  // namespace scene
