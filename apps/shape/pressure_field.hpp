#pragma once

#include <memory>
#include <string>
#include <vector>

#include "shape/point.hpp"
#include "tables/diagnosis.hpp"
#include "tables/varying_number.hpp"

namespace shape {

/// A pore pressure that is told from place to place. It is linear in parts of the plane:
/// everywhere, in the strips of a table, in two triangles of each square between a raster's values,
/// in Delaunay's triangles between points; and nothing wherever that would be less (suction).
class PressureField {
 public:
  /// @param told  [Pa]; of points at least three, not on one line (`is_pressure_of`)
  explicit PressureField(const tables::VaryingNumber& told);
  ~PressureField();
  PressureField(PressureField&&) noexcept;
  PressureField& operator=(PressureField&&) noexcept;

  /// Whether there are no triangles between its points.
  [[nodiscard]] bool has_nothing() const;
  /// [Pa] At a place; beyond what is told of, as at the nearest place of that.
  [[nodiscard]] double at(const Point& place) const;

  /// Where in a convex polygon it is linear: its value [Pa] at a corner of that part, `ring[0]`,
  /// and how it grows from there [Pa/m]; both nothing where there is no pressure.
  struct Piece {
    Ring ring;
    double area = 0.0;  // [m2]
    double value = 0.0;
    Point gradient = Point::Zero();
    bool wet = false;  // whether there is pressure
  };
  /// The pieces of a convex polygon; none of what is beyond that which is told of.
  [[nodiscard]] std::vector<Piece> within(const Ring& polygon) const;

  /// The places between the ends of a straight line where the pressure along it is no longer
  /// linear, or comes off what is so by more than a millionth of its largest value; in order.
  [[nodiscard]] std::vector<Point> kinks(const Point& from, const Point& to) const;
  /// Whether its parts are triangles, which may be many.
  [[nodiscard]] bool has_triangles() const;
  /// [Pa] Anywhere; of what is linear, at its own place.
  [[nodiscard]] double largest() const;

  /// Whether it is told of a place; on the outermost line of values it is, but for rounding.
  [[nodiscard]] bool covers(const Point& place) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Whether numbers are a pressure of water all over ground between some corners: told of each of
/// them, by points that are not on one line, and not suction alone. What is none is an error of the
/// diagnosis, under `key`; one that grows upwards all over the ground is a warning.
[[nodiscard]] bool is_pressure_of(const tables::VaryingNumber& told, const Ring& corners,
                                  const std::string& key, tables::Diagnosis& diagnosis);

}  // namespace shape
