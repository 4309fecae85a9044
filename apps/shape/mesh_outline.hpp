#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "shape/mesh.hpp"
#include "shape/point.hpp"

namespace shape {

/// A polygon with holes.
struct Piece {
  Ring outline;             // counterclockwise
  std::vector<Ring> holes;  // clockwise
};

/// The group of a dimension that has a name.
[[nodiscard]] std::optional<int> find_group(const GmshMesh& mesh, int dimension,
                                            std::string_view name);

/// What the faces of a group cover: a polygon with holes for each part that hangs together by
/// edges, without the corners that lie on straight lines.
/// @throws GmshError where faces overlap
[[nodiscard]] std::vector<Piece> pieces_of(const GmshMesh& mesh, int group);

/// The polylines that the lines of a group are, closed ones with their first point as the last;
/// likewise without corners on straight lines.
[[nodiscard]] std::vector<std::vector<Point>> polylines_of(const GmshMesh& mesh, int group);

}  // namespace shape
