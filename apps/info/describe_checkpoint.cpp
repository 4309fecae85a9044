#include "info/describe_checkpoint.hpp"

#include <fmt/format.h>

#include <iterator>

#include "scene/changes.hpp"

namespace info {

using record::Ancestor;
using record::CheckpointNotes;
using record::CurveRow;

namespace {

// Whether it can still be found under its name; it may have been moved, which does no harm.
std::string ancestor_text(const Ancestor& ancestor) {
  std::error_code failure;
  const bool found = std::filesystem::exists(ancestor.checkpoint, failure);
  std::string text = fmt::format("step {} of {}", ancestor.step, ancestor.checkpoint);
  if (!ancestor.created.empty()) text += ", written " + ancestor.created;
  if (!ancestor.identity.empty()) text += ", identity " + ancestor.identity;
  return found ? text : text + " (no longer there)";
}

std::string place_text(const CurveRow& row) {
  return fmt::format("step {}, load {:.6g}, settlement {:.6g} m, mean pressure {:.6g} Pa", row.step,
                     row.load_parameter, row.settlement, row.mean_pressure);
}

}  // namespace

std::string checkpoint_line(const CheckpointNotes& notes) {
  const CurveRow& row = notes.history.back();
  return fmt::format("step {}, load {:.6g}, written {}, {}", row.step, row.load_parameter,
                     notes.created, notes.reason);
}

std::string describe_checkpoint(const CheckpointNotes& notes) {
  std::string out;
  const auto line = [&out](std::string_view name, const std::string& value) {
    fmt::format_to(std::back_inserter(out), "  {:<12} {}\n", name, value);
  };
  line("what", fmt::format("checkpoint of {}, {}D", notes.title.empty() ? "a run" : notes.title,
                           notes.dimension));
  line("where", place_text(notes.history.back()));
  line("when", notes.created);
  line("why", notes.reason);
  line("written by", fmt::format("{}; schema {}", notes.versions, notes.schema));
  line("identity", record::identity_of(notes.digest));
  if (notes.lineage.empty()) line("lineage", "from the start in one go");
  for (std::size_t i = notes.lineage.size(); i-- > 0;) {
    const bool parent = i + 1 == notes.lineage.size();
    line(parent ? "parent" : "before that", ancestor_text(notes.lineage[i]));
    for (const std::string& change : notes.lineage[i].changed) line("", "changed: " + change);
  }
  line("may change", scene::what_may_change());
  return out;
}

}  // namespace info
