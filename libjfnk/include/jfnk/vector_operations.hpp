#pragma once

#include <Eigen/Core>
#include <concepts>
#include <memory>
#include <span>

/// What a solver does with many vectors at once: the inner products of one with all the others in a
/// single sum, and combinations, each vector being read once.
namespace jfnk {

/// The vector of unknowns and of residuals.
using Vector = Eigen::VectorXd;

/// Several vectors of one size.
using Vectors = std::span<const Vector* const>;

/// Rows are worked on in blocks of so many, those of the last one fewer. Sums are those of the
/// blocks added up in their order: whoever spreads the blocks over threads gets the same bits, for
/// any number of threads. They are the same on every x86-64, too, whatever its registers' width.
inline constexpr Eigen::Index rows_per_block = 1024;

/// Blocks of n rows.
[[nodiscard]] constexpr Eigen::Index blocks_of(Eigen::Index n) {
  return (n + rows_per_block - 1) / rows_per_block;
}

/// The part of a block in <columns[j], w>, for all j.
/// @param[out] sums  overwritten, one for each column
void dots_of_block(Eigen::Index block, Vectors columns, const Vector& w, std::span<double> sums);

/// w = own w + sum_j factors[j] columns[j] in a block; w is not read if own = 0.
void combine_block(Eigen::Index block, double own, Vectors columns, std::span<const double> factors,
                   Vector& w);

/// Rotates columns 0 and 1, then 1 and 2, ... in a block: (a, b) becomes (c a + s b, c b - s a).
/// @param cosines, sines  one less than columns
void rotate_block(Eigen::Index block, std::span<Vector* const> columns,
                  std::span<const double> cosines, std::span<const double> sines);

/// A residual with its own inner product, as vectors spread over processes need.
template <class F>
concept HasInnerProduct = requires(const F& f, const Vector& a, const Vector& b) {
  { f.dot(a, b) } -> std::convertible_to<double>;
};

/// Besides its `dot`, a residual may bring `dots(columns, w, sums)`: sums[j] = dot(columns[j], w)
/// for all columns at once, so that all the sums of an iteration are a single one over processes or
/// threads. Without it `dot` is called for each.
template <class F>
concept HasDots = requires(const F& f, Vectors columns, const Vector& w, std::span<double> sums) {
  f.dots(columns, w, sums);
};

/// A residual may bring `combine(own, columns, factors, w)`, as `combine_block` for all blocks: for
/// threads.
template <class F>
concept HasCombine = requires(const F& f, Vectors columns, std::span<const double> factors,
                              Vector& w) {
  f.combine(1.0, columns, factors, w);
};

/// A residual may bring `rotate(columns, cosines, sines)`, as `rotate_block` for all blocks.
template <class F>
concept HasRotate = requires(const F& f, std::span<Vector* const> columns,
                             std::span<const double> angles) {
  f.rotate(columns, angles, angles);
};

/// Non-owning view of an inner product and of what else is done with several vectors; the Euclidean
/// one on one thread when default constructed.
class InnerProductRef {
 public:
  InnerProductRef() = default;
  template <class F>
  requires(HasInnerProduct<F> || HasCombine<F> || HasRotate<F>) explicit InnerProductRef(const F& f)
      : object_(std::addressof(f)) {
    if constexpr (HasInnerProduct<F>) {
      dot_ = [](const void* o, const Vector& a, const Vector& b) {
        return static_cast<double>(static_cast<const F*>(o)->dot(a, b));
      };
      if constexpr (HasDots<F>) {
        dots_ = [](const void* o, Vectors columns, const Vector& w, std::span<double> sums) {
          static_cast<const F*>(o)->dots(columns, w, sums);
        };
      }
    }
    if constexpr (HasCombine<F>) {
      combine_ = [](const void* o, double own, Vectors columns, std::span<const double> factors,
                    Vector& w) { static_cast<const F*>(o)->combine(own, columns, factors, w); };
    }
    if constexpr (HasRotate<F>) {
      rotate_ = [](const void* o, std::span<Vector* const> columns, std::span<const double> cosines,
                   std::span<const double> sines) {
        static_cast<const F*>(o)->rotate(columns, cosines, sines);
      };
    }
  }

  /// <a, b>. Cost: one pass over both.
  [[nodiscard]] double dot(const Vector& a, const Vector& b) const;
  /// sqrt(<a, a>), free of overflow and underflow for the Euclidean product.
  [[nodiscard]] double norm(const Vector& a) const;
  /// sums[j] = <columns[j], w>. Cost: one pass over each. No allocation.
  void dots(Vectors columns, const Vector& w, std::span<double> sums) const;
  /// w = own w + sum_j factors[j] columns[j]; w is not read if own = 0. Cost: one pass over each.
  void combine(double own, Vectors columns, std::span<const double> factors, Vector& w) const;
  /// Rotates neighbouring columns, see `rotate_block`. Cost: one pass over each.
  void rotate(std::span<Vector* const> columns, std::span<const double> cosines,
              std::span<const double> sines) const;

  /// Whether a sum of squares is one of which the root is the norm, free of overflow and underflow.
  [[nodiscard]] static bool is_safe_square(double square);

 private:
  const void* object_ = nullptr;
  double (*dot_)(const void*, const Vector&, const Vector&) = nullptr;
  void (*dots_)(const void*, Vectors, const Vector&, std::span<double>) = nullptr;
  void (*combine_)(const void*, double, Vectors, std::span<const double>, Vector&) = nullptr;
  void (*rotate_)(const void*, std::span<Vector* const>, std::span<const double>,
                  std::span<const double>) = nullptr;
};

}  // namespace jfnk
