#include "limit/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "files/durable_file.hpp"
#include "files/vtkhdf.hpp"
#include "limit/problem/local_soil.hpp"

namespace limit {

namespace {

problem::Soil soil_of(const problem::Case& problem, const mesh::Triangle& triangle,
                      const mesh::Point& place) {
  return problem::soil_at(problem.lower.soils[static_cast<std::size_t>(triangle.region)], place);
}

mesh::Point corner_of_triangle(const mesh::Mesh& mesh, const mesh::Triangle& triangle,
                               std::size_t corner) {
  return mesh.nodes[static_cast<std::size_t>(triangle.nodes[corner % 3])];
}

void write_grid(const std::filesystem::path& file, const std::vector<double>& points,
                const std::vector<files::PointField>& fields, const files::VtkCells& cells,
                const std::vector<files::PointField>& of_cells) {
  files::write_durably(file, [&](const std::filesystem::path& temporary) {
    files::Hdf5File grid = files::Hdf5File::create(temporary);
    files::write_vtkhdf(grid, points, fields, cells, of_cells);
    grid.close();
  });
}

// As text between XML's tags.
std::string escaped(const std::string& text) {
  std::string safe;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      default:
        safe += letter;
    }
  }
  return safe;
}

void put(std::vector<double>& values, std::initializer_list<double> more) {
  values.insert(values.end(), more);
}

}  // namespace

void write_fields(const std::filesystem::path& file, const problem::Case& problem,
                  const bracket::Bound<certificate::LowerCertificate>& bound) {
  const mesh::Mesh& mesh = bound.mesh;
  std::vector<double> points, stress, principal, direction, ratio;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const mesh::Point at = problem.units.length * corner_of_triangle(mesh, mesh.triangles[t], i);
      const Eigen::Vector3d s =
          problem.units.stress * bound.certificate.field[t].col(static_cast<Eigen::Index>(i));
      const double mean = (s[0] + s[1]) / 2, half = (s[0] - s[1]) / 2;
      const double radius = std::hypot(half, s[2]);
      const problem::Soil soil = soil_of(problem, mesh.triangles[t], at);
      const double strength = soil.is_curved() ? soil.envelope.radius_about(-mean)
                                               : soil.cohesion * std::cos(soil.friction_angle) -
                                                     mean * std::sin(soil.friction_angle);
      const double angle = std::atan2(s[2], half) / 2;
      put(points, {at.x(), at.y(), 0.0});
      // Across the plane the stress takes no part in plane-strain yield; the mean stands for it.
      put(stress, {s[0], s[1], mean, s[2], 0.0, 0.0});
      put(principal, {mean + radius, mean - radius, 0.0});
      put(direction, {std::cos(angle), std::sin(angle), 0.0});
      ratio.push_back(strength > 0.0 ? radius / strength : 1.0);
    }
  }
  const std::vector<files::PointField> fields{
      {"stress", problem.names.stress, 6, std::move(stress)},
      {"principal_stresses", problem.names.stress, 3, std::move(principal)},
      {"principal_direction", "", 3, std::move(direction)},
      {"utilisation", "", 1, std::move(ratio)}};
  write_grid(file, points, fields, {.type = 5, .points = 3}, {});
}

void write_fields(const std::filesystem::path& file, const problem::Case& problem,
                  const bracket::Bound<certificate::UpperCertificate>& bound) {
  const mesh::Mesh& mesh = bound.mesh;
  std::vector<double> points, velocity, dissipation;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const mesh::Triangle& triangle = mesh.triangles[t];
    for (std::size_t i = 0; i < 6; ++i) {
      const mesh::Point corner = corner_of_triangle(mesh, triangle, i);
      const mesh::Point at =
          problem.units.length *
          (i < 3 ? corner : mesh::Point((corner + corner_of_triangle(mesh, triangle, i + 1)) / 2));
      const auto v = bound.certificate.field.triangles[t].col(static_cast<Eigen::Index>(i));
      put(points, {at.x(), at.y(), 0.0});
      put(velocity, {v.x(), v.y(), 0.0});
    }
    const double area = mesh::twice_area(mesh, triangle) / 2 * problem.units.length;
    dissipation.push_back(bound.certificate.of_triangle[t] * problem.units.multiplier() / area);
  }
  const std::string per_length =
      (problem.unit.empty() ? "1" : problem.unit) + "/" + problem.names.length;
  write_grid(file, points, {{"velocity", "", 3, std::move(velocity)}}, {.type = 22, .points = 6},
             {{"dissipation", per_length, 1, std::move(dissipation)}});
}

void write_mechanism(const std::filesystem::path& file, const problem::Case& problem,
                     const bracket::Bound<certificate::UpperCertificate>& bound) {
  const mesh::Mesh& mesh = bound.mesh;
  const auto& field = bound.certificate.field.triangles;
  double fastest = 0.0, densest = 0.0;
  mesh::Point low = mesh.nodes.front(), high = low;
  for (std::size_t t = 0; t < field.size(); ++t) {
    fastest = std::max(fastest, field[t].colwise().norm().maxCoeff());
    densest = std::max(densest, bound.certificate.of_triangle[t] /
                                    std::sqrt(mesh::twice_area(mesh, mesh.triangles[t])));
  }
  for (const mesh::Point& node : mesh.nodes) {
    low = low.cwiseMin(node);
    high = high.cwiseMax(node);
  }
  // The fastest point moves by this part of a half width.
  constexpr double step = 0.2, pixels = 160.0;
  const double carried = fastest > 0.0 ? step / fastest : 0.0;
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(
      out,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{:.1f} {:.1f} {:.1f} {:.1f}\">"
      "\n<title>{}: mechanism of the upper bound {:.6g}{}</title>\n"
      "<g stroke=\"#555\" stroke-width=\"0.5\">\n",
      pixels * (low.x() - step), -pixels * (high.y() + step),
      pixels * (high.x() - low.x() + 2 * step), pixels * (high.y() - low.y() + 2 * step),
      escaped(problem.title), bound.certificate.multiplier * problem.units.multiplier(),
      problem.unit.empty() ? "" : " " + problem.unit);
  for (std::size_t t = 0; t < field.size(); ++t) {
    const double density =
        bound.certificate.of_triangle[t] / std::sqrt(mesh::twice_area(mesh, mesh.triangles[t]));
    const double shade = densest > 0.0 ? std::sqrt(std::max(0.0, density / densest)) : 0.0;
    fmt::format_to(out, "<path fill=\"rgb({0},{1},{1})\" d=\"M", 255 - std::lround(60 * shade),
                   255 - std::lround(225 * shade));
    for (std::size_t i = 0; i < 3; ++i) {
      const mesh::Point at = corner_of_triangle(mesh, mesh.triangles[t], i) +
                             carried * field[t].col(static_cast<Eigen::Index>(i));
      fmt::format_to(out, " {:.2f},{:.2f}", pixels * at.x(), -pixels * at.y());
    }
    text += " Z\"/>\n";
  }
  text += "</g>\n</svg>\n";
  files::write_text_durably(file, text);
}

}  // namespace limit
