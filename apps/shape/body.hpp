#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

namespace shape {

using Point = Eigen::Vector2d;
using Ring = std::vector<Point>;  ///< corners of a polygon, either way around, not closed

/// What is taken from a box: what is inside a ring, or outside it.
struct Cut {
  Ring ring;
  bool outside = false;
};

/// A straight piece of a surface; the body is to the left of it.
struct SurfaceSegment {
  Point from, to;
  /// Which cut made it; of the box's own faces -1 left, -2 right, -3 bottom, -4 top.
  int source = 0;
};

/// What of a box is in a body.
struct Part {
  double area = 0.0;
  Point centroid = Point::Zero();
};

/// What of a straight line is in a body.
struct Stretch {
  double length = 0.0;
  Point middle = Point::Zero();
};

/// The corners of a circle, on it, and so many that no chord is further from it than `sagitta`.
[[nodiscard]] Ring circle(const Point& centre, double radius, double sagitta);

/// What is wrong with a ring, in words; empty if it is a simple polygon.
[[nodiscard]] std::string objection(const Ring& ring);

/// A box with parts cut out, in the plane.
class Body {
 public:
  /// @throws std::invalid_argument naming the ring by its place if `objection` has one
  Body(const Point& lower, const Point& upper, const std::vector<Cut>& cuts);
  ~Body();
  Body(Body&&) noexcept;
  Body& operator=(Body&&) noexcept;

  [[nodiscard]] double area() const;
  /// Number of pieces that do not hang together.
  [[nodiscard]] std::size_t pieces() const;

  [[nodiscard]] Part within(const Point& lower, const Point& upper) const;
  [[nodiscard]] Stretch along(const Point& from, const Point& to) const;
  [[nodiscard]] const std::vector<SurfaceSegment>& surface() const;
  /// Distance of a box from the surface that the cuts made, not from the faces of the body's box.
  [[nodiscard]] double distance_to_cuts(const Point& lower, const Point& upper) const;

 private:
  struct Shape;
  std::unique_ptr<Shape> shape_;
};

}  // namespace shape
