#include "record/curve_file.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "files/durable_file.hpp"

namespace record {

namespace {

/// Splits off the next line of `rest`; false at the end or if the line is unfinished.
bool next_line(std::string_view& rest, std::string_view& line) {
  const std::size_t end = rest.find('\n');
  if (end == std::string_view::npos) return false;
  line = rest.substr(0, end);
  rest.remove_prefix(end + 1);
  return true;
}

CurveRow row_in(const std::filesystem::path& file, std::string_view line, std::size_t number,
                const CurveColumns& columns) {
  try {
    return parse_curve_line(line, columns.measures.size());
  } catch (const std::invalid_argument& failure) {
    throw files::FileError(file, fmt::format("line {}: {}", number, failure.what()));
  }
}

/// Splits off the header.
CurveColumns columns_in(const std::filesystem::path& file, std::string_view& rest) {
  std::string_view line;
  const auto columns = next_line(rest, line) ? parse_curve_header(line) : std::nullopt;
  if (!columns) throw files::FileError(file, "does not begin with the header of a curve");
  return *columns;
}

}  // namespace

std::vector<CurveRow> read_curve(const std::filesystem::path& file) {
  const std::string text = files::read_text(file);
  std::string_view rest = text, line;
  const CurveColumns columns = columns_in(file, rest);
  std::vector<CurveRow> rows;
  while (next_line(rest, line)) rows.push_back(row_in(file, line, rows.size() + 2, columns));
  if (!rest.empty()) throw files::FileError(file, "ends in the middle of a line");
  return rows;
}

CurveColumns read_curve_columns(const std::filesystem::path& file) {
  const std::string text = files::read_text(file);
  std::string_view rest = text;
  return columns_in(file, rest);
}

CurveFile CurveFile::create(const std::filesystem::path& file, const CurveColumns& columns,
                            const files::SystemCalls& system) {
  files::write_text_durably(file, curve_header(columns) + "\n", system);
  return {file, system};
}

CurveFile CurveFile::resume(const std::filesystem::path& file, const std::filesystem::path& source,
                            const CurveColumns& columns, std::int64_t step,
                            const files::SystemCalls& system) {
  const std::string text = files::read_text(source);
  std::string_view rest = text, line;
  if (!next_line(rest, line) || line != curve_header(columns)) {
    throw files::FileError(source, "does not begin with the header of this curve");
  }
  std::size_t kept = text.size() - rest.size();
  std::int64_t reached = -1;  // a curve may begin with step 0
  for (std::size_t number = 2; reached < step && next_line(rest, line); ++number) {
    const CurveRow row = row_in(source, line, number, columns);
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
