#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scene/choices.hpp"
#include "shape/outline.hpp"

namespace scene {

struct Scene;

/// Whether a side holds the body: particles are tied to it, where no support or mirror holds it.
[[nodiscard]] bool holds(OutlineKind kind);

/// The outline's sides on the faces of the box.
class OutlineFaces {
 public:
  OutlineFaces(const Scene& scene, const shape::Outline& outline)
      : scene_(scene), outline_(outline) {}

  /// The face that a piece of the outline is on.
  [[nodiscard]] std::optional<Side> face_of(const shape::OutlineSegment& segment) const;
  /// The sides that hold all there is on a face in one way; none, if they do not.
  [[nodiscard]] std::vector<std::size_t> holders_of(Side face) const;
  /// Of a face's holders: theirs, with the face where one of them holds others, too.
  [[nodiscard]] std::string name_of_holders(const std::vector<std::size_t>& sides, Side face) const;

 private:
  [[nodiscard]] std::size_t faces_of(std::size_t side) const;

  const Scene& scene_;
  const shape::Outline& outline_;
};

}  // namespace scene
