#include "limit/problem/envelope.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace limit::problem {

namespace {

/// The two u, next to each other, between which a growing function of u becomes a value; the lower
/// one is never less than `least`.
template <class Function>
double below(const Function& function, double value, double least) {
  if (function(least) >= value) return least;
  double low = least, high = 2.0 * least;
  while (function(high) < value) {
    low = high;
    high *= 4.0;
  }
  // By its logarithm, as u may be tiny or huge.
  for (;;) {
    const double middle = high > 2.0 * low ? std::sqrt(low * high) : low + (high - low) / 2.0;
    if (!(middle > low && middle < high)) return low;
    (function(middle) < value ? low : high) = middle;
  }
}

// Of the least u that tells numbers apart from the apex.
constexpr double tiny = 1e-30;

}  // namespace

double Envelope::Place::friction_angle() const {
  return std::atan(slope);
}

double Envelope::Place::radius() const {
  return shear * std::hypot(1.0, slope);
}

double Envelope::apex() const {
  return kind == Kind::hoek_brown ? cohesive * stress / coefficient : cohesive * stress;
}

Envelope::Place Envelope::at(double u) const {
  Place place;
  if (kind == Kind::hoek_brown) {
    const double least = (u - cohesive) * stress / coefficient;  // sigma_3
    const double radius = stress * std::pow(u, exponent) / 2.0;
    // d(sigma_1) / d(sigma_3) = (1 + sin(phi)) / (1 - sin(phi)), less one.
    const double rise = exponent * coefficient * std::pow(u, exponent - 1.0);
    place.slope = rise / (2.0 * std::sqrt(1.0 + rise));
    place.normal = least + 2.0 * radius / (2.0 + rise);
    place.shear = radius * 2.0 * std::sqrt(1.0 + rise) / (2.0 + rise);
  } else {
    place.normal = (u - cohesive) * stress;
    place.shear = coefficient * stress * std::pow(u, exponent);
    place.slope = coefficient * exponent * std::pow(u, exponent - 1.0);
  }
  place.shear /= factor;
  place.slope /= factor;
  return place;
}

namespace {

// Where the slope is that of 80 degrees.
double steepest(const Envelope& envelope) {
  constexpr double angle = 80.0 * std::numbers::pi / 180.0;
  const double wanted = std::tan(angle);
  return below([&](double u) { return -envelope.at(u).slope; }, -wanted, tiny);
}

}  // namespace

double Envelope::told_by_circle(double centre) const {
  return below([this](double u) { return at(u).centre(); }, centre, steepest(*this));
}

Envelope::Place Envelope::touched_by_circle(double centre) const {
  return at(told_by_circle(centre));
}

Envelope::Place Envelope::under(double normal) const {
  return at(below([this](double u) { return at(u).normal; }, normal, steepest(*this)));
}

double Envelope::unconfined() const {
  const double u = below(
      [this](double v) {
        const Place place = at(v);
        return place.centre() - place.radius();
      },
      0.0, tiny);
  return at(u).centre() + at(u).radius();
}

double Envelope::radius_about(double centre) const {
  const Place first = at(tiny);
  if (centre <= first.centre()) {
    // Concave from nothing at the apex: where the exponent is 1/2, a tangent of no end of slope
    // there leaves room for a whole circle.
    const double reach = first.centre() + apex(), within = centre + apex();
    if (reach <= 0.0 || within <= 0.0) return 0.0;
    return std::min(within, within * (first.radius() / reach));
  }
  const double u = below([this](double v) { return at(v).centre(); }, centre, tiny);
  return at(u).radius();
}

Envelope hoek_brown(double intact_strength, double m_i, double gsi, double disturbance) {
  return {Envelope::Kind::hoek_brown, intact_strength,
          m_i * std::exp((gsi - 100.0) / (28.0 - 14.0 * disturbance)),
          0.5 + (std::exp(-gsi / 15.0) - std::exp(-20.0 / 3.0)) / 6.0,
          std::exp((gsi - 100.0) / (9.0 - 3.0 * disturbance))};
}

}  // namespace limit::problem
