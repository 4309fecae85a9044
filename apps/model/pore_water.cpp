#include "model/pore_water.hpp"

#include <cmath>

#include "scene/scene.hpp"
#include "scene/water.hpp"

namespace model {
namespace {

// Whether a particle stands for its cell and nothing else.
template <int Dim>
bool is_whole(const Model<Dim>& model, Eigen::Index a) {
  const auto cell = static_cast<fpm::Index>(a);
  const double volume = (model.cells.upper(cell) - model.cells.lower(cell)).prod();
  constexpr double rounding = 1e-9;
  return std::abs(model.particles.volume[a] - volume) <= rounding * volume;
}

}  // namespace

template <int Dim>
void add_pore_water(const scene::Scene& scene, Model<Dim>& model) {
  if (!scene::has_water(scene)) return;
  const scene::PoreWater water(scene);
  const bool is_told = scene.water.pore_pressure.has_value();
  const Eigen::Index n = model.size();
  model.pore_pressure.resize(n);
  model.water_load.setZero(model.unknowns());
  for (Eigen::Index a = 0; a < n; ++a) {
    const auto cell = static_cast<fpm::Index>(a);
    const fpm::Vector<Dim> place = model.particles.position.row(a).transpose();
    // Of a cell that was cut, what is left is as wet as the whole below a table; where the pressure
    // is told, which is of the ground alone, as a square around it, and so is an element.
    const bool is_cell = model.cells.size() > 0 && (!is_told || is_whole(model, a));
    const fpm::Vector<Dim> half =
        fpm::Vector<Dim>::Constant(0.5 * std::pow(model.particles.volume[a], 1.0 / Dim));
    const fpm::Vector<Dim> lower = is_cell ? model.cells.lower(cell) : place - half;
    const fpm::Vector<Dim> upper = is_cell ? model.cells.upper(cell) : place + half;
    const auto part =
        water.in_cell(lower.template head<2>(), upper.template head<2>(), place.template head<2>());
    const scene::Material& material = scene.material[model.material[static_cast<std::size_t>(a)]];
    const std::span<const double> at(place.data(), Dim);
    model.mass[a] += part.wet *
                     (scene::saturated_density(material, at) - material.density.at_place(at)) *
                     model.particles.volume[a];
    model.pore_pressure[a] = water.pressure_at({place.data(), Dim});
    for (int i = 0; i < 2; ++i) {
      model.water_load[i * n + a] = model.particles.volume[a] * part.force[i];
    }
  }
}

template void add_pore_water<2>(const scene::Scene&, Model<2>&);
template void add_pore_water<3>(const scene::Scene&, Model<3>&);

}  // namespace model
