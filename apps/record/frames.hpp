#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "files/vtkhdf.hpp"
#include "record/frame_series.hpp"
#include "record/run_folder.hpp"

namespace record {

/// Writes one frame file durably: /VTKHDF and the attributes step and time of "/".
/// @param deflate  compression, see Hdf5Layout
void write_frame(const std::filesystem::path& file, std::int64_t step, double time,
                 std::span<const double> points, std::span<const files::PointField> fields,
                 int deflate = 0, const files::SystemCalls& system = files::system_calls());

/// The frames of a run, `frames/frame-000120.hdf` of the steps asked for, and their series file.
class Frames {
 public:
  /// @param every  steps between frames; 0: none
  /// @param deflate  compression, see Hdf5Layout
  /// @param step  the run begins at
  /// @param last_time  of the curve a run goes on with: later frames are removed; absent: a new run
  /// @throws FileError if the folder or the series cannot be read or written.
  Frames(const RunFolder& folder, int every, int deflate, std::int64_t step,
         std::optional<double> last_time);

  [[nodiscard]] bool due(std::int64_t step) const;
  /// Whether a frame of this step is still to be written if the run ends at it.
  [[nodiscard]] bool lacks(std::int64_t step) const;
  void write(std::int64_t step, double time, std::span<const double> points,
             std::span<const files::PointField> fields);

  /// File name of the frame of a step, `frame-000120.hdf`.
  [[nodiscard]] static std::string name(std::int64_t step);

 private:
  std::filesystem::path folder_;
  const files::SystemCalls& system_;
  int every_;
  int deflate_;
  FrameSeries series_;
};

}  // namespace record
