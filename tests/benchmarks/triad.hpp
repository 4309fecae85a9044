#pragma once

#include <cstddef>
#include <memory>

namespace benchmarks {

/// The triad of STREAM, a = b + s c: what the memory gives to a loop that does nothing else.
///
/// Arrays are first written by the threads that work on them later. 24 bytes per element: the line
/// of `a` that some processors fetch before they write it is not counted, as in STREAM.
class Triad {
 public:
  static constexpr double bytes_per_element = 24.0;

  /// @param elements  of each of the three arrays
  explicit Triad(std::size_t elements);

  void run();
  std::size_t size() const { return size_; }
  const double* result() const { return a_.get(); }

 private:
  std::size_t size_;
  std::unique_ptr<double[]> a_, b_, c_;
};

}  // namespace benchmarks
