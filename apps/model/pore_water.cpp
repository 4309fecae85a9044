#include "model/pore_water.hpp"

#include <cmath>

#include "scene/scene.hpp"
#include "scene/water.hpp"

namespace model {

template <int Dim>
void add_pore_water(const scene::Scene& scene, Model<Dim>& model) {
  if (!scene::has_water(scene)) return;
  const scene::PoreWater water(scene);
  const Eigen::Index n = model.size();
  model.pore_pressure.resize(n);
  model.water_load.setZero(model.unknowns());
  for (Eigen::Index a = 0; a < n; ++a) {
    const auto cell = static_cast<fpm::Index>(a);
    const fpm::Vector<Dim> place = model.particles.position.row(a).transpose();
    // Of a cell that was cut, what is left is as wet as the whole, and an element as a square
    // around it.
    const bool is_cell = model.cells.size() > 0;
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
