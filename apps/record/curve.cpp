#include "record/curve.hpp"

#include <fmt/format.h>

#include <charconv>
#include <stdexcept>

#include "files/durable_file.hpp"

namespace record {

namespace {

template <class Number>
Number parse_number(std::string_view text, std::string_view column) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data(), end, value);
  if (failure != std::errc{} || stop != end) {
    throw std::invalid_argument(fmt::format("{} is no number in column {}", text, column));
  }
  return value;
}

/// Splits off the next line of `rest`; false at the end or if the line is unfinished.
bool next_line(std::string_view& rest, std::string_view& line) {
  const std::size_t end = rest.find('\n');
  if (end == std::string_view::npos) return false;
  line = rest.substr(0, end);
  rest.remove_prefix(end + 1);
  return true;
}

CurveRow row_in(const std::filesystem::path& file, std::string_view line, std::size_t number) {
  try {
    return parse_curve_line(line);
  } catch (const std::invalid_argument& failure) {
    throw files::FileError(file, fmt::format("line {}: {}", number, failure.what()));
  }
}

}  // namespace

const std::vector<CurveColumn>& curve_columns() {
  static const std::vector<CurveColumn> columns{
      {"step", "", &CurveRow::step},
      {"load_parameter", "", &CurveRow::load_parameter},
      {"settlement_m", "", &CurveRow::settlement},
      {"settlement_over_B", "", &CurveRow::settlement_over_B},
      {"reaction_N_per_m", "reaction_N", &CurveRow::reaction},
      {"mean_pressure_Pa", "", &CurveRow::mean_pressure},
      {"corrected_pressure_Pa", "", &CurveRow::corrected_pressure},
      {"increment_m", "", &CurveRow::increment},
      {"newton_iterations", "", &CurveRow::newton_iterations},
      {"residual_evaluations", "", &CurveRow::residual_evaluations},
      {"jacobian_actions", "", &CurveRow::jacobian_actions},
      {"evaluations", "", &CurveRow::evaluations},
      {"cuts", "", &CurveRow::cuts},
      {"plastic_particles", "", &CurveRow::plastic_particles},
      {"researched_rows", "", &CurveRow::re_searched_rows},
      {"residual_ratio", "", &CurveRow::residual_ratio},
      {"max_plastic_strain", "", &CurveRow::max_plastic_strain},
      {"hourglass_work_ratio", "", &CurveRow::hourglass_work_ratio},
      {"wall_s", "", &CurveRow::wall},
  };
  return columns;
}

std::string curve_header(int dimension) {
  std::string line;
  for (const CurveColumn& column : curve_columns()) {
    if (!line.empty()) line += ',';
    line += dimension == 3 && !column.name_3d.empty() ? column.name_3d : column.name;
  }
  return line;
}

std::string curve_line(const CurveRow& row) {
  std::string line;
  for (const CurveColumn& column : curve_columns()) {
    if (!line.empty()) line += ',';
    // fmt writes a double in the shortest form that reads back to it.
    std::visit([&](auto member) { line += fmt::format("{}", row.*member); }, column.member);
  }
  return line;
}

CurveRow parse_curve_line(std::string_view line) {
  CurveRow row;
  const auto& columns = curve_columns();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::size_t comma = line.find(',');
    const bool last = i + 1 == columns.size();
    if ((comma == std::string_view::npos) != last) {
      throw std::invalid_argument(fmt::format("there are not {} columns", columns.size()));
    }
    const std::string_view text = line.substr(0, comma);
    if (const auto* integer = std::get_if<std::int64_t CurveRow::*>(&columns[i].member)) {
      row.** integer = parse_number<std::int64_t>(text, columns[i].name);
    } else {
      row.*std::get<double CurveRow::*>(columns[i].member) =
          parse_number<double>(text, columns[i].name);
    }
    if (!last) line.remove_prefix(comma + 1);
  }
  return row;
}

std::vector<CurveRow> read_curve(const std::filesystem::path& file) {
  const std::string text = files::read_text(file);
  std::string_view rest = text, line;
  if (!next_line(rest, line) || (line != curve_header(2) && line != curve_header(3))) {
    throw files::FileError(file, "does not begin with the header of a curve");
  }
  std::vector<CurveRow> rows;
  while (next_line(rest, line)) rows.push_back(row_in(file, line, rows.size() + 2));
  if (!rest.empty()) throw files::FileError(file, "ends in the middle of a line");
  return rows;
}

CurveFile CurveFile::create(const std::filesystem::path& file, int dimension,
                            const files::SystemCalls& system) {
  files::write_text_durably(file, curve_header(dimension) + "\n", system);
  return {file, system};
}

CurveFile CurveFile::resume(const std::filesystem::path& file, const std::filesystem::path& source,
                            int dimension, std::int64_t step, const files::SystemCalls& system) {
  const std::string text = files::read_text(source);
  std::string_view rest = text, line;
  if (!next_line(rest, line) || line != curve_header(dimension)) {
    throw files::FileError(source, "does not begin with the header of this curve");
  }
  std::size_t kept = text.size() - rest.size();
  std::int64_t reached = -1;  // a curve may begin with step 0
  for (std::size_t number = 2; reached < step && next_line(rest, line); ++number) {
    const CurveRow row = row_in(source, line, number);
    if (row.step > step) break;
    if (row.step <= reached) {
      throw files::FileError(
          source, fmt::format("line {}: step {} after step {}", number, row.step, reached));
    }
    reached = row.step;
    kept = text.size() - rest.size();
  }
  if (reached < step && step > 0) {
    throw files::FileError(source,
                           fmt::format("has no row of step {}, which the checkpoint is of", step));
  }
  files::write_text_durably(file, std::string_view(text).substr(0, kept), system);
  return {file, system};
}

}  // namespace record
