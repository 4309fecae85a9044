#include "fpm/particles.hpp"

#include <cmath>
#include <stdexcept>

#include "jitter.hpp"

namespace fpm {

template <int Dim>
Eigen::Matrix<Index, Dim, 1> lattice_cells(const LatticeOptions<Dim>& options) {
  constexpr double tolerance = 1e-6;
  if (!(options.spacing > 0.0)) throw std::invalid_argument("lattice spacing must be positive");
  Eigen::Matrix<Index, Dim, 1> cells;
  for (int i = 0; i < Dim; ++i) {
    const double count = (options.max[i] - options.min[i]) / options.spacing;
    cells[i] = static_cast<Index>(std::lround(count));
    if (cells[i] < 1 || std::abs(count - cells[i]) > tolerance) {
      throw std::invalid_argument("the box is " + std::to_string(count) +
                                  " lattice spacings wide along axis " + std::to_string(i) +
                                  "; a whole number of at least 1 is needed");
    }
  }
  return cells;
}

template <int Dim>
ParticleSet<Dim> make_lattice(const LatticeOptions<Dim>& options) {
  detail::check_jitter(options.jitter);
  const auto cells = lattice_cells(options);
  const bool vertex = options.layout == LatticeLayout::vertex;
  const Eigen::Matrix<Index, Dim, 1> count =
      vertex ? Eigen::Matrix<Index, Dim, 1>(cells.array() + 1) : cells;
  const Eigen::Index n = count.template cast<Eigen::Index>().prod();

  ParticleSet<Dim> set;
  set.position.resize(n, Dim);
  set.volume.resize(n);
  std::uint64_t state = options.seed;
  const double cell_volume = std::pow(options.spacing, Dim);
  Eigen::Matrix<Index, Dim, 1> at = Eigen::Matrix<Index, Dim, 1>::Zero();
  for (Eigen::Index a = 0; a < n; ++a) {
    double volume = cell_volume;
    for (int i = 0; i < Dim; ++i) {
      const bool on_face = vertex && (at[i] == 0 || at[i] == cells[i]);
      if (on_face) volume *= 0.5;
      const double move = detail::uniform_minus_one_to_one(state) * options.jitter;
      const double step = at[i] + (vertex ? 0.0 : 0.5) + (on_face ? 0.0 : move);
      set.position(a, i) = options.min[i] + step * options.spacing;
    }
    set.volume[a] = volume;
    for (int i = 0; i < Dim; ++i) {
      if (++at[i] < count[i]) break;
      at[i] = 0;
    }
  }
  return set;
}

template Eigen::Matrix<Index, 2, 1> lattice_cells<2>(const LatticeOptions<2>&);
template Eigen::Matrix<Index, 3, 1> lattice_cells<3>(const LatticeOptions<3>&);
template ParticleSet<2> make_lattice<2>(const LatticeOptions<2>&);
template ParticleSet<3> make_lattice<3>(const LatticeOptions<3>&);

}  // namespace fpm
