#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "study/final_run.hpp"

namespace scene {
struct Scene;
}

namespace study {

/// How fine a scene runs, in a word: as it is, or a point of the measured front of error and cost
/// to either side (share/doc/trade.md).
enum class Quality { draft, normal, fine };

/// @throws UsageError for another word.
[[nodiscard]] Quality parse_quality(const std::string& text);

/// What a quality changes of a scene, as --set takes it: of the spacings on offer that nearest to
/// twice or half its own, and of a draft ten times the tolerance, 0.01 at most. Nothing of normal;
/// no spacing where none is on offer on that side.
[[nodiscard]] std::vector<std::string> settings_of(Quality quality, const scene::Scene& scene);

/// Says the settings and becomes the run; with `only_say` only the former.
[[nodiscard]] program::ExitCode run_quality(FinalRun run, Quality quality, bool only_say,
                                            std::ostream& out, std::ostream& err);

}  // namespace study
