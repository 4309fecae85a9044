#include "model/carry.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "model/search_again.hpp"

namespace model {
namespace {

// What a point of an interface is known again by.
template <int Dim>
using FaceKey = std::pair<std::string, std::array<double, 2 * Dim>>;

template <int Dim>
FaceKey<Dim> key_of(const Interface<Dim>& interface, Eigen::Index c) {
  FaceKey<Dim> key;
  if (interface.is_rigid()) key.first = "rigid " + interface.support;
  if (!interface.of_drive.empty()) key.first = "plate " + interface.of_drive;
  for (int i = 0; i < Dim; ++i) {
    key.second[static_cast<std::size_t>(i)] = interface.faces.points.position(c, i);
    key.second[static_cast<std::size_t>(Dim + i)] = interface.faces.points.normal(c, i);
  }
  return key;
}

// Calls visit(interface, point of it, point of all).
template <class Model, class Visitor>
void for_each_point(Model& model, Visitor&& visit) {
  Eigen::Index k = 0;
  for (auto& interface : model.interfaces) {
    for (Eigen::Index c = 0; c < interface.faces.points.size(); ++c) visit(interface, c, k++);
  }
}

template <int Dim>
std::map<FaceKey<Dim>, std::pair<const Interface<Dim>*, std::array<Eigen::Index, 2>>> faces_of(
    const Model<Dim>& model) {
  std::map<FaceKey<Dim>, std::pair<const Interface<Dim>*, std::array<Eigen::Index, 2>>> faces;
  for_each_point(model, [&](const Interface<Dim>& interface, Eigen::Index c, Eigen::Index k) {
    faces.try_emplace(key_of(interface, c), &interface, std::array<Eigen::Index, 2>{c, k});
  });
  return faces;
}

// Into a particle field, whichever way it lies.
template <class Matrix>
void carry_field(const Matrix& from, const std::vector<fpm::Index>& source, Matrix& to) {
  if (from.size() == 0 || to.size() == 0) return;
  for (std::size_t k = 0; k < source.size(); ++k) {
    const auto a = static_cast<Eigen::Index>(k), b = static_cast<Eigen::Index>(source[k]);
    if (b < 0) continue;
    if constexpr (Matrix::ColsAtCompileTime == Eigen::Dynamic) {
      to.col(a) = from.col(b);
    } else {
      to.row(a) = from.row(b);
    }
  }
}

template <int Dim>
void carry_particles(State<Dim>& before, const std::vector<fpm::Index>& source, State<Dim>& after) {
  after.for_each_particle_field([&](std::string_view name, const char*, auto& to) {
    before.for_each_particle_field([&](std::string_view other, const char*, const auto& from) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(from)>,
                                   std::remove_cvref_t<decltype(to)>>) {
        if (name == other) carry_field(from, source, to);
      }
    });
  });
}

// New particles lie on the ground as it is.
template <int Dim>
void settle_new_particles(const Model<Dim>& before, const State<Dim>& state,
                          const Model<Dim>& after, const std::vector<fpm::Index>& source,
                          State<Dim>& carried) {
  for (fpm::Index a = 0; a < static_cast<fpm::Index>(source.size()); ++a) {
    if (source[static_cast<std::size_t>(a)] >= 0) continue;
    Eigen::Index nearest = 0;
    (before.particles.position.rowwise() - after.particles.position.row(a))
        .rowwise()
        .squaredNorm()
        .minCoeff(&nearest);
    carried.displacement.row(a) = state.displacement.row(nearest);
  }
}

// Which particles are of another material than they were. Materials of the scene are the same in
// all stages, and in the same order.
template <int Dim>
std::vector<char> exchanged_particles(const Model<Dim>& before, const Model<Dim>& after,
                                      const std::vector<fpm::Index>& source) {
  std::vector<char> exchanged(source.size(), 0);
  for (std::size_t a = 0; a < source.size(); ++a) {
    const fpm::Index b = source[a];
    if (b >= 0) exchanged[a] = before.material[static_cast<std::size_t>(b)] != after.material[a];
  }
  return exchanged;
}

// What the former material has suffered is no hardening of the new one.
template <int Dim>
void forget_plastic_strains(const std::vector<char>& exchanged, State<Dim>& carried) {
  for (Eigen::VectorXd* strain : {&carried.plastic_strain, &carried.plastic_volume_strain,
                                  &carried.plastic_strain_at_search, &carried.plastic_increment}) {
    for (Eigen::Index a = 0; a < strain->size(); ++a) {
      if (exchanged[static_cast<std::size_t>(a)] != 0) (*strain)[a] = 0.0;
    }
  }
}

// A row that sees new particles, or others of another material than they were, has no memory of a
// shape that they, as they are, were no part of.
template <int Dim>
void forget_shapes(const Model<Dim>& after, const std::vector<fpm::Index>& source,
                   const std::vector<char>& exchanged, State<Dim>& carried) {
  if (carried.released.size() == 0) return;
  const auto n = static_cast<fpm::Index>(source.size());
  const auto is_new = [&](fpm::Index b) {
    const auto a = static_cast<std::size_t>(b < n ? b : after.ghosts.source(b - n));
    return source[a] < 0 || exchanged[a] != 0;
  };
  for (fpm::Index a = 0; a < n; ++a) {
    if (is_new(a) || std::ranges::any_of(carried.rows.neighbours(a), is_new)) {
      carried.released[a] = 1.0;
    }
  }
}

// The slip with which springs that have become stiffer or softer bear what they did.
template <int Dim>
fpm::Vector<Dim> slip_of_springs(const Interface<Dim>& was, Eigen::Index at,
                                 const Interface<Dim>& is, Eigen::Index c,
                                 const fpm::Vector<Dim>& slip, const fpm::Vector<Dim>& traction,
                                 const fpm::Vector<Dim>& gap) {
  const double ratio = was.stiffness[at] / is.stiffness[c];
  const bool closed = is.law.tied || is.law.tension ||
                      traction.dot(is.faces.points.normal.row(c).transpose()) < 0.0;
  // A plate's own motion is no part of this gap; what is open has no springs.
  if (ratio == 1.0 || is.plate || !closed) return slip;
  return gap - ratio * (gap - slip);
}

template <int Dim>
void carry_faces(const Model<Dim>& before, const State<Dim>& state, const Model<Dim>& after,
                 double load, State<Dim>& carried) {
  const auto known = faces_of(before);
  for_each_point(after, [&](const Interface<Dim>& interface, Eigen::Index c, Eigen::Index k) {
    const auto found = known.find(key_of(interface, c));
    const fpm::Vector<Dim> motion = interface.held + load * interface.drive;
    const fpm::Vector<Dim> gap =
        interface.faces.gap(static_cast<fpm::Index>(c), carried.displacement, motion);
    if (found == known.end()) {
      carried.interface_slip.col(k) = gap;
      return;
    }
    const auto& [was, at] = found->second;
    carried.interface_traction.col(k) = state.interface_traction.col(at[1]);
    carried.interface_slip.col(k) =
        slip_of_springs<Dim>(*was, at[0], interface, c, state.interface_slip.col(at[1]),
                             state.interface_traction.col(at[1]), gap);
  });
}

// What is known by its place stays; what begins holds where the ground is.
template <int Dim>
void carry_penalties(const Model<Dim>& before, const State<Dim>& state, const Model<Dim>& after,
                     State<Dim>& carried) {
  using Place = std::pair<std::string, std::array<double, static_cast<std::size_t>(Dim)>>;
  const auto visit_points = [](const Model<Dim>& model, auto&& visit) {
    Eigen::Index k = 0;
    for (const PenaltySupport<Dim>& support : model.penalty_supports) {
      for (Eigen::Index c = 0; c < support.points.weight.size(); ++c, ++k) {
        Place place{support.name, {}};
        for (int i = 0; i < Dim; ++i) {
          place.second[static_cast<std::size_t>(i)] = support.points.position(c, i);
        }
        visit(support, static_cast<fpm::Index>(c), k, place);
      }
    }
  };
  std::map<Place, Eigen::Index> known;
  visit_points(before, [&](const auto&, fpm::Index, Eigen::Index k, const Place& place) {
    known.emplace(place, k);
  });
  visit_points(after, [&](const auto& support, fpm::Index c, Eigen::Index k, const Place& place) {
    const auto found = known.find(place);
    if (found != known.end()) {
      carried.penalty_target.row(k) = state.penalty_target.row(found->second);
    } else {
      carried.penalty_target.row(k) = support.op.value(c, carried.displacement).transpose();
    }
  });
}

// Plates are known by their drives.
template <int Dim>
void carry_plates(const Model<Dim>& before, const State<Dim>& state, const Model<Dim>& after,
                  State<Dim>& carried) {
  std::map<std::string, Eigen::Index> known;
  for (const Interface<Dim>& interface : before.interfaces) {
    if (interface.plate) known.emplace(interface.of_drive, static_cast<Eigen::Index>(known.size()));
  }
  Eigen::Index k = 0;
  for (const Interface<Dim>& interface : after.interfaces) {
    if (!interface.plate) continue;
    const auto found = known.find(interface.of_drive);
    if (found != known.end()) {
      carried.plate_displacement.col(k) = state.plate_displacement.col(found->second);
      carried.plate_rotation.col(k) = state.plate_rotation.col(found->second);
    }
    ++k;
  }
}

// By their centroids, which stay what they are whatever regions are there.
template <int Dim>
std::vector<fpm::Index> same_elements(const Model<Dim>& of, const Model<Dim>& in) {
  using Place = std::array<double, static_cast<std::size_t>(Dim)>;
  const auto place_of = [](const Model<Dim>& model, Eigen::Index a) {
    Place place{};
    for (int i = 0; i < Dim; ++i) {
      place[static_cast<std::size_t>(i)] = model.particles.position(a, i);
    }
    return place;
  };
  std::map<Place, fpm::Index> known;
  for (Eigen::Index b = 0; b < in.size(); ++b) {
    known.emplace(place_of(in, b), static_cast<fpm::Index>(b));
  }
  std::vector<fpm::Index> source;
  for (Eigen::Index a = 0; a < of.size(); ++a) {
    const auto found = known.find(place_of(of, a));
    source.push_back(found == known.end() ? -1 : found->second);
  }
  return source;
}

}  // namespace

template <int Dim>
std::vector<fpm::Index> same_particles(const Model<Dim>& of, const Model<Dim>& in) {
  if (of.cells.size() == 0) return same_elements(of, in);
  std::vector<fpm::Index> source;
  for (fpm::Index a = 0; a < static_cast<fpm::Index>(of.size()); ++a) {
    const fpm::Vector<Dim> site = of.cells.site(a);
    const fpm::Index b = in.cells.containing(site);
    source.push_back(b >= 0 && in.cells.site(b) == site ? b : -1);
  }
  return source;
}

template <int Dim>
void carry_initial_tractions(const Model<Dim>& before, Model<Dim>& after) {
  const auto known = faces_of(before);
  for_each_point(after, [&](Interface<Dim>& interface, Eigen::Index c, Eigen::Index) {
    const auto found = known.find(key_of(interface, c));
    const bool is_known = found != known.end();
    interface.initial_traction.row(c).setZero();
    if (is_known) {
      const auto& [other, at] = found->second;
      interface.initial_traction.row(c) = other->initial_traction.row(at[0]);
    }
  });
}

template <int Dim>
void keep_consolidation(const Model<Dim>& first, Model<Dim>& after) {
  const std::vector<fpm::Index> source = same_particles(after, first);
  std::map<LawIndex, LawIndex> known;
  for (std::size_t a = 0; a < source.size(); ++a) {
    if (source[a] < 0) continue;
    const auto b = static_cast<std::size_t>(source[a]);
    const LawIndex of_first = first.law[b];
    const bool is_clay =
        std::holds_alternative<constitutive::ModifiedCamClay>(first.laws[of_first]);
    if (!is_clay || first.material[b] != after.material[a]) continue;
    const auto [at, is_new] = known.try_emplace(of_first, static_cast<LawIndex>(after.laws.size()));
    if (is_new) {
      after.laws.push_back(first.laws[of_first]);
      after.youngs_modulus.push_back(first.youngs_modulus[of_first]);
    }
    after.law[a] = at->second;
  }
}

template <int Dim>
State<Dim> carry_state(const Model<Dim>& before, State<Dim>& state, const Model<Dim>& after,
                       bool keeps_rows, double load) {
  State<Dim> carried;
  carried.layout = after.layout;
  carried.resize(after.size(), after.interface_points(), after.penalty_points(), after.plates());
  carried.programme = state.programme;
  const std::vector<fpm::Index> source = same_particles(after, before);
  carry_particles(state, source, carried);
  carried.rows =
      keeps_rows ? state.rows : fpm::Rows<Dim>(after.particles, after.ghosts, after.row_options);
  settle_new_particles(before, state, after, source, carried);
  if (!keeps_rows) search_again(state, source, after, load, carried);
  const std::vector<char> exchanged = exchanged_particles(before, after, source);
  if (!keeps_rows) forget_shapes(after, source, exchanged, carried);
  forget_plastic_strains(exchanged, carried);
  carry_faces(before, state, after, load, carried);
  carry_penalties(before, state, after, carried);
  carry_plates(before, state, after, carried);
  return carried;
}

template std::vector<fpm::Index> same_particles<2>(const Model<2>&, const Model<2>&);
template std::vector<fpm::Index> same_particles<3>(const Model<3>&, const Model<3>&);
template void carry_initial_tractions<2>(const Model<2>&, Model<2>&);
template void carry_initial_tractions<3>(const Model<3>&, Model<3>&);
template void keep_consolidation<2>(const Model<2>&, Model<2>&);
template void keep_consolidation<3>(const Model<3>&, Model<3>&);
template State<2> carry_state<2>(const Model<2>&, State<2>&, const Model<2>&, bool, double);
template State<3> carry_state<3>(const Model<3>&, State<3>&, const Model<3>&, bool, double);

}  // namespace model
