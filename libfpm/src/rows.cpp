#include "fpm/rows.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>
#include <string>

#include "fpm/neighbour_search.hpp"
#include "place_text.hpp"
#include "snap.hpp"

namespace fpm {
namespace {

template <int Dim>
Field<Dim> with_ghosts(const Field<Dim>& position, const Ghosts<Dim>& ghosts) {
  Field<Dim> extended(position.rows() + ghosts.size(), Dim);
  extended.topRows(position.rows()) = position;
  ghosts.extend_positions(extended.data(), position.rows(), extended.rows());
  return extended;
}

template <int Dim>
Eigen::VectorXd with_ghosts(const Eigen::VectorXd& volume, const Ghosts<Dim>& ghosts) {
  Eigen::VectorXd extended(volume.size() + ghosts.size());
  extended.head(volume.size()) = volume;
  for (Index g = 0; g < ghosts.size(); ++g) extended[volume.size() + g] = volume[ghosts.source(g)];
  return extended;
}

}  // namespace

template <int Dim>
Ghosts<Dim> make_ghosts(const ParticleSet<Dim>& particles,
                        const std::vector<GhostPlane<Dim>>& planes, const RowOptions& options) {
  const double widest = options.max_enlargement * options.support_radius;
  if (particles.spacing.size() == 0 || planes.empty()) {
    return Ghosts<Dim>(particles.position, planes, widest);
  }
  require_size("spacings", particles.spacing.size(), particles.size());
  // No row is nearer to an image than to its source: whoever may see the one sees the other.
  Eigen::VectorXd reach(particles.size());
  for (Index a = 0; a < particles.size(); ++a) {
    reach[a] = options.max_enlargement * support_radius_of(particles, a, options);
  }
  const Eigen::VectorXd own = reach;
  const NeighbourSearch<Dim> search(particles.position);
  std::vector<Index> found;
  for (Index a = 0; a < particles.size(); ++a) {
    const Vector<Dim> place = particles.position.row(a).transpose();
    const bool near = std::ranges::any_of(planes, [&](const GhostPlane<Dim>& plane) {
      return std::abs(place[plane.axis] - plane.position) < own[a];
    });
    if (!near) continue;
    search.within(place, own[a], found);
    for (const Index b : found) reach[b] = std::max(reach[b], own[a]);
  }
  return Ghosts<Dim>(particles.position, planes, reach);
}

template <int Dim>
void Rows<Dim>::set_initial(const ParticleSet<Dim>& particles, const Ghosts<Dim>& ghosts) {
  if (!particles.body.empty()) {
    require_size("bodies", static_cast<Eigen::Index>(particles.body.size()), particles.size());
  }
  ghosts_ = ghosts;
  body_ = particles.body;
  initial_position_ = with_ghosts<Dim>(particles.position, ghosts);
  initial_volume_ = with_ghosts<Dim>(particles.volume, ghosts);
  round_off_ = difference_round_off<Dim>(initial_position_);
}

template <int Dim>
Rows<Dim>::Rows(const ParticleSet<Dim>& particles, const Ghosts<Dim>& ghosts,
                const RowOptions& options)
    : options_(options) {
  require_size("particle volumes", particles.volume.size(), particles.size());
  if (!(options.support_radius > 0.0)) {
    throw std::invalid_argument("the support radius must be positive");
  }
  set_initial(particles, ghosts);
  const Index n = particles.size();
  if (particles.spacing.size() > 0) require_size("spacings", particles.spacing.size(), n);
  support_radius_.resize(n);
  reference_volume_ = particles.volume;
  slot_.assign(static_cast<std::size_t>(n), -1);

  const NeighbourSearch<Dim> search(initial_position_);
  std::vector<Index> found;
  RowGeometry<Dim> row;
  RowWeights<Dim> scratch;
  for (Index a = 0; a < n; ++a) {
    constexpr double growth = 1.05;
    const double narrowest = support_radius_of(particles, a, options);
    double radius = narrowest;
    for (;; radius *= growth) {
      if (radius > options.max_enlargement * narrowest && !body_.empty() && !sees_all(a)) {
        sees_all_.resize(static_cast<std::size_t>(n), 0);
        sees_all_[static_cast<std::size_t>(a)] = 1;
        radius = narrowest;
      }
      if (radius > options.max_enlargement * narrowest) {
        throw PoorNeighbourhood("particle " + std::to_string(a) + " at " +
                                    text_of<Dim>(initial_position_.row(a)) +
                                    " m has no well-conditioned neighbourhood within " +
                                    text_of(options.max_enlargement) + " support radii",
                                a);
      }
      search.within(initial_position_.row(a).transpose(), radius, found);
      const Vector<Dim> place = initial_position_.row(a).transpose();
      std::erase_if(found, [&](Index b) {
        return b == a || !same_body(a, b) || (b >= n && !ghosts.visible_from(place, b - n));
      });
      neighbour_.resize(static_cast<std::size_t>(row_offset_.back()));
      neighbour_.insert(neighbour_.end(), found.begin(), found.end());
      row_offset_.push_back(static_cast<Index>(neighbour_.size()));
      support_radius_[a] = radius;
      geometry(a, row);
      if (accept(row, scratch)) break;
      row_offset_.pop_back();
    }
  }
}

template <int Dim>
std::span<const Index> Rows<Dim>::neighbours(Index row) const {
  const auto begin = static_cast<std::size_t>(row_offset_[static_cast<std::size_t>(row)]);
  const auto end = static_cast<std::size_t>(row_offset_[static_cast<std::size_t>(row) + 1]);
  return {neighbour_.data() + begin, end - begin};
}

template <int Dim>
void Rows<Dim>::geometry(Index row, RowGeometry<Dim>& geometry) const {
  const auto list = neighbours(row);
  const auto count = static_cast<Eigen::Index>(list.size());
  geometry.offset.resize(Dim, count);
  geometry.volume.resize(count);
  geometry.own_volume = reference_volume_[row];
  geometry.support_radius = support_radius_[row];
  const Index slot = slot_[static_cast<std::size_t>(row)];
  for (Eigen::Index k = 0; k < count; ++k) {
    if (slot >= 0) {
      const auto at = static_cast<std::size_t>(slot + k);
      for (int i = 0; i < Dim; ++i) geometry.offset(i, k) = searched_offset_[at * Dim + i];
      geometry.volume[k] = searched_volume_[at];
    } else {
      const Index b = list[static_cast<std::size_t>(k)];
      geometry.offset.col(k) =
          snapped<Dim>((initial_position_.row(b) - initial_position_.row(row)).transpose(),
                       0.5 * options_.spacing, round_off_);
      geometry.volume[k] = initial_volume_[b];
    }
  }
}

// An image is of its source's body.
template <int Dim>
bool Rows<Dim>::same_body(Index row, Index b) const {
  if (body_.empty()) return true;
  const Index particle = b < size() ? b : ghosts_.source(b - size());
  return body_[static_cast<std::size_t>(particle)] == body_[static_cast<std::size_t>(row)] ||
         sees_all(row);
}

template <int Dim>
std::span<const double> Rows<Dim>::correction(Index row) const {
  const auto at = std::ranges::lower_bound(corrected_row_, row);
  if (at == corrected_row_.end() || *at != row) return {};
  const auto k = static_cast<std::size_t>(at - corrected_row_.begin());
  return {correction_.data() + correction_slot_[k], neighbours(row).size() * Dim};
}

template <int Dim>
void Rows<Dim>::correct(const std::vector<Index>& rows,
                        const std::vector<Eigen::Matrix<double, Dim, Eigen::Dynamic>>& weights) {
  require_size("corrections", static_cast<Eigen::Index>(weights.size()),
               static_cast<Eigen::Index>(rows.size()));
  std::map<Index, std::vector<double>> all;
  for (const Index a : corrected_row_) {
    const auto kept = correction(a);
    all[a].assign(kept.begin(), kept.end());
  }
  for (std::size_t k = 0; k < rows.size(); ++k) {
    all[rows[k]].assign(weights[k].data(), weights[k].data() + weights[k].size());
  }
  corrected_row_.clear();
  correction_.clear();
  for (const auto& [row, values] : all) {
    corrected_row_.push_back(row);
    correction_.insert(correction_.end(), values.begin(), values.end());
  }
  index_corrected_rows();
}

template <int Dim>
bool Rows<Dim>::accept(const RowGeometry<Dim>& row, RowWeights<Dim>& scratch) const {
  if (row.size() < options_.min_neighbours<Dim>()) return false;
  compute_weights(row, options_.kernel, options_.second, scratch);
  // Negated so that a NaN is refused.
  return !(!(scratch.condition <= options_.max_condition) ||
           !(scratch.second_condition <= options_.max_condition));
}

template <int Dim>
std::vector<Index> Rows<Dim>::research(const std::vector<Index>& rows, const Field<Dim>& position,
                                       const Eigen::VectorXd& volume,
                                       const std::vector<char>& excluded,
                                       const std::vector<Vector<Dim>>& plane_motion) {
  require_size("positions", position.rows(), size());
  require_size("volumes", volume.size(), size());
  require_size("excluded", static_cast<Eigen::Index>(excluded.size()), size());
  Field<Dim> now = with_ghosts<Dim>(position, ghosts_);
  if (!plane_motion.empty()) now.bottomRows(ghosts_.size()) += ghosts_.of_motion(plane_motion);
  const Eigen::VectorXd volume_now = with_ghosts<Dim>(volume, ghosts_);
  const NeighbourSearch<Dim> search(now);
  const std::set<Index> wanted(rows.begin(), rows.end());
  if (!wanted.empty() && (*wanted.begin() < 0 || *wanted.rbegin() >= size())) {
    const Index wrong = *wanted.begin() < 0 ? *wanted.begin() : *wanted.rbegin();
    throw ShapeError("row " + std::to_string(wrong) + " of " + std::to_string(size()));
  }

  std::vector<Index> rebuilt;
  std::vector<std::vector<Index>> new_lists;
  std::vector<RowGeometry<Dim>> new_geometry;
  RowWeights<Dim> scratch;
  for (const Index a : wanted) {
    const auto old = neighbours(a);
    std::vector<Index> found;
    search.within(now.row(a).transpose(), support_radius_[a], found);
    std::erase_if(found, [&](Index b) {
      const Index particle = b < size() ? b : ghosts_.source(b - size());
      if (b >= size() &&
          !(ghosts_.visible_from(now.row(a).transpose(), b - size(), plane_motion) &&
            ghosts_.stands_for(now.row(particle).transpose(), b - size(), plane_motion))) {
        return true;
      }
      return b == a || !same_body(a, b) ||
             (excluded[static_cast<std::size_t>(particle)] != 0 &&
              !std::binary_search(old.begin(), old.end(), b));
    });
    RowGeometry<Dim> row;
    row.offset.resize(Dim, static_cast<Eigen::Index>(found.size()));
    row.volume.resize(static_cast<Eigen::Index>(found.size()));
    row.own_volume = volume_now[a];
    row.support_radius = support_radius_[a];
    for (std::size_t k = 0; k < found.size(); ++k) {
      row.offset.col(static_cast<Eigen::Index>(k)) = (now.row(found[k]) - now.row(a)).transpose();
      row.volume[static_cast<Eigen::Index>(k)] = volume_now[found[k]];
    }
    if (!accept(row, scratch)) continue;
    rebuilt.push_back(a);
    new_lists.push_back(std::move(found));
    new_geometry.push_back(std::move(row));
  }
  if (rebuilt.empty()) return rebuilt;

  rewrite(rebuilt, new_lists, new_geometry);
  return rebuilt;
}

// Old rows as they were, rebuilt ones from their new lists.
template <int Dim>
void Rows<Dim>::rewrite(const std::vector<Index>& rebuilt,
                        const std::vector<std::vector<Index>>& new_lists,
                        const std::vector<RowGeometry<Dim>>& new_geometry) {
  const Rows<Dim> old = *this;
  row_offset_.assign(1, 0);
  neighbour_.clear();
  searched_row_.clear();
  searched_offset_.clear();
  searched_volume_.clear();
  corrected_row_.clear();
  correction_.clear();
  RowGeometry<Dim> kept;
  std::size_t next = 0;
  for (Index a = 0; a < size(); ++a) {
    const bool is_new = next < rebuilt.size() && rebuilt[next] == a;
    const auto list = is_new ? std::span<const Index>(new_lists[next]) : old.neighbours(a);
    neighbour_.insert(neighbour_.end(), list.begin(), list.end());
    row_offset_.push_back(static_cast<Index>(neighbour_.size()));
    if (const auto correction = old.correction(a); !is_new && !correction.empty()) {
      corrected_row_.push_back(a);
      correction_.insert(correction_.end(), correction.begin(), correction.end());
    }
    if (!is_new && !old.searched(a)) continue;
    if (!is_new) old.geometry(a, kept);
    const RowGeometry<Dim>& row = is_new ? new_geometry[next] : kept;
    searched_row_.push_back(a);
    searched_offset_.insert(searched_offset_.end(), row.offset.data(),
                            row.offset.data() + row.offset.size());
    searched_volume_.insert(searched_volume_.end(), row.volume.data(),
                            row.volume.data() + row.volume.size());
    reference_volume_[a] = row.own_volume;
    if (is_new) ++next;
  }
  index_searched_rows();
  index_corrected_rows();
}

template <int Dim>
void Rows<Dim>::index_corrected_rows() {
  if (std::ranges::adjacent_find(corrected_row_, std::greater_equal<>()) != corrected_row_.end()) {
    throw ShapeError("corrected rows must ascend");
  }
  correction_slot_.clear();
  std::size_t at = 0;
  for (const Index a : corrected_row_) {
    if (a < 0 || a >= size()) {
      throw ShapeError("corrected row " + std::to_string(a) + " of " + std::to_string(size()));
    }
    correction_slot_.push_back(at);
    at += neighbours(a).size() * Dim;
  }
  require_size("corrections of rows", static_cast<Eigen::Index>(correction_.size()),
               static_cast<Eigen::Index>(at));
}

template <int Dim>
void Rows<Dim>::index_searched_rows() {
  if (std::ranges::adjacent_find(searched_row_, std::greater_equal<>()) != searched_row_.end()) {
    throw ShapeError("re-searched rows must ascend");
  }
  slot_.assign(static_cast<std::size_t>(size()), -1);
  Index at = 0;
  for (const Index a : searched_row_) {
    if (a < 0 || a >= size()) {
      throw ShapeError("re-searched row " + std::to_string(a) + " of " + std::to_string(size()));
    }
    slot_[static_cast<std::size_t>(a)] = at;
    at += static_cast<Index>(neighbours(a).size());
  }
  require_size("volumes of re-searched rows", static_cast<Eigen::Index>(searched_volume_.size()),
               at);
  require_size("offsets of re-searched rows", static_cast<Eigen::Index>(searched_offset_.size()),
               static_cast<Eigen::Index>(at) * Dim);
}

template <int Dim>
void Rows<Dim>::restore(const ParticleSet<Dim>& particles, const Ghosts<Dim>& ghosts,
                        const RowOptions& options) {
  options_ = options;
  set_initial(particles, ghosts);
  const Eigen::Index n = particles.size();
  require_size("support radii", support_radius_.size(), n);
  require_size("reference volumes", reference_volume_.size(), n);
  require_size("row offsets", static_cast<Eigen::Index>(row_offset_.size()), n + 1);
  if (row_offset_.front() != 0 || !std::is_sorted(row_offset_.begin(), row_offset_.end())) {
    throw ShapeError("row offsets must start at 0 and not decrease");
  }
  require_size("neighbours", static_cast<Eigen::Index>(neighbour_.size()), row_offset_.back());
  for (const Index b : neighbour_) {
    if (b < 0 || b >= n + ghosts.size()) {
      throw ShapeError("neighbour " + std::to_string(b) + " of " +
                       std::to_string(n + ghosts.size()) + " particles and ghosts");
    }
  }
  for (Index a = 0; a < n; ++a) {
    const std::string row = " of row " + std::to_string(a);
    const auto list = neighbours(a);
    if (std::ranges::adjacent_find(list, std::greater_equal<>()) != list.end() ||
        std::ranges::binary_search(list, a)) {
      throw ShapeError("neighbours" + row + " must ascend and leave out its own particle");
    }
    if (!(support_radius_[a] > 0.0)) throw ShapeError("support radius" + row + " is not positive");
    if (!(reference_volume_[a] > 0.0)) {
      throw ShapeError("reference volume" + row + " is not positive");
    }
  }
  index_searched_rows();
  index_corrected_rows();
}

template Ghosts<2> make_ghosts<2>(const ParticleSet<2>&, const std::vector<GhostPlane<2>>&,
                                  const RowOptions&);
template Ghosts<3> make_ghosts<3>(const ParticleSet<3>&, const std::vector<GhostPlane<3>>&,
                                  const RowOptions&);
template class Rows<2>;
template class Rows<3>;

}  // namespace fpm
