#pragma once

#include <string>
#include <vector>

#include "study/grid.hpp"
#include "study/quantity.hpp"
#include "study/results.hpp"

namespace study {

/// All that a study has found.
struct Findings {
  std::string scene;  // as the user named its file
  std::vector<Vary> varied;
  Quantity quantity;
  Reference reference;
  std::vector<Result> results;
  std::vector<Order> orders;
};

/// For the terminal: a line per run, the front marked, then the orders.
[[nodiscard]] std::string table_text(const Findings& findings);
/// A line per run, units in the names of the columns; what there is not is left empty.
[[nodiscard]] std::string csv_text(const Findings& findings);
[[nodiscard]] std::string json_text(const Findings& findings);
/// Error over processor time, both logarithmic, the front joined and named.
[[nodiscard]] std::string picture_text(const Findings& findings);

}  // namespace study
