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

/// One kept in single precision, in half the memory; it is worked with in double precision.
using SingleVector = Eigen::VectorXf;

/// Several of these.
using SingleVectors = std::span<const SingleVector* const>;

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
void dots_of_block(Eigen::Index block, SingleVectors columns, const Vector& w,
                   std::span<double> sums);

/// w = own w + sum_j factors[j] columns[j] in a block; w is not read if own = 0.
void combine_block(Eigen::Index block, double own, Vectors columns, std::span<const double> factors,
                   Vector& w);
void combine_block(Eigen::Index block, double own, SingleVectors columns,
                   std::span<const double> factors, Vector& w);

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

/// A residual may bring both for SingleVectors as well. Without such `dots`, `dot` is called for a
/// copy of each.
template <class F>
concept HasSingleDots = requires(const F& f, SingleVectors columns, const Vector& w,
                                 std::span<double> sums) {
  f.dots(columns, w, sums);
};
template <class F>
concept HasSingleCombine = requires(const F& f, SingleVectors columns,
                                    std::span<const double> factors, Vector& w) {
  f.combine(1.0, columns, factors, w);
};

/// Non-owning view of an inner product and of what else is done with several vectors; the Euclidean
/// one on one thread when default constructed.
class InnerProductRef {
 public:
  InnerProductRef() = default;
  template <class F>
  requires(HasInnerProduct<F> || HasCombine<F>) explicit InnerProductRef(const F& f)
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
    if constexpr (HasInnerProduct<F> && HasSingleDots<F>) {
      single_dots_ = [](const void* o, SingleVectors columns, const Vector& w,
                        std::span<double> sums) {
        static_cast<const F*>(o)->dots(columns, w, sums);
      };
    }
    if constexpr (HasSingleCombine<F>) {
      single_combine_ = [](const void* o, double own, SingleVectors columns,
                           std::span<const double> factors, Vector& w) {
        static_cast<const F*>(o)->combine(own, columns, factors, w);
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
  /// Both of vectors in single precision.
  void dots(SingleVectors columns, const Vector& w, std::span<double> sums) const;
  void combine(double own, SingleVectors columns, std::span<const double> factors, Vector& w) const;

  /// Whether a sum of squares is one of which the root is the norm, free of overflow and underflow.
  [[nodiscard]] static bool is_safe_square(double square);

 private:
  const void* object_ = nullptr;
  double (*dot_)(const void*, const Vector&, const Vector&) = nullptr;
  void (*dots_)(const void*, Vectors, const Vector&, std::span<double>) = nullptr;
  void (*combine_)(const void*, double, Vectors, std::span<const double>, Vector&) = nullptr;
  void (*single_dots_)(const void*, SingleVectors, const Vector&, std::span<double>) = nullptr;
  void (*single_combine_)(const void*, double, SingleVectors, std::span<const double>,
                          Vector&) = nullptr;
};

}  // namespace jfnk
