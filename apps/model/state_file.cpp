#include "model/state_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <type_traits>

namespace model {

namespace {

const std::string particle_group = "/state/particles/";
const std::string row_group = "/state/rows/";
const std::string interface_group = "/state/interfaces/";
const std::string penalty_group = "/state/penalties/";
const std::string plate_group = "/state/plates/";
const std::string secant_group = "/state/secants/";
const std::string programme_group = "/state/programme/";

// The reactions were no part of the state before this schema.
constexpr std::int64_t schema_of_reactions = 3;
// Before this schema no load kept the initial stress at rest.
constexpr std::int64_t schema_of_balance = 4;
// Before this schema re-searched rows lost the consistency correction, and there were no
// interfaces.
constexpr std::int64_t schema_of_corrections = 5;
// Before this schema a run had one stage, whose progress was its load.
constexpr std::int64_t schema_of_stages = 7;
// Before this schema opposite sides shared their reactions, the motion of plates was no part of the
// state, and supports by penalty that began later held at none, but for some files which have what
// they held at.
constexpr std::int64_t schema_of_sides = 8;
const std::string shown_reactions = "/VTKHDF/PointData/reaction";

template <class Values>
std::span<const typename Values::value_type> span_of(const Values& values) {
  return {values.data(), static_cast<std::size_t>(values.size())};
}

template <class T>
bool all_finite(std::span<const T> values) {
  return std::ranges::all_of(values, [](T x) { return std::isfinite(x); });
}

/// Whether a particle field is component-major (one column per component), as fpm::Field is; the
/// other ones have a column per particle.
template <class Matrix>
constexpr bool component_major =
    Matrix::RowsAtCompileTime == Eigen::Dynamic&& Matrix::ColsAtCompileTime > 1;

/// Shape of a particle field in the file: one row per particle.
template <class Matrix>
files::Shape file_shape(const Matrix& field) {
  const auto rows = static_cast<std::size_t>(field.rows());
  const auto columns = static_cast<std::size_t>(field.cols());
  if constexpr (Matrix::ColsAtCompileTime == 1) {
    return {rows};
  } else if constexpr (component_major<Matrix>) {
    return {rows, columns};
  } else {
    return {columns, rows};
  }
}

class FieldWriter {
 public:
  FieldWriter(files::Hdf5File& file, files::ContentDigest& digest) : file_(file), digest_(digest) {}

  template <class T>
  void write(const std::string& path, std::span<const T> values, const files::Shape& shape,
             std::string_view unit) {
    if constexpr (std::is_floating_point_v<T>) {
      if (!all_finite(values)) {
        throw std::logic_error(path + " is not finite: no checkpoint is written");
      }
    }
    file_.write<T>(path, values, shape, unit);
    digest_.add(path, std::as_bytes(values));
  }

  template <class Matrix>
  void write_columns(const std::string& path, std::string_view unit, const Matrix& field) {
    if constexpr (component_major<Matrix>) {
      const Eigen::Matrix<double, Matrix::ColsAtCompileTime, Eigen::Dynamic> by_particle =
          field.transpose();
      write<double>(path, span_of(by_particle), file_shape(field), unit);
    } else {
      write<double>(path, span_of(field), file_shape(field), unit);
    }
  }

 private:
  files::Hdf5File& file_;
  files::ContentDigest& digest_;
};

class FieldReader {
 public:
  explicit FieldReader(const files::Hdf5File& file) : file_(file) {}

  /// Into a field that already has its size.
  template <class Matrix>
  void read_columns(const std::string& path, Matrix& field) const {
    std::vector<double> values(static_cast<std::size_t>(field.size()));
    // A field the scene does not have: how long its columns would be does not matter.
    if (values.empty() && file_.read_all<double>(path).empty()) return;
    file_.read<double>(path, values, file_shape(field));
    require_finite<double>(path, values);
    if constexpr (component_major<Matrix>) {
      field = Eigen::Map<const Eigen::Matrix<double, Matrix::ColsAtCompileTime, Eigen::Dynamic>>(
                  values.data(), field.cols(), field.rows())
                  .transpose();
    } else {
      std::ranges::copy(values, field.data());
    }
  }

  /// Into the reactions, from what ParaView is shown of them; where the scene asks for none of them
  /// they stay 0 until the next step.
  template <int Dim>
  void read_shown_reactions(fpm::Field<Dim>& reaction) const {
    if (!file_.has(shown_reactions)) return;
    constexpr std::size_t shown = 3;
    const auto particles = static_cast<std::size_t>(reaction.rows());
    std::vector<double> values(shown * particles);
    file_.read<double>(shown_reactions, values, {particles, shown});
    require_finite<double>(shown_reactions, values);
    reaction = Eigen::Map<const Eigen::Matrix<double, shown, Eigen::Dynamic>>(values.data(), shown,
                                                                              reaction.rows())
                   .template topRows<Dim>()
                   .transpose();
  }

  /// A column per row of the file, as many as there are; none if it has no such field.
  void read_pairs(const std::string& path, Eigen::Index unknowns, Eigen::MatrixXf& field) const {
    if (!file_.has(path)) return;
    constexpr std::size_t most = 100;  // no program has handed on as many
    const auto shape = file_.info(path).shape;
    if (shape.size() != 2 || shape[1] != static_cast<std::size_t>(unknowns) || shape[0] > most) {
      throw files::FileError(
          file_.file(),
          fmt::format("{} is not of at most {} pairs of {} unknowns each", path, most, unknowns));
    }
    const std::vector<float> values = file_.read_all<float>(path);
    require_finite<float>(path, values);
    field = Eigen::Map<const Eigen::MatrixXf>(values.data(), unknowns,
                                              static_cast<Eigen::Index>(shape[0]));
  }

  template <class T>
  void read_list(const std::string& name, std::vector<T>& list) const {
    const std::string path = row_group + name;
    list = file_.read_all<T>(path);
    if constexpr (std::is_same_v<T, double>) require_finite<double>(path, list);
  }

  void read_list(const std::string& name, Eigen::VectorXd& list) const {
    std::vector<double> values;
    read_list(name, values);
    list =
        Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  }

  template <class T>
  void read_number(const std::string& name, T& number) const {
    const std::string path = programme_group + name;
    file_.read<T>(path, std::span(&number, 1), {1});
    if constexpr (std::is_same_v<T, double>) require_finite<double>(path, std::span(&number, 1));
  }

 private:
  template <class T>
  void require_finite(const std::string& path, std::span<const T> values) const {
    if (!all_finite(values)) throw files::FileError(file_.file(), path + " is not finite");
  }

  const files::Hdf5File& file_;
};

void require_sane(const files::Hdf5File& file, const ProgrammeState& programme) {
  const bool sane = programme.step >= 0 && programme.stage >= 0 && programme.progress >= 0.0 &&
                    programme.next_increment >= 0.0 && programme.last_increment >= 0.0 &&
                    programme.easy_steps >= 0;
  if (!sane) throw files::FileError(file.file(), programme_group + " holds a negative number");
}

}  // namespace

template <int Dim>
void write_state(files::Hdf5File& file, State<Dim>& state, files::ContentDigest& digest) {
  FieldWriter writer(file, digest);
  state.for_each_particle_field([&](const char* name, const char* unit, const auto& field) {
    writer.write_columns(particle_group + name, unit, field);
  });
  state.for_each_interface_field([&](const char* name, const char* unit, const auto& field) {
    writer.write_columns(interface_group + name, unit, field);
  });
  state.for_each_penalty_field([&](const char* name, const char* unit, const auto& field) {
    writer.write_columns(penalty_group + name, unit, field);
  });
  state.for_each_plate_field([&](const char* name, const char* unit, const auto& field) {
    writer.write_columns(plate_group + name, unit, field);
  });
  state.for_each_secant_field([&](const char* name, const char* unit, const auto& field) {
    if (field.size() == 0) return;
    writer.template write<float>(
        secant_group + name, span_of(field),
        {static_cast<std::size_t>(field.cols()), static_cast<std::size_t>(field.rows())}, unit);
  });
  state.rows.for_each_field([&](const char* name, const char* unit, const auto& list) {
    using T = typename std::remove_cvref_t<decltype(list)>::value_type;
    writer.template write<T>(row_group + name, span_of(list),
                             {static_cast<std::size_t>(list.size())}, unit);
  });
  state.programme.for_each_field([&](const char* name, const char* unit, const auto& number) {
    using T = std::remove_cvref_t<decltype(number)>;
    writer.template write<T>(programme_group + name, std::span(&number, 1), {1}, unit);
  });
}

template <int Dim>
State<Dim> read_state(const files::Hdf5File& file, const Model<Dim>& model, std::int64_t schema) {
  State<Dim> state;
  state.layout = model.layout;
  state.resize(model.size(), model.interface_points(), model.penalty_points(), model.plates());
  const FieldReader reader(file);
  const bool has_reactions = schema >= schema_of_reactions;
  const bool has_stages = schema >= schema_of_stages;
  const bool has_sides = schema >= schema_of_sides;
  state.for_each_particle_field([&](std::string_view name, const char* /*unit*/, auto& field) {
    if ((has_reactions || name != "reaction") && (has_stages || name != "unbalanced") &&
        (has_sides || name != "side_reaction")) {
      reader.read_columns(particle_group + std::string(name), field);
    }
  });
  if (!has_reactions) reader.template read_shown_reactions<Dim>(state.reaction);
  const bool has_corrections = schema >= schema_of_corrections;
  state.for_each_interface_field([&](const char* name, const char* /*unit*/, auto& field) {
    if (has_corrections) reader.read_columns(interface_group + name, field);
  });
  state.for_each_penalty_field([&](const char* name, const char* /*unit*/, auto& field) {
    const std::string path = penalty_group + name;
    if (has_sides || file.has(path)) reader.read_columns(path, field);
  });
  state.for_each_plate_field([&](const char* name, const char* /*unit*/, auto& field) {
    if (has_sides) reader.read_columns(plate_group + name, field);
  });
  state.for_each_secant_field([&](const char* name, const char* /*unit*/, auto& field) {
    reader.read_pairs(secant_group + name, model.unknowns(), field);
  });
  if (state.secant_step.cols() != state.secant_change.cols()) {
    throw files::FileError(file.file(), secant_group + " holds steps without changes");
  }
  state.rows.for_each_field([&](std::string_view name, const char* /*unit*/, auto& list) {
    if (has_corrections || (name != "corrected_row" && name != "correction")) {
      reader.read_list(std::string(name), list);
    }
  });
  const bool has_balance = schema >= schema_of_balance;
  state.programme.for_each_field([&](std::string_view name, const char* /*unit*/, auto& number) {
    if ((has_balance || name != "balanced") &&
        (has_stages || (name != "stage" && name != "progress"))) {
      reader.read_number(std::string(name), number);
    }
  });
  if (!has_balance) state.programme.balanced = 0;
  if (!has_stages) state.programme.progress = state.programme.load;
  require_sane(file, state.programme);
  try {
    state.rows.restore(model.particles, model.ghosts, model.row_options);
  } catch (const fpm::ShapeError& failure) {
    throw files::FileError(file.file(), row_group + ": " + failure.what());
  }
  return state;
}

template <int Dim>
std::size_t bytes_of(State<Dim>& state) {
  std::size_t bytes = sizeof(ProgrammeState);
  const auto add = [&](const char*, const char*, const auto& field) {
    using T = typename std::remove_cvref_t<decltype(field)>::value_type;
    bytes += static_cast<std::size_t>(field.size()) * sizeof(T);
  };
  state.for_each_particle_field(add);
  state.for_each_interface_field(add);
  state.for_each_penalty_field(add);
  state.for_each_plate_field(add);
  state.for_each_secant_field(add);
  state.rows.for_each_field(add);
  return bytes;
}

template void write_state<2>(files::Hdf5File&, State<2>&, files::ContentDigest&);
template void write_state<3>(files::Hdf5File&, State<3>&, files::ContentDigest&);
template State<2> read_state<2>(const files::Hdf5File&, const Model<2>&, std::int64_t);
template State<3> read_state<3>(const files::Hdf5File&, const Model<3>&, std::int64_t);
template std::size_t bytes_of<2>(State<2>&);
template std::size_t bytes_of<3>(State<3>&);

}  // namespace model
