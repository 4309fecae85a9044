#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "files/system_calls.hpp"

namespace record {

/// The list of a run's frames with their times, `run.hdf.series`, which ParaView opens as one
/// animated data set. Every change is written durably at once.
class FrameSeries {
 public:
  struct Entry {
    std::string name;  // relative to the series file
    double time = 0.0;
    bool operator==(const Entry&) const = default;
  };

  /// Starts an empty list (the file appears with the first frame).
  explicit FrameSeries(std::filesystem::path file,
                       const files::SystemCalls& system = files::system_calls())
      : file_(std::move(file)), system_(&system) {}

  /// Takes up an existing list and drops frames later than `time`; a file that does not exist is an
  /// empty list.
  /// @throws FileError if the file is not such a list.
  [[nodiscard]] static FrameSeries resume(std::filesystem::path file, double time,
                                          const files::SystemCalls& system = files::system_calls());

  void append(std::string name, double time);
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }

 private:
  void write() const;

  std::filesystem::path file_;
  const files::SystemCalls* system_;
  std::vector<Entry> entries_;
};

}  // namespace record
