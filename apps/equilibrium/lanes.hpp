#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <cstdint>

/// Several particles side by side: a number type for the templates of libfpm and libconstitutive.
///
/// A vector extension of the compiler rather than std::experimental::simd, whose width is fixed by
/// the compiler's options: this type is lowered to whatever the function at hand is compiled for,
/// so that one binary serves processors with and without wide registers.
namespace equilibrium {

inline constexpr int lane_count = 4;

/// Outcome of a comparison of `Lanes`: all bits set where it holds.
struct LaneMask {
  using Register = std::int64_t __attribute__((vector_size(lane_count * sizeof(std::int64_t))));
  Register bits{};

  LaneMask() = default;
  explicit LaneMask(const Register& b) : bits(b) {}
  // Copied as a register (see Lanes).
  // NOLINTBEGIN(modernize-use-equals-default)
  LaneMask(const LaneMask& other) : bits(other.bits) {}
  LaneMask& operator=(const LaneMask& other) {
    bits = other.bits;
    return *this;
  }
  // NOLINTEND(modernize-use-equals-default)

  bool operator[](int lane) const { return bits[lane] != 0; }
  friend LaneMask operator&(const LaneMask& a, const LaneMask& b) {
    return LaneMask(a.bits & b.bits);
  }
  friend LaneMask operator|(const LaneMask& a, const LaneMask& b) {
    return LaneMask(a.bits | b.bits);
  }
  friend LaneMask operator!(const LaneMask& a) { return LaneMask(~a.bits); }
};

inline bool any(const LaneMask& m) {
  std::int64_t bits = 0;
  for (int lane = 0; lane < lane_count; ++lane) bits |= m.bits[lane];
  return bits != 0;
}

/// The numbers of `lane_count` particles.
class Lanes {
 public:
  using Register = double __attribute__((vector_size(lane_count * sizeof(double))));
  /// A register at any address: one move, where std::memcpy would make two.
  using Unaligned __attribute__((aligned(sizeof(double)), may_alias)) = Register;

  Lanes() = default;
  Lanes(double all) : v_(Register{} + all) {}  // NOLINT(google-explicit-constructor): as for double
  explicit Lanes(Register v) : v_(v) {}
  // A trivial copy is made in halves, for which a load of the whole must wait; this one is not.
  // NOLINTBEGIN(modernize-use-equals-default)
  Lanes(const Lanes& other) : v_(other.v_) {}
  Lanes& operator=(const Lanes& other) {
    v_ = other.v_;
    return *this;
  }
  // NOLINTEND(modernize-use-equals-default)

  double operator[](int lane) const { return v_[lane]; }

  Lanes operator-() const { return Lanes(-v_); }
  friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.v_ + b.v_); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.v_ - b.v_); }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.v_ * b.v_); }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.v_ / b.v_); }
  Lanes& operator+=(const Lanes& b) { return *this = *this + b; }
  Lanes& operator-=(const Lanes& b) { return *this = *this - b; }
  Lanes& operator*=(const Lanes& b) { return *this = *this * b; }
  Lanes& operator/=(const Lanes& b) { return *this = *this / b; }

  friend LaneMask operator<(const Lanes& a, const Lanes& b) { return LaneMask(a.v_ < b.v_); }
  friend LaneMask operator>(const Lanes& a, const Lanes& b) { return LaneMask(a.v_ > b.v_); }
  friend LaneMask operator<=(const Lanes& a, const Lanes& b) { return LaneMask(a.v_ <= b.v_); }
  friend LaneMask operator>=(const Lanes& a, const Lanes& b) { return LaneMask(a.v_ >= b.v_); }
  friend LaneMask operator==(const Lanes& a, const Lanes& b) { return LaneMask(a.v_ == b.v_); }

  const Register& values() const { return v_; }

 private:
  Register v_;
};

inline Lanes select(const LaneMask& condition, const Lanes& yes, const Lanes& no) {
  return Lanes(condition.bits ? yes.values() : no.values());
}
inline Lanes sqrt(const Lanes& a) {
  Lanes::Register r;
  for (int lane = 0; lane < lane_count; ++lane) r[lane] = std::sqrt(a[lane]);
  return Lanes(r);
}
inline Lanes cbrt(const Lanes& a) {
  Lanes::Register r;
  for (int lane = 0; lane < lane_count; ++lane) r[lane] = std::cbrt(a[lane]);
  return Lanes(r);
}
inline Lanes min(const Lanes& a, const Lanes& b) {
  return select(b < a, b, a);
}
inline Lanes max(const Lanes& a, const Lanes& b) {
  return select(a < b, b, a);
}
inline Lanes abs(const Lanes& a) {
  return select(a < Lanes(0.0), -a, a);
}
inline Lanes hypot(const Lanes& a, const Lanes& b) {
  return sqrt(a * a + b * b);
}
/// Infinities and NaN differ from zero times themselves.
inline LaneMask is_finite(const Lanes& a) {
  return a * 0.0 == Lanes(0.0);
}

/// Reads the number of a particle, or with Lanes also those of the particles behind it.
template <class Real>
Real load(const double* p) {
  if constexpr (std::same_as<Real, double>) {
    return *p;
  } else {
    return Lanes(*reinterpret_cast<const Lanes::Unaligned*>(p));
  }
}
inline void store(double* p, double value) {
  *p = value;
}
inline void store(double* p, const Lanes& value) {
  *reinterpret_cast<Lanes::Unaligned*>(p) = value.values();
}

namespace detail {

// Columns of the 4 x 4 block of the given rows: two stages of register shuffles.
inline void transpose(const Lanes::Register& r0, const Lanes::Register& r1,
                      const Lanes::Register& r2, const Lanes::Register& r3, Lanes* column) {
  const Lanes::Register even_upper = __builtin_shufflevector(r0, r1, 0, 4, 2, 6);
  const Lanes::Register odd_upper = __builtin_shufflevector(r0, r1, 1, 5, 3, 7);
  const Lanes::Register even_lower = __builtin_shufflevector(r2, r3, 0, 4, 2, 6);
  const Lanes::Register odd_lower = __builtin_shufflevector(r2, r3, 1, 5, 3, 7);
  column[0] = Lanes(__builtin_shufflevector(even_upper, even_lower, 0, 1, 4, 5));
  column[1] = Lanes(__builtin_shufflevector(odd_upper, odd_lower, 0, 1, 4, 5));
  column[2] = Lanes(__builtin_shufflevector(even_upper, even_lower, 2, 3, 6, 7));
  column[3] = Lanes(__builtin_shufflevector(odd_upper, odd_lower, 2, 3, 6, 7));
}

}  // namespace detail

/// Reads the `Count` numbers of the particle whose column starts at `column`, or with Lanes also
/// those of the particles behind it, whose columns follow without gaps.
template <int Count>
void load_columns(const double* column, double* out) {
  for (int k = 0; k < Count; ++k) out[k] = column[k];
}
template <int Count>
void load_columns(const double* column, Lanes* out) {
  static_assert(lane_count == 4);
  int k = 0;
  for (; k + 4 <= Count; k += 4) {
    const double* part = column + k;
    detail::transpose(load<Lanes>(part).values(), load<Lanes>(part + Count).values(),
                      load<Lanes>(part + 2 * Count).values(),
                      load<Lanes>(part + 3 * Count).values(), out + k);
  }
  for (; k < Count; ++k) {
    out[k] = Lanes(Lanes::Register{column[k], column[Count + k], column[2 * Count + k],
                                   column[3 * Count + k]});
  }
}

}  // namespace equilibrium

namespace Eigen {

template <>
struct NumTraits<equilibrium::Lanes> : GenericNumTraits<equilibrium::Lanes> {
  using Real = equilibrium::Lanes;
  using NonInteger = equilibrium::Lanes;
  using Nested = equilibrium::Lanes;
  using Literal = double;
  // NOLINTBEGIN(readability-identifier-naming): Eigen's names
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 0 };
  enum { ReadCost = 1, AddCost = 1, MulCost = 1 };
  // NOLINTEND(readability-identifier-naming)
};

// Arrays of lanes lie as lanes do; Eigen would ask for less, which Clang takes for an error.
template <int Size>
struct internal::compute_default_alignment<equilibrium::Lanes, Size> {
  enum { value = 0 };
};

}  // namespace Eigen
