#include "fpm/carried_consistency.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "consistency_solver.hpp"
#include "consistency_system.hpp"

namespace fpm {
namespace {

template <int Dim>
using Weights = Eigen::Matrix<double, Dim, Eigen::Dynamic>;

template <int Dim>
Tensor<Dim> gradient_of(const ReSearchedConfiguration<Dim>& now, Index a) {
  return Eigen::Map<const Tensor<Dim>>(now.deformation_gradient.col(a).data());
}

// Sums of areas by particle; an image's belongs to its source, with the sign of the component.
template <int Dim>
class Areas {
 public:
  Areas(const Ghosts<Dim>& ghosts, Index n) : ghosts_(ghosts), n_(n) {}

  void add(Index row, Index b, const Vector<Dim>& area) {
    sum(row) -= area;
    if (b < n_) {
      sum(b) += area;
      return;
    }
    Vector<Dim>& source = sum(ghosts_.source(b - n_));
    for (int i = 0; i < Dim; ++i) source[i] += ghosts_.sign(b - n_, i) * area[i];
  }

  const std::map<Index, Vector<Dim>>& sums() const { return sums_; }

 private:
  Vector<Dim>& sum(Index b) { return sums_.try_emplace(b, Vector<Dim>::Zero()).first->second; }

  const Ghosts<Dim>& ghosts_;
  Index n_;
  std::map<Index, Vector<Dim>> sums_;
};

// A row to be corrected: G += scale kappa T (F^T nu), which adds factor kappa T nu to the areas.
template <int Dim>
struct CorrectedRow {
  Index row = 0;
  double scale = 0.0;
  double factor = 0.0;
  Tensor<Dim> gradient = Tensor<Dim>::Identity();
};

template <int Dim>
class Carrier {
 public:
  Carrier(const MomentOperator<Dim>& before, const Ghosts<Dim>& ghosts,
          const std::vector<Index>& rebuilt, const ReSearchedConfiguration<Dim>& now,
          Rows<Dim>& rows)
      : before_(before), ghosts_(ghosts), rebuilt_(rebuilt), now_(now), rows_(rows) {}

  CarriedConsistency run() {
    find_change();
    choose_rows();
    CarriedConsistency carried;
    carried.left = solve();
    const std::vector<Index> corrected = correct();
    std::ranges::set_union(rebuilt_, corrected, std::back_inserter(carried.rows));
    return carried;
  }

 private:
  void weigh(Index a) {
    rows_.geometry(a, geometry_);
    compute_weights(geometry_, rows_.options().kernel, false, weights_);
  }

  // Of the areas, by the rebuilt rows: old minus new.
  void find_change() {
    Areas<Dim> change(ghosts_, rows_.size());
    for (const Index a : rebuilt_) {
      const Tensor<Dim> pull = now_.volume[a] * gradient_of(now_, a).inverse().transpose();
      before_.for_each_entry(a, [&](Index b, const double* w) {
        const Vector<Dim> area = pull * Eigen::Map<const Vector<Dim>>(w);
        change.add(a, b, area);
        size_of_areas_ += area.squaredNorm();
      });
      weigh(a);
      Eigen::Index k = 0;
      for (const Index b : rows_.neighbours(a)) {
        change.add(a, b, -now_.volume[a] * weights_.gradient.col(k++));
      }
    }
    change_ = change.sums();
  }

  void choose_rows() {
    const std::set<Index> anew(rebuilt_.begin(), rebuilt_.end());
    std::set<Index> nodes;
    for (const auto& [a, missing] : change_) {
      const double volume = now_.volume[a];
      if (anew.contains(a)) {
        chosen_.push_back({a, volume, volume * volume, Tensor<Dim>::Identity()});
      } else {
        const double reference = rows_.reference_volume()[a];
        chosen_.push_back({a, reference, volume * reference, gradient_of(now_, a)});
      }
      nodes.insert(a);
      for (const Index b : rows_.neighbours(a)) nodes.insert(source(b));
    }
    for (const Index b : nodes) local_.emplace(b, static_cast<Index>(local_.size()));
  }

  Index source(Index b) const { return b < rows_.size() ? b : ghosts_.source(b - rows_.size()); }
  double sign(Index b, int i) const {
    return b < rows_.size() ? 1.0 : ghosts_.sign(b - rows_.size(), i);
  }

  Eigen::SparseMatrix<double> matrix_of(int component) {
    detail::ConsistencySystem<Dim> normal(static_cast<Index>(local_.size()));
    std::vector<Index> id;
    std::vector<double> signs;
    for (const CorrectedRow<Dim>& each : chosen_) {
      weigh(each.row);
      id.assign(1, local_.at(each.row));
      signs.assign(1, 1.0);
      for (const Index b : rows_.neighbours(each.row)) {
        id.push_back(local_.at(source(b)));
        signs.push_back(sign(b, component));
      }
      normal.add(id, signs, geometry_, weights_, each.factor);
    }
    return normal.lower();
  }

  double solve() {
    const auto n = static_cast<Eigen::Index>(local_.size());
    Field<Dim> missing = Field<Dim>::Zero(n, Dim);
    for (const auto& [b, area] : change_) missing.row(local_.at(b)) = area.transpose();
    const double round_off = detail::area_round_off * std::sqrt(size_of_areas_);
    potential_.setZero(n, Dim);
    double left = 0.0;
    std::optional<detail::ConsistencySolver> solver;
    for (int i = 0; i < Dim; ++i) {
      if (i == 0 || ghosts_.size() > 0) {
        solver.emplace(matrix_of(i), detail::SolutionMethod::factors);
      }
      const auto solution = solver->solve(missing.col(i), round_off);
      potential_.col(i) = solution.x;
      left += solution.residual * solution.residual;
    }
    const double size = missing.norm();
    return size <= round_off ? 0.0 : std::sqrt(left) / size;
  }

  // Returns the corrected rows, ascending.
  std::vector<Index> correct() {
    std::vector<Index> corrected;
    std::vector<Weights<Dim>> all;
    for (const CorrectedRow<Dim>& each : chosen_) {
      weigh(each.row);
      const auto list = rows_.neighbours(each.row);
      Weights<Dim> difference(Dim, geometry_.size());
      const auto own = potential_.row(local_.at(each.row));
      for (Eigen::Index k = 0; k < geometry_.size(); ++k) {
        const Index b = list[static_cast<std::size_t>(k)];
        const auto other = potential_.row(local_.at(source(b)));
        for (int i = 0; i < Dim; ++i) difference(i, k) = sign(b, i) * other[i] - own[i];
      }
      Weights<Dim> added =
          each.scale * detail::weighted_remainder<Dim>(geometry_, weights_,
                                                       each.gradient.transpose() * difference);
      if (!std::ranges::binary_search(rebuilt_, each.row)) added += correction_before(each.row);
      corrected.push_back(each.row);
      all.push_back(std::move(added));
    }
    rows_.correct(corrected, all);
    std::ranges::sort(corrected);
    return corrected;
  }

  // Of a row that was not rebuilt; weights_ are its own.
  Weights<Dim> correction_before(Index a) const {
    Weights<Dim> correction = -weights_.gradient;
    const auto list = rows_.neighbours(a);
    before_.for_each_entry(a, [&](Index b, const double* w) {
      const auto k = std::ranges::lower_bound(list, b) - list.begin();
      correction.col(k) += Eigen::Map<const Vector<Dim>>(w);
    });
    return correction;
  }

  const MomentOperator<Dim>& before_;
  const Ghosts<Dim>& ghosts_;
  const std::vector<Index>& rebuilt_;
  const ReSearchedConfiguration<Dim>& now_;
  Rows<Dim>& rows_;
  RowGeometry<Dim> geometry_;
  RowWeights<Dim> weights_;
  std::map<Index, Vector<Dim>> change_;
  double size_of_areas_ = 0.0;  // [m^(2 Dim - 2)] sum of squares
  std::vector<CorrectedRow<Dim>> chosen_;
  std::map<Index, Index> local_;  // number of a particle in the system
  Field<Dim> potential_;
};

}  // namespace

template <int Dim>
CarriedConsistency carry_consistency(const MomentOperator<Dim>& before, const Ghosts<Dim>& ghosts,
                                     const std::vector<Index>& rebuilt,
                                     const ReSearchedConfiguration<Dim>& now, Rows<Dim>& rows) {
  require_size("rows of the operator", before.size(), rows.size());
  require_size("volumes", now.volume.size(), rows.size());
  require_size("deformation gradients", now.deformation_gradient.cols(), rows.size());
  if (rebuilt.empty()) return {};
  return Carrier<Dim>(before, ghosts, rebuilt, now, rows).run();
}

template CarriedConsistency carry_consistency<2>(const MomentOperator<2>&, const Ghosts<2>&,
                                                 const std::vector<Index>&,
                                                 const ReSearchedConfiguration<2>&, Rows<2>&);
template CarriedConsistency carry_consistency<3>(const MomentOperator<3>&, const Ghosts<3>&,
                                                 const std::vector<Index>&,
                                                 const ReSearchedConfiguration<3>&, Rows<3>&);

}  // namespace fpm
