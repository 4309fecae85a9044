#pragma once

#include <type_traits>
#include <vector>

#include "fpm/ghosts.hpp"
#include "fpm/particles.hpp"
#include "fpm/rows.hpp"
#include "fpm/types.hpp"

namespace fpm {

/// A nodal field to read, n x Dim: a Field, or a Map over a solver's vector. No copy is made. (The
/// identity keeps it out of template argument deduction, so that either may be passed.)
template <int Dim>
using FieldView = std::type_identity_t<Eigen::Ref<const Field<Dim>>>;

/// A nodal field to add to, likewise.
template <int Dim>
using FieldTarget = std::type_identity_t<Eigen::Ref<Field<Dim>>>;

/// Corrected value and gradient operators at points that need not be particles, such as those of a
/// boundary (Chen, Huang & Lyamin 2020, Eq. 1-2 and 5-10): with q_b, p_b as in a row,
///   M_c = sum_b V_b q_b p_b^T,   [N_cb, g_cb] = V_b M_c^{-1} q_b.
/// Linear fields are reproduced to round-off, also outside the hull of the particles.
///
/// Images are folded onto their particles with the sign of each component, so everything here
/// takes and returns fields of the n particles. All sums run in a fixed order; nothing allocates
/// after construction.
template <int Dim>
class PointOperator {
 public:
  PointOperator() = default;

  /// @param particles  where the operator's fields live, in its reference configuration
  /// @param ghosts  their images; made with a reach of the widest support
  /// @param points  [m] m x Dim
  /// @param own  particle of each point: those of its body serve the point, and the support is as
  ///   wide as its own; empty: the nearest
  /// @param options  kernel and support; a point with fewer than Dim + 2 neighbours or a poor
  ///   condition number gets a support wider by up to `max_enlargement`
  /// @throws PoorNeighbourhood, with the point's number and place, if no admissible support gives a
  ///   valid operator;
  ///   std::invalid_argument if an option is out of range; ShapeError if sizes disagree.
  PointOperator(const ParticleSet<Dim>& particles, const Ghosts<Dim>& ghosts,
                const Field<Dim>& points, const RowOptions& options,
                const std::vector<Index>& own = {});

  /// The operator at particles whose value is the particle's own (N_cb = 1 for b = particle[c],
  /// otherwise 0) and whose gradient is the corrected one: boundary terms lumped to particles.
  /// @throws ShapeError if a particle does not exist; otherwise as the constructor.
  static PointOperator at_particles(const ParticleSet<Dim>& particles, const Ghosts<Dim>& ghosts,
                                    const std::vector<Index>& particle, const RowOptions& options);

  /// Number of points.
  Index size() const { return static_cast<Index>(offset_.size()) - 1; }
  /// Number of particles of the fields.
  Index particle_count() const { return particle_count_; }

  /// Value of a vector field at one point, sum_b N_cb u_b.
  Vector<Dim> value(Index point, const FieldView<Dim>& field) const;
  /// Value of a scalar field (n) at one point; an image has its particle's value.
  double scalar_value(Index point, const Eigen::Ref<const Eigen::VectorXd>& field) const;
  /// Gradient of a vector field at one point, (i, J) = du_i / dX_J. A constant field without images
  /// gives zero exactly.
  Tensor<Dim> gradient(Index point, const FieldView<Dim>& field) const;
  /// force_b += N_cb f, the transpose of `value`.
  void add_transposed_value(Index point, const Vector<Dim>& point_force,
                            FieldTarget<Dim> force) const;

  /// Calls visit(particle, N_cb, sign) for what serves a point: a particle, or an image of it with
  /// the sign of each component.
  template <class Visitor>
  void for_each_value(Index point, Visitor&& visit) const {
    for_each_entry(point,
                   [&](const Entry& entry) { visit(entry.particle, entry.value, entry.sign); });
  }

  /// `value` at every point, m x Dim. @throws ShapeError if sizes disagree.
  void values(const FieldView<Dim>& field, FieldTarget<Dim> result) const;
  /// `gradient` at every point; component (i, J) in column J Dim + i of `result` (m x Dim^2).
  /// @throws ShapeError if sizes disagree.
  void gradients(const FieldView<Dim>& field, FieldTarget<Dim * Dim> result) const;
  /// force_b += sum_c N_cb f_c, the exact transpose of `values`: sum force = sum point_forces.
  /// @throws ShapeError if sizes disagree.
  void add_transposed_values(const FieldView<Dim>& point_forces, FieldTarget<Dim> force) const;

  /// Support radius of a point [m], after any widening.
  double support_radius(Index point) const {
    return support_radius_[static_cast<std::size_t>(point)];
  }

 private:
  /// One neighbour of a point: a particle, or an image of it with its signs.
  struct Entry {
    Index particle;
    double value;
    Vector<Dim> gradient;
    Vector<Dim> sign;

    Vector<Dim> image(const FieldView<Dim>& field) const {
      return sign.cwiseProduct(field.row(particle).transpose());
    }
  };

  template <class Visitor>
  void for_each_entry(Index point, Visitor&& visit) const {
    const auto c = static_cast<std::size_t>(point);
    for (std::size_t k = offset_[c]; k < offset_[c + 1]; ++k) visit(entries_[k]);
  }
  bool append_point(const ParticleSet<Dim>& particles, const Ghosts<Dim>& ghosts,
                    const std::vector<Index>& found,
                    const Eigen::Matrix<double, Dim, Eigen::Dynamic>& offset, double radius,
                    const RowOptions& options);

  Index particle_count_ = 0;
  std::vector<std::size_t> offset_{0};
  std::vector<Entry> entries_;
  std::vector<double> support_radius_;
};

}  // namespace fpm
