#pragma once

#include <memory>
#include <string>
#include <vector>

#include "shape/point.hpp"

namespace shape {

/// What is taken from a box: what is inside a ring, or outside it.
struct Cut {
  Ring ring;
  bool outside = false;
};

/// A straight piece of a surface; the body is to the left of it. What it is of, by number; -1:
/// none.
struct SurfaceSegment {
  Point from, to;
  int cut = -1;   // that made it
  int side = -1;  // of the outline
  int face = -1;  // of the box: 0 left, 1 right, 2 bottom, 3 top
  int region = 0;
  bool hollow = false;  // of regions: both ends turn towards the body, as all of a bore does
};

/// A straight piece of where two regions meet.
struct Joint {
  Point from, to;
  int left = 0, right = 0;
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

struct Outline;

/// A body in the plane: a box, or regions that adjoin each other within one, with parts cut out.
class Body {
 public:
  /// A box, the one region.
  /// @throws std::invalid_argument naming the ring by its place if `objection` has one
  Body(const Point& lower, const Point& upper, const std::vector<Cut>& cuts);
  /// Regions; what of them is beyond the box does not count.
  Body(const Outline& outline, const Point& lower, const Point& upper,
       const std::vector<Cut>& cuts);
  ~Body();
  Body(Body&&) noexcept;
  Body& operator=(Body&&) noexcept;

  [[nodiscard]] double area() const;
  /// Number of pieces that do not hang together.
  [[nodiscard]] std::size_t pieces() const;
  [[nodiscard]] int regions() const;

  [[nodiscard]] Part within(const Point& lower, const Point& upper, int region = 0) const;
  /// What of a straight line is in a region.
  [[nodiscard]] Stretch along(const Point& from, const Point& to, int region = 0) const;
  [[nodiscard]] const std::vector<SurfaceSegment>& surface() const;
  [[nodiscard]] const std::vector<Joint>& joints() const;
  /// Distance of a box from the surface that cuts made or that is hollow.
  [[nodiscard]] double distance_to_hollows(const Point& lower, const Point& upper) const;
  /// How far a box is from a region; 0 inside it.
  [[nodiscard]] double distance_to_region(const Point& lower, const Point& upper, int region) const;

  /// Twice the area over the perimeter of a region: of a long one its thickness.
  [[nodiscard]] double thickness(int region) const;

 private:
  struct Shape;
  std::unique_ptr<Shape> shape_;
};

}  // namespace shape
