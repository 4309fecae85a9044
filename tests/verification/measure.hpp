#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "fpm/points.hpp"
#include "run.hpp"

namespace verification {

/// Puts a measured number into the test's XML report, where the verification table is made from.
inline void report(const std::string& name, double value) {
  std::ostringstream text;
  text.precision(8);
  text << value;
  testing::Test::RecordProperty(name, text.str());
}

/// The rows of a CSV file of share/references, its header left out.
inline std::vector<std::vector<double>> reference_table(const std::string& name) {
  std::ifstream file(std::filesystem::path(FPM_REFERENCES) / name);
  if (!file) throw std::runtime_error("no reference " + name);
  std::vector<std::vector<double>> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream entries(line);
    std::vector<double> row;
    for (std::string entry; std::getline(entries, entry, ',');) row.push_back(std::stod(entry));
    rows.push_back(row);
  }
  return rows;
}

/// A file of share/references whose lines are `quantity,value`.
inline std::map<std::string, double> reference_values(const std::string& name) {
  std::ifstream file(std::filesystem::path(FPM_REFERENCES) / name);
  if (!file) throw std::runtime_error("no reference " + name);
  std::map<std::string, double> values;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    const auto comma = line.find(',');
    values[line.substr(0, comma)] = std::stod(line.substr(comma + 1));
  }
  return values;
}

/// Second column of a table between the two rows whose first column encloses x.
inline double interpolated(const std::vector<std::vector<double>>& table, double x) {
  for (std::size_t i = 1; i < table.size(); ++i) {
    if (x > table[i][0]) continue;
    const double t = (x - table[i - 1][0]) / (table[i][0] - table[i - 1][0]);
    return table[i - 1][1] + t * (table[i][1] - table[i - 1][1]);
  }
  throw std::runtime_error("beyond the table's range");
}

/// The method's own interpolation at points of the initial configuration (Chen, Huang & Lyamin
/// 2020, Eq. 5-10).
template <int Dim>
fpm::PointOperator<Dim> probe(const Run<Dim>& run, const fpm::Field<Dim>& points) {
  return {run.model.particles, run.model.ghosts, points, run.model.row_options};
}

/// The part of a row of values that alternates from one to the next, as a root mean square:
/// a_i = (f_{i-1} - 2 f_i + f_{i+1}) / 4 is A for f = A (-1)^i and f'' dx^2 / 4 for a smooth f.
inline double alternating_part(const std::vector<double>& f) {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < f.size(); ++i) {
    const double a = 0.25 * (f[i - 1] - 2.0 * f[i] + f[i + 1]);
    sum += a * a;
  }
  return std::sqrt(sum / static_cast<double>(f.size() - 2));
}

inline double root_mean_square(const std::vector<double>& f) {
  double sum = 0.0;
  for (const double x : f) sum += x * x;
  return std::sqrt(sum / static_cast<double>(f.size()));
}

/// p of an error that falls as spacing^p, from two spacings of the given ratio.
inline double convergence_order(double coarse_error, double fine_error, double ratio) {
  return std::log(std::abs(coarse_error / fine_error)) / std::log(ratio);
}

}  // namespace verification
