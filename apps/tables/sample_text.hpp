#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "tables/table.hpp"
#include "tables/varying_number.hpp"

namespace tables {

/// A file of samples that is none: what() says what was found.
class SampleError : public std::runtime_error {
 public:
  SampleError(std::size_t line, const std::string& found, std::string allowed)
      : std::runtime_error(found), line_(line), allowed_(std::move(allowed)) {}
  /// From one; 0: the file as a whole.
  [[nodiscard]] std::size_t line() const { return line_; }
  [[nodiscard]] const std::string& allowed() const { return allowed_; }

 private:
  std::size_t line_;
  std::string allowed_;
};

/// Reads the text of a file of samples. A raster is an ESRI ASCII grid: ncols, nrows, xllcorner or
/// xllcenter, yllcorner or yllcenter, cellsize (or dx and dy), perhaps NODATA_value, a line each,
/// and then a line of values for each row of cells, from the top. A table is lines of coordinate
/// and value, points of x, y and value, between commas; the first line may name them, and what
/// follows a # is no part of it.
/// @param range  which values are allowed, times the file's factor
/// @throws SampleError
[[nodiscard]] Samples read_samples(std::string_view text, const SampleFile& file,
                                   const Range& range);

/// What is wrong with samples, beside their shape: a table whose coordinates do not rise, two
/// points in one place, a value that is not allowed; "" if nothing is.
[[nodiscard]] std::string objection(const Samples& samples, const Range& range);

}  // namespace tables
