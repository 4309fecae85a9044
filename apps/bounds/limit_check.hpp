#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "program/child_process.hpp"
#include "record/curve.hpp"
#include "record/run_folder.hpp"

namespace scene {
struct Scene;
}

namespace bounds {

/// Holds a footing's run against the bounds of its collapse load: starts fpm-limit beside it, if
/// the scene asks for it and the folder does not have its bracket yet, and compares in the end. Of
/// the run it needs nothing but the curve; nothing of the run depends on it.
class LimitCheck {
 public:
  /// @param program  fpm-limit
  LimitCheck(const scene::Scene& scene, const record::RunFolder& folder,
             const std::filesystem::path& program);

  /// What is to be said now: that it was started or why not; a bracket once, when it is there.
  [[nodiscard]] std::vector<std::string> news();
  /// Whether fpm-limit is still at work.
  [[nodiscard]] bool pending();
  /// How the plateau of the curve lies to the bracket, in some lines; "" without a bracket.
  [[nodiscard]] std::string verdict(const std::vector<record::CurveRow>& curve) const;

 private:
  void collect(int exit_code);
  [[nodiscard]] std::filesystem::path record() const { return folder_ / "bracket.json"; }
  [[nodiscard]] std::filesystem::path output() const { return folder_ / "fpm-limit.log"; }

  const scene::Scene& scene_;
  std::filesystem::path folder_;
  std::unique_ptr<program::ChildProcess> process_;
  std::vector<std::string> news_;
};

}  // namespace bounds
