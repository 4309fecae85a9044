#include "material/report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "picture/picture.hpp"

namespace material {

namespace {

double shear_stress(const Point& point) {
  return std::sqrt(3.0 * constitutive::j2(point.state.stress));
}

double shear_strain(const Point& point) {
  const Strain tensor = constitutive::with_tensor_shear(point.strain);
  return std::sqrt(4.0 / 3.0 * constitutive::j2(tensor));
}

std::string name_of(const Path& path, std::size_t stage) {
  const Stage& one = path.stage[stage];
  return one.name.empty() ? std::string(names_of(one.test)[static_cast<std::size_t>(one.test)])
                          : one.name;
}

template <class Value>
std::string picture_of(const Path& path, const Course& course, const std::string& axis,
                       const Value& value) {
  picture::Picture all{path.title, {"deviatoric strain", false}, {axis, false}, {}};
  for (const Point& point : course.points) {
    if (point.step == 0)
      all.series.push_back({name_of(path, point.stage), {}, {}, true, false, {}});
    all.series.back().x.push_back(shear_strain(point));
    all.series.back().y.push_back(value(point));
  }
  return picture::svg_text(all);
}

}  // namespace

std::string csv_text(const Course& course) {
  std::string out =
      "stage,step,strain_xx,strain_yy,strain_zz,strain_xy,strain_yz,strain_zx,stress_xx_Pa,"
      "stress_yy_Pa,stress_zz_Pa,stress_xy_Pa,stress_yz_Pa,stress_zx_Pa,mean_stress_Pa,"
      "deviatoric_stress_Pa,volume_strain,deviatoric_strain,plastic_strain,plastic_volume_strain,"
      "plastic,apex,tangent_error\n";
  for (const Point& point : course.points) {
    fmt::format_to(std::back_inserter(out), "{},{}", point.stage, point.step);
    for (const double value : point.strain) fmt::format_to(std::back_inserter(out), ",{}", value);
    for (const double value : point.state.stress) {
      fmt::format_to(std::back_inserter(out), ",{}", value);
    }
    fmt::format_to(std::back_inserter(out), ",{},{},{},{},{},{},{},{},{}\n",
                   constitutive::mean_stress(point.state.stress), shear_stress(point),
                   constitutive::trace(point.strain), shear_strain(point),
                   point.state.plastic_strain, point.state.plastic_volume_strain,
                   point.plastic ? 1 : 0, point.apex ? 1 : 0,
                   std::isnan(point.tangent_error) ? "" : fmt::format("{}", point.tangent_error));
  }
  return out;
}

std::string shear_picture(const Path& path, const Course& course) {
  return picture_of(path, course, "deviatoric stress [Pa]", shear_stress);
}

std::string volume_picture(const Path& path, const Course& course) {
  return picture_of(path, course, "volume strain",
                    [](const Point& point) { return constitutive::trace(point.strain); });
}

std::string summary(const Path& path, const Course& course) {
  std::string out;
  std::size_t checked = 0, corners = 0;
  double worst = 0.0;
  for (std::size_t i = 0; i < course.points.size(); ++i) {
    const Point& point = course.points[i];
    if (point.step > 0 && std::isnan(point.tangent_error)) ++corners;
    if (point.step > 0 && !std::isnan(point.tangent_error)) {
      ++checked;
      worst = std::max(worst, point.tangent_error);
    }
    const bool last = i + 1 == course.points.size() || course.points[i + 1].stage != point.stage;
    if (!last) continue;
    fmt::format_to(std::back_inserter(out),
                   "  {}: mean stress {:.6g} Pa, deviatoric {:.6g} Pa at volume strain {:.4g}, "
                   "deviatoric strain {:.4g}{}\n",
                   name_of(path, point.stage), constitutive::mean_stress(point.state.stress),
                   shear_stress(point), constitutive::trace(point.strain), shear_strain(point),
                   point.apex      ? ", at the apex"
                   : point.plastic ? ", yielding"
                                   : "");
  }
  if (checked + corners > 0) {
    fmt::format_to(std::back_inserter(out),
                   "  tangent: within {:.1e} E of differences at {} steps; {} end on a corner\n",
                   worst, checked, corners);
  }
  return out;
}

}  // namespace material
