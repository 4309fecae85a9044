#pragma once

#include <Eigen/Core>
#include <concepts>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

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

/// The rows of a block.
struct Rows {
  Eigen::Index begin;
  Eigen::Index count;

  /// These rows of a vector.
  template <class V>
  [[nodiscard]] auto of(V& v) const {
    return v.segment(begin, count);
  }
};

/// Those of a block of n rows.
[[nodiscard]] constexpr Rows rows_of(Eigen::Index block, Eigen::Index n) {
  const Eigen::Index begin = block * rows_per_block;
  return {begin, n - begin < rows_per_block ? n - begin : rows_per_block};
}

/// Non-owning view of what is to be done with each block; blocks may be worked on at once.
class BlockWork {
 public:
  template <class Work>
  requires(!std::same_as<std::remove_cv_t<Work>, BlockWork>) explicit BlockWork(Work& work)
      : object_(std::addressof(work)), work_([](const void* object, Eigen::Index block) {
          (*static_cast<const Work*>(object))(block);
        }) {}
  void operator()(Eigen::Index block) const { work_(object_, block); }

 private:
  const void* object_;
  void (*work_)(const void*, Eigen::Index);
};

/// A vector, and where its products with some columns go.
struct Products {
  const Vector* with;
  std::span<double> sums;
};

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

/// The same of columns in single precision. Without it `dot` is called for a copy of each.
template <class F>
concept HasSingleDots = requires(const F& f, SingleVectors columns, const Vector& w,
                                 std::span<double> sums) {
  f.dots(columns, w, sums);
};

/// A residual may bring `share_out(n, numbers, work)`, which calls work(block) once for each block
/// of n rows, from whichever threads: `numbers` that are read or written in all tell whether that
/// is worth the threads' meeting.
template <class F>
concept HasShareOut = requires(const F& f, Eigen::Index n, BlockWork work) {
  f.share_out(n, n, work);
};

/// w = own w + sum_j factors[j] columns[j], of some rows; w is not read if own = 0.
void combine_rows(Rows rows, double own, Vectors columns, std::span<const double> factors,
                  Vector& w);
void combine_rows(Rows rows, double own, SingleVectors columns, std::span<const double> factors,
                  Vector& w);

/// Non-owning view of an inner product and of what else is done with vectors; the Euclidean one on
/// one thread when default constructed. One thread at a time may use it.
class InnerProductRef {
 public:
  InnerProductRef() = default;
  template <class F>
  requires(HasInnerProduct<F> || HasShareOut<F>) explicit InnerProductRef(const F& f)
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
    if constexpr (HasShareOut<F>) {
      share_out_ = [](const void* o, Eigen::Index n, Eigen::Index numbers, BlockWork work) {
        static_cast<const F*>(o)->share_out(n, numbers, work);
      };
    }
    if constexpr (HasInnerProduct<F> && HasSingleDots<F>) {
      single_dots_ = [](const void* o, SingleVectors columns, const Vector& w,
                        std::span<double> sums) {
        static_cast<const F*>(o)->dots(columns, w, sums);
      };
    }
  }

  /// <a, b>. Cost: one pass over both.
  [[nodiscard]] double dot(const Vector& a, const Vector& b) const;
  /// sqrt(<a, a>), free of overflow and underflow for the Euclidean product.
  [[nodiscard]] double norm(const Vector& a) const;
  /// sums[j] = <columns[j], w>. Cost: one pass over each. No allocation, but with `share_out` once
  /// for the sums of blocks.
  void dots(Vectors columns, const Vector& w, std::span<double> sums) const;
  /// The same with several vectors, each column being read once.
  void dots(Vectors columns, std::span<const Products> products) const;
  /// w = own w + sum_j factors[j] columns[j]; w is not read if own = 0. Cost: one pass over each.
  void combine(double own, Vectors columns, std::span<const double> factors, Vector& w) const;
  /// All of them of columns in single precision.
  void dots(SingleVectors columns, const Vector& w, std::span<double> sums) const;
  void dots(SingleVectors columns, std::span<const Products> products) const;
  void combine(double own, SingleVectors columns, std::span<const double> factors, Vector& w) const;

  /// Calls work(rows) for all blocks of n rows, on the residual's threads if it has any.
  /// @param vectors  that are read or written
  template <class Work>
  void pass(Eigen::Index n, Eigen::Index vectors, const Work& work) const {
    const auto of_block = [&](Eigen::Index block) { work(rows_of(block, n)); };
    share_out(n, vectors * n, BlockWork(of_block));
  }

  /// The same, and then norms[j] = `norm` of vectors[j], of which each block is read when the work
  /// on it is done. No allocation, but with `share_out` as `dots`.
  template <class Work>
  void pass(Eigen::Index n, Eigen::Index numbers_per_row, const Work& work, Vectors vectors,
            std::span<double> norms) const {
    const auto of_block = [&](Eigen::Index block) { work(rows_of(block, n)); };
    work_and_norms(n, numbers_per_row, BlockWork(of_block), vectors, norms);
  }

  /// Whether a sum of squares is one of which the root is the norm, free of overflow and underflow.
  [[nodiscard]] static bool is_safe_square(double square);

 private:
  void share_out(Eigen::Index n, Eigen::Index numbers, BlockWork work) const;
  void work_and_norms(Eigen::Index n, Eigen::Index numbers_per_row, BlockWork work, Vectors vectors,
                      std::span<double> norms) const;
  [[nodiscard]] double norm_of(const Vector& a, double square) const;
  template <class Columns>
  void dots_by_blocks(Columns columns, std::span<const Products> products) const;
  std::span<double> sums_of_blocks(std::size_t count) const;
  template <class Columns>
  void combine_by_blocks(double own, Columns columns, std::span<const double> factors,
                         Vector& w) const;

  const void* object_ = nullptr;
  mutable std::vector<double> block_sums_;  // for share_out: grown as needed, and kept
  double (*dot_)(const void*, const Vector&, const Vector&) = nullptr;
  void (*dots_)(const void*, Vectors, const Vector&, std::span<double>) = nullptr;
  void (*share_out_)(const void*, Eigen::Index, Eigen::Index, BlockWork) = nullptr;
  void (*single_dots_)(const void*, SingleVectors, const Vector&, std::span<double>) = nullptr;
};

}  // namespace jfnk
