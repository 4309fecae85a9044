#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "fpm/ghosts.hpp"
#include "fpm/kernel.hpp"
#include "fpm/particles.hpp"
#include "fpm/stencil.hpp"
#include "fpm/types.hpp"

namespace fpm {

/// How neighbourhoods are chosen.
struct RowOptions {
  Kernel kernel = Kernel::cubic_spline;
  double support_radius = 0.0;  ///< [m] R > 0; 2.4 spacings is usual. Where the spacing is a
                                ///< multiple of the finest (ParticleSet::spacing), so is R
  double spacing = 0.0;         ///< [m] > 0, the finest; offsets within round-off of a multiple of
                         ///< half of it are taken as that, so that lattice rows share stencils
  bool second = false;           ///< the rows must also carry second-gradient weights
  double max_condition = 1e4;    ///< a row with a larger condition number of M or A is not accepted
  double max_enlargement = 2.0;  ///< the first search widens R up to this factor for a poor row

  /// Fewest neighbours (itself excluded) of an acceptable row.
  template <int Dim>
  int min_neighbours() const {
    const int fit = Dim == 2 ? 5 : 9;
    return second && fit > Dim + 2 ? fit : Dim + 2;
  }
};

/// [m] R of a particle before any widening: as many of its own spacings as the options say.
template <int Dim>
double support_radius_of(const ParticleSet<Dim>& particles, Index particle,
                         const RowOptions& options) {
  if (particles.spacing.size() == 0) return options.support_radius;
  return options.support_radius * (particles.spacing[particle] / options.spacing);
}

/// Images of the particles behind planes as far as the widest supports of rows may reach for them.
template <int Dim>
Ghosts<Dim> make_ghosts(const ParticleSet<Dim>& particles,
                        const std::vector<GhostPlane<Dim>>& planes, const RowOptions& options);

/// There are too few particles around one, or around a point, or they lie too unevenly, for a row
/// or an operator.
class PoorNeighbourhood : public std::runtime_error {
 public:
  PoorNeighbourhood(const std::string& what, Index index)
      : std::runtime_error(what), index_(index) {}
  /// Number of the particle or the point.
  [[nodiscard]] Index index() const { return index_; }

 private:
  Index index_;
};

/// The reference configuration of every row: its neighbours and where they were, with what
/// volumes, when the row was last searched. This is primary state: together with the initial
/// particles it determines every weight, bit for bit.
///
/// Rows that were never re-searched refer to the initial particles and store neighbours only.
template <int Dim>
class Rows {
 public:
  Rows() = default;

  /// First search, on the initial particles, among those of the row's own body. A row with too few
  /// neighbours or an ill-conditioned moment matrix gets a wider support and, if none will do, as
  /// at the tip of a wedge, sees all bodies.
  /// @throws PoorNeighbourhood naming the particle if no admissible support gives a valid row.
  Rows(const ParticleSet<Dim>& particles, const Ghosts<Dim>& ghosts, const RowOptions& options);

  Index size() const { return static_cast<Index>(support_radius_.size()); }
  const RowOptions& options() const { return options_; }
  /// Round-off of the difference of two initial coordinates [m]: it grows with the distance from
  /// the origin.
  double coordinate_round_off() const { return round_off_; }

  /// Neighbours of a row, itself excluded, ascending; indices >= size() are ghosts.
  std::span<const Index> neighbours(Index row) const;

  /// Whether the row was re-searched since the start.
  bool searched(Index row) const { return slot_[static_cast<std::size_t>(row)] >= 0; }

  /// Whether all rows are as the first search left them.
  bool as_first_searched() const { return searched_row_.empty() && corrected_row_.empty(); }

  /// Offsets and volumes of a row's neighbours in its reference configuration.
  void geometry(Index row, RowGeometry<Dim>& geometry) const;

  /// What a row's gradient weights have been given besides (carried_consistency.hpp), Dim per
  /// neighbour; empty for nothing.
  std::span<const double> correction(Index row) const;

  /// Gives rows such weights, in place of those they had.
  /// @param rows  in any order
  /// @param weights  [1/m] of each of them, Dim x neighbours
  /// @throws ShapeError if sizes disagree or a row does not exist.
  void correct(const std::vector<Index>& rows,
               const std::vector<Eigen::Matrix<double, Dim, Eigen::Dynamic>>& weights);

  /// [m^Dim] Volume of each particle in its row's reference configuration, Vref.
  const Eigen::VectorXd& reference_volume() const { return reference_volume_; }

  /// Rebuilds the given rows on current positions and volumes (local re-search; paper section
  /// 4.3). `excluded[b]` bars particle b from being picked up as a *new* neighbour (rigid plates).
  /// A row that would end up with too few neighbours or ill-conditioned keeps its old reference.
  /// @param rows  in any order
  /// @param position  [m] current positions
  /// @param volume  [m^Dim] current volumes
  /// @param plane_motion  [m] displacement of each plane of the ghosts, or empty for none
  /// @returns the rows that were rebuilt, ascending.
  /// @throws ShapeError if sizes disagree or a row does not exist.
  std::vector<Index> research(const std::vector<Index>& rows, const Field<Dim>& position,
                              const Eigen::VectorXd& volume, const std::vector<char>& excluded,
                              const std::vector<Vector<Dim>>& plane_motion = {});

  /// Visits what a checkpoint must hold: visit(name, unit, vector).
  template <class Visitor>
  void for_each_field(Visitor&& visit) {
    visit("row_offset", "-", row_offset_);
    visit("neighbour", "-", neighbour_);
    visit("support_radius", "m", support_radius_);
    visit("reference_volume", "m^d", reference_volume_);
    visit("searched_row", "-", searched_row_);
    visit("searched_offset", "m", searched_offset_);
    visit("searched_volume", "m^d", searched_volume_);
    visit("corrected_row", "-", corrected_row_);
    visit("correction", "1/m", correction_);
  }

  /// Rebuilds what follows from the visited fields; call after reading them.
  /// @throws ShapeError if the fields contradict each other, refer to particles that do not exist
  /// or hold a radius or volume that is not positive.
  void restore(const ParticleSet<Dim>& particles, const Ghosts<Dim>& ghosts,
               const RowOptions& options);

 private:
  bool same_body(Index row, Index b) const;
  bool sees_all(Index row) const {
    return !sees_all_.empty() && sees_all_[static_cast<std::size_t>(row)] != 0;
  }
  bool accept(const RowGeometry<Dim>& geometry, RowWeights<Dim>& scratch) const;
  void rewrite(const std::vector<Index>& rebuilt, const std::vector<std::vector<Index>>& new_lists,
               const std::vector<RowGeometry<Dim>>& new_geometry);
  void index_searched_rows();
  void index_corrected_rows();
  void set_initial(const ParticleSet<Dim>& particles, const Ghosts<Dim>& ghosts);

  RowOptions options_;
  Field<Dim> initial_position_;     // ghosts included
  Eigen::VectorXd initial_volume_;  // ghosts included
  Ghosts<Dim> ghosts_;
  std::vector<Index> body_;     // of the particles; empty: one
  std::vector<char> sees_all_;  // whether a row sees all bodies; empty: none does
  double round_off_ = 0.0;      // [m] of a difference of initial positions

  std::vector<Index> row_offset_{0};  // CSR over all rows
  std::vector<Index> neighbour_;
  Eigen::VectorXd support_radius_;
  Eigen::VectorXd reference_volume_;
  std::vector<Index> searched_row_;      // ascending
  std::vector<double> searched_offset_;  // Dim per neighbour of the searched rows, in their order
  std::vector<double> searched_volume_;
  std::vector<Index> slot_;                   // per row: start in searched_volume_, or -1
  std::vector<Index> corrected_row_;          // ascending
  std::vector<double> correction_;            // Dim per neighbour of those rows, in their order
  std::vector<std::size_t> correction_slot_;  // of each of those rows: start in correction_
};

}  // namespace fpm
