#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>

#include "equilibrium/instruction_sets.hpp"

/// Several particles side by side: a number type for the templates of libfpm and libconstitutive.
///
/// A vector extension of the compiler rather than std::experimental::simd, whose width is fixed by
/// the compiler's options: this type is lowered to whatever the function at hand is compiled for,
/// so that one binary serves processors with and without wide registers.
namespace equilibrium {

namespace detail {

// Registers of a width, how they compare and are chosen from. GCC takes comparisons apart in
// functions that are not compiled for registers so wide, before it inlines them where they are.
template <int Width>
struct Registers;
#define EQUILIBRIUM_REGISTERS(width, attribute)                                                 \
  template <>                                                                                   \
  struct Registers<width> {                                                                     \
    using Double = double __attribute__((vector_size(width * 8)));                              \
    using Single = float __attribute__((vector_size(width * 4)));                               \
    using Integer = std::int64_t __attribute__((vector_size(width * 8)));                       \
    attribute static void less(const Double& a, const Double& b, Integer& r) { r = a < b; }     \
    attribute static void at_most(const Double& a, const Double& b, Integer& r) { r = a <= b; } \
    attribute static void equal(const Double& a, const Double& b, Integer& r) { r = a == b; }   \
    attribute static void choose(const Integer& condition, const Double& yes, const Double& no, \
                                 Double& r) {                                                   \
      r = condition ? yes : no;                                                                 \
    }                                                                                           \
  }
EQUILIBRIUM_REGISTERS(4, );
EQUILIBRIUM_REGISTERS(8, EQUILIBRIUM_AVX512);
#undef EQUILIBRIUM_REGISTERS

}  // namespace detail

template <int Width>
class Lanes;

/// Outcome of a comparison of `Lanes`: all bits set where it holds.
template <int Width>
struct LaneMask {
  using Register = typename detail::Registers<Width>::Integer;
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
  friend bool any(const LaneMask& m) {
    std::int64_t bits = 0;
    for (int lane = 0; lane < Width; ++lane) bits |= m.bits[lane];
    return bits != 0;
  }
  friend Lanes<Width> select(const LaneMask& condition, const Lanes<Width>& yes,
                             const Lanes<Width>& no) {
    typename Lanes<Width>::Register chosen;
    detail::Registers<Width>::choose(condition.bits, yes.values(), no.values(), chosen);
    return Lanes<Width>(chosen);
  }
};

/// The numbers of `Width` particles. What the templates call on a number is a friend, so that
/// doubles are taken for lanes that are all alike.
template <int Width>
class Lanes {
 public:
  static constexpr int width = Width;
  using Mask = LaneMask<Width>;
  using Register = typename detail::Registers<Width>::Double;
  /// A register at any address: one move, where std::memcpy would make two.
  using Unaligned __attribute__((aligned(sizeof(double)), may_alias)) = Register;
  using Single = typename detail::Registers<Width>::Single;
  using UnalignedSingle __attribute__((aligned(sizeof(float)), may_alias)) = Single;

  Lanes() = default;
  Lanes(double all) : v_(all - Register{}) {}  // NOLINT(google-explicit-constructor): as for double
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

  friend Mask operator<(const Lanes& a, const Lanes& b) {
    Mask m;
    detail::Registers<Width>::less(a.v_, b.v_, m.bits);
    return m;
  }
  friend Mask operator<=(const Lanes& a, const Lanes& b) {
    Mask m;
    detail::Registers<Width>::at_most(a.v_, b.v_, m.bits);
    return m;
  }
  friend Mask operator==(const Lanes& a, const Lanes& b) {
    Mask m;
    detail::Registers<Width>::equal(a.v_, b.v_, m.bits);
    return m;
  }
  friend Mask operator>(const Lanes& a, const Lanes& b) { return b < a; }
  friend Mask operator>=(const Lanes& a, const Lanes& b) { return b <= a; }

  friend Lanes sqrt(const Lanes& a) {
    Register r;
    for (int lane = 0; lane < Width; ++lane) r[lane] = std::sqrt(a[lane]);
    return Lanes(r);
  }
  friend Lanes cbrt(const Lanes& a) {
    Register r;
    for (int lane = 0; lane < Width; ++lane) r[lane] = std::cbrt(a[lane]);
    return Lanes(r);
  }
  friend Lanes min(const Lanes& a, const Lanes& b) { return select(b < a, b, a); }
  friend Lanes max(const Lanes& a, const Lanes& b) { return select(a < b, b, a); }
  friend Lanes abs(const Lanes& a) { return select(a < Lanes(0.0), -a, a); }
  friend Lanes hypot(const Lanes& a, const Lanes& b) { return sqrt(a * a + b * b); }
  /// Infinities and NaN differ from zero times themselves.
  friend Mask is_finite(const Lanes& a) { return a * 0.0 == Lanes(0.0); }

  const Register& values() const { return v_; }

 private:
  Register v_;
};

/// Reads the number of a particle, or with Lanes also those of the particles behind it.
template <class Real>
Real load(const double* p) {
  if constexpr (std::same_as<Real, double>) {
    return *p;
  } else {
    return Real(*reinterpret_cast<const typename Real::Unaligned*>(p));
  }
}
template <class Real>
Real load(const float* p) {
  if constexpr (std::same_as<Real, double>) {
    return *p;
  } else {
    return Real(__builtin_convertvector(*reinterpret_cast<const typename Real::UnalignedSingle*>(p),
                                        typename Real::Register));
  }
}
inline void store(double* p, double value) {
  *p = value;
}
template <int Width>
void store(double* p, const Lanes<Width>& value) {
  *reinterpret_cast<typename Lanes<Width>::Unaligned*>(p) = value.values();
}
inline void store(float* p, double value) {
  *p = static_cast<float>(value);
}
template <int Width>
void store(float* p, const Lanes<Width>& value) {
  *reinterpret_cast<typename Lanes<Width>::UnalignedSingle*>(p) =
      __builtin_convertvector(value.values(), typename Lanes<Width>::Single);
}

namespace detail {

using Four = Lanes<4>::Register;

// Columns of the 4 x 4 block of the given rows: two stages of register shuffles.
inline void transpose(const Four& r0, const Four& r1, const Four& r2, const Four& r3,
                      Four* column) {
  const Four even_upper = __builtin_shufflevector(r0, r1, 0, 4, 2, 6);
  const Four odd_upper = __builtin_shufflevector(r0, r1, 1, 5, 3, 7);
  const Four even_lower = __builtin_shufflevector(r2, r3, 0, 4, 2, 6);
  const Four odd_lower = __builtin_shufflevector(r2, r3, 1, 5, 3, 7);
  column[0] = __builtin_shufflevector(even_upper, even_lower, 0, 1, 4, 5);
  column[1] = __builtin_shufflevector(odd_upper, odd_lower, 0, 1, 4, 5);
  column[2] = __builtin_shufflevector(even_upper, even_lower, 2, 3, 6, 7);
  column[3] = __builtin_shufflevector(odd_upper, odd_lower, 2, 3, 6, 7);
}

// Up to four numbers of four columns of height Count, from number First on.
template <int Count, int First>
void load_four(const double* column, Four* out) {
  const auto at = [&](int k) { return load<Lanes<4>>(column + k).values(); };
  if constexpr (Count == 2) {
    out[0] = __builtin_shufflevector(at(0), at(4), 0, 2, 4, 6);
    out[1] = __builtin_shufflevector(at(0), at(4), 1, 3, 5, 7);
  } else if constexpr (Count == 3) {
    const Four a = at(0), b = at(4), c = at(8);
    out[0] = __builtin_shufflevector(__builtin_shufflevector(a, b, 0, 3, 6, 6), c, 0, 1, 2, 5);
    out[1] = __builtin_shufflevector(__builtin_shufflevector(a, b, 1, 4, 7, 7), c, 0, 1, 2, 6);
    out[2] = __builtin_shufflevector(__builtin_shufflevector(a, b, 2, 5, 5, 5), c, 0, 1, 4, 7);
  } else {
    static_assert(First + 4 <= Count);
    transpose(at(First), at(First + Count), at(First + 2 * Count), at(First + 3 * Count), out);
  }
}

// Numbers from First on; the last four may overlap those before.
template <int Count, int First, int Width>
void load_columns_from(const double* column, Lanes<Width>* out) {
  constexpr int count = std::min(4, Count);
  constexpr int from = std::min(First, Count - count);
  Four low[count];
  load_four<Count, from>(column, low);
  if constexpr (Width == 4) {
    for (int k = 0; k < count; ++k) out[from + k] = Lanes<4>(low[k]);
  } else {
    static_assert(Width == 8);
    Four high[count];
    load_four<Count, from>(column + 4 * Count, high);
    for (int k = 0; k < count; ++k) {
      out[from + k] = Lanes<8>(__builtin_shufflevector(low[k], high[k], 0, 1, 2, 3, 4, 5, 6, 7));
    }
  }
  if constexpr (from + count < Count) load_columns_from<Count, First + 4>(column, out);
}

}  // namespace detail

/// Reads the `Count` numbers of the particle whose column starts at `column`, or with Lanes also
/// those of the particles behind it, whose columns follow without gaps.
template <int Count>
void load_columns(const double* column, double* out) {
  for (int k = 0; k < Count; ++k) out[k] = column[k];
}
template <int Count, int Width>
void load_columns(const double* column, Lanes<Width>* out) {
  detail::load_columns_from<Count, 0>(column, out);
}

/// Writes them back.
template <int Count>
void store_columns(double* column, const double* values) {
  for (int k = 0; k < Count; ++k) column[k] = values[k];
}
template <int Count, int Width>
void store_columns(double* column, const Lanes<Width>* values) {
  for (int lane = 0; lane < Width; ++lane) {
    for (int k = 0; k < Count; ++k) column[lane * Count + k] = values[k][lane];
  }
}

}  // namespace equilibrium

namespace Eigen {

template <int Width>
struct NumTraits<equilibrium::Lanes<Width>> : GenericNumTraits<equilibrium::Lanes<Width>> {
  using Real = equilibrium::Lanes<Width>;
  using NonInteger = equilibrium::Lanes<Width>;
  using Nested = equilibrium::Lanes<Width>;
  using Literal = double;
  // NOLINTBEGIN(readability-identifier-naming): Eigen's names
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 0 };
  enum { ReadCost = 1, AddCost = 1, MulCost = 1 };
  // NOLINTEND(readability-identifier-naming)
};

// Arrays of lanes lie as lanes do; Eigen would ask for less, which Clang takes for an error.
template <int Width, int Size>
struct internal::compute_default_alignment<equilibrium::Lanes<Width>, Size> {
  enum { value = 0 };
};

}  // namespace Eigen
