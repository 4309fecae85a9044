#pragma once

namespace limit::problem {

/// A curved Mohr envelope: the shear strength tau of a plane under the normal stress sigma_n,
/// compression positive here and there only, concave and growing, over a factor that divides it.
///
/// - Hoek & Brown (Hoek, Carranza-Torres & Corkum 2002): sigma_1 = sigma_3 + sigma_ci (m_b sigma_3
///   / sigma_ci + s)^a, told by u = m_b sigma_3 / sigma_ci + s.
/// - Power law: tau = A p_r ((sigma_n + T) / p_r)^b, told by u = (sigma_n + T) / p_r.
///
/// The exponents are from 1/2 on and below 1: then every circle within the envelope touches it in
/// one place, whatever the factor, and none is larger than that of its tangent there.
struct Envelope {
  enum class Kind { none, hoek_brown, power_law };

  Kind kind = Kind::none;
  double stress = 0.0;       // [Pa] sigma_ci, or p_r
  double coefficient = 0.0;  // m_b, or A
  double exponent = 0.0;     // a, or b
  double cohesive = 0.0;     // s, or T / p_r
  double factor = 1.0;       // by which tau and tan(phi) are divided

  /// A point of the envelope: normal stress, strength and the slope tan(phi), with its tangent and
  /// the circle that touches there.
  struct Place {
    double normal = 0.0, shear = 0.0, slope = 0.0;

    [[nodiscard]] double cohesion() const { return shear - normal * slope; }
    [[nodiscard]] double friction_angle() const;
    [[nodiscard]] double centre() const { return normal + shear * slope; }
    [[nodiscard]] double radius() const;
  };

  [[nodiscard]] bool is_there() const { return kind != Kind::none; }
  /// The largest tension, where the envelope begins [Pa].
  [[nodiscard]] double apex() const;
  /// The largest principal stress beside none, as of a block between smooth platens.
  [[nodiscard]] double unconfined() const;
  /// @param u  > 0, see above
  [[nodiscard]] Place at(double u) const;
  /// The place whose circle has this centre, or, within rounding, a lesser one; not nearer to the
  /// apex than a slope of 80 degrees.
  [[nodiscard]] Place touched_by_circle(double centre) const;
  /// The u of that place.
  [[nodiscard]] double told_by_circle(double centre) const;
  /// The place under this normal stress, likewise.
  [[nodiscard]] Place under(double normal) const;
  /// The radius of the circle about a centre that touches the envelope, not more than that but for
  /// the rounding of double precision; 0 at the apex and beyond it.
  [[nodiscard]] double radius_about(double centre) const;
};

/// Of rock told by its intact strength [Pa], m_i, the geological strength index (0 .. 100) and the
/// disturbance D (0 .. 1): m_b = m_i exp((GSI - 100) / (28 - 14 D)), s = exp((GSI - 100) / (9 - 3
/// D)), a = 1/2 + (exp(-GSI / 15) - exp(-20 / 3)) / 6 (Hoek, Carranza-Torres & Corkum 2002).
[[nodiscard]] Envelope hoek_brown(double intact_strength, double m_i, double gsi,
                                  double disturbance);

}  // namespace limit::problem
