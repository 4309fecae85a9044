#include "limit/certificate/curved_power.hpp"

#include <cmath>

namespace limit::certificate {

namespace {

// Across the plane whose traction does the work, dilation is the opening and what is left of the
// shear the slip. A slip under tau / F is one over F under tau.
double of_opening_and_slip(const problem::Envelope& envelope, double opening, double slip,
                           double& normal) {
  const double a = envelope.exponent, stress = envelope.stress;
  if (envelope.kind == problem::Envelope::Kind::power_law) {
    // -sigma_n opening + tau slip, largest where tau' is opening / slip.
    const double u = std::pow(envelope.coefficient * a * slip / opening, 1.0 / (1.0 - a));
    normal = (u - envelope.cohesive) * stress;
    return envelope.coefficient * stress * std::pow(u, a) * slip - normal * opening;
  }
  // In principal stresses: -sigma_3 opening + (sigma_1 - sigma_3) more / 2, more = shear - opening.
  const double shear = std::hypot(opening, slip);
  const double more = slip * slip / (shear + opening);
  const double u = std::pow(a * envelope.coefficient * more / (2.0 * opening), 1.0 / (1.0 - a));
  const double least = (u - envelope.cohesive) * stress / envelope.coefficient;
  const double difference = stress * std::pow(u, a);
  // The plane between the two: (1 - sin(phi)) / 2 of the difference above the lesser one.
  normal = least + difference * more / (2.0 * shear);
  return difference * more / 2.0 - least * opening;
}

}  // namespace

double curved_power(const problem::Envelope& envelope, double dilation, double shear) {
  // Nothing shears along any plane more than it opens: the apex.
  if (shear <= dilation) return envelope.apex() * dilation;
  const double slip = std::sqrt((shear - dilation) * (shear + dilation)) / envelope.factor;
  double normal = 0.0;
  return of_opening_and_slip(envelope, dilation, slip, normal);
}

double curved_contact_power(const problem::Envelope& envelope, double without_pressure,
                            double opening, double slip) {
  const double whole = slip / envelope.factor;
  if (whole == 0.0) return 0.0;
  double normal = 0.0;
  const double power =
      opening > 0.0 ? of_opening_and_slip(envelope, opening, whole, normal) : INFINITY;
  return opening > 0.0 && normal <= 0.0 ? without_pressure * slip : power;
}

}  // namespace limit::certificate
