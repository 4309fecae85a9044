#include "model/particle_fields.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "constitutive/tensor.hpp"
#include "constitutive/utilisation.hpp"
#include "fpm/boundary_loads.hpp"
#include "fpm/recovery.hpp"
#include "model/penalty_targets.hpp"

namespace model {

namespace {

/// Collects the fields that were asked for, so that the others cost nothing.
template <int Dim>
class Collector {
 public:
  Collector(std::size_t particles, std::span<const std::string> names)
      : particles_(particles), names_(names) {}

  template <class At>
  void scalar(const std::string& name, const std::string& unit, At&& at) {
    if (wanted(name)) fields_.push_back(files::scalar_field(name, unit, particles_, at));
  }
  template <class At>
  void vector(const std::string& name, const std::string& unit, At&& at) {
    if (wanted(name)) fields_.push_back(files::vector_field(name, unit, particles_, Dim, at));
  }
  template <class At>
  void tensor(const std::string& name, const std::string& unit, At&& at) {
    constexpr int rows = constitutive::stress_size<Dim>;
    if (wanted(name)) fields_.push_back(files::tensor_field(name, unit, particles_, rows, at));
  }
  bool wanted(const std::string& name) const {
    return names_.empty() || std::ranges::find(names_, name) != names_.end();
  }
  std::vector<files::PointField> take() { return std::move(fields_); }

 private:
  std::size_t particles_;
  std::span<const std::string> names_;
  std::vector<files::PointField> fields_;
};

Eigen::Index at(std::size_t particle) {
  return static_cast<Eigen::Index>(particle);
}

template <int Dim>
void add_stress_fields(const State<Dim>& state, Collector<Dim>& fields) {
  using Stress = constitutive::StressVector<Dim>;
  fields.tensor("stress", "Pa", [&](std::size_t a, int r) { return state.stress(r, at(a)); });
  fields.scalar("mean_stress", "Pa",
                [&](std::size_t a) { return state.stress.col(at(a)).template head<3>().mean(); });
  fields.scalar("deviatoric_stress", "Pa", [&](std::size_t a) {
    return std::sqrt(3.0 * constitutive::j2(Stress(state.stress.col(at(a)))));  // von Mises
  });
}

// Stress is effective where there is pore water; what the ground bears with its water is total.
template <int Dim>
void add_water_fields(const Model<Dim>& model, const State<Dim>& state, Collector<Dim>& fields) {
  if (model.pore_pressure.size() == 0) return;
  fields.scalar("pore_pressure", "Pa", [&](std::size_t a) { return model.pore_pressure[at(a)]; });
  fields.tensor("total_stress", "Pa", [&](std::size_t a, int r) {
    return state.stress(r, at(a)) - (r < 3 ? model.pore_pressure[at(a)] : 0.0);
  });
}

// Each material by itself: across an interface the mean stress jumps. In the geometry the stress
// belongs to, which small strains do not change.
template <int Dim>
Eigen::VectorXd recovered_mean_stress(const Model<Dim>& model, const State<Dim>& state) {
  fpm::ParticleSet<Dim> now = model.particles;
  if (state.layout.finite) {
    now.position += state.displacement;
    now.volume = state.rows.reference_volume();
    for (Eigen::Index a = 0; a < model.size(); ++a) {
      const Eigen::Map<const fpm::Tensor<Dim>> f(state.deformation_gradient.col(a).data());
      now.volume[a] *= f.determinant();
    }
  }
  const Eigen::VectorXd mean = state.stress.template topRows<3>().colwise().mean().transpose();
  now.body.assign(model.material.begin(), model.material.end());
  // Twice the rows' radius: what alternates along a face is to vanish there, too.
  const fpm::RecoveryOptions options{model.row_options.kernel,
                                     2.0 * model.row_options.support_radius};
  return fpm::recover<Dim>(now, mean, model.ghosts.planes(), options);
}

// The force by which supports and the drive hold each particle: of what is prescribed, and what
// springs and contacts bear, which count among the forces by the body.
template <int Dim>
fpm::Field<Dim> holding_force(const Model<Dim>& model, const State<Dim>& state) {
  fpm::Field<Dim> by_body = fpm::Field<Dim>::Zero(model.size(), Dim);
  for_each_penalty(model, state, [&](const auto& support, const fpm::FieldView<Dim>& target) {
    (void)fpm::add_penalty_force<Dim>(support.op, support.points, support.options, target,
                                      state.displacement, by_body);
  });
  Eigen::Index first = 0;
  for (const Interface<Dim>& interface : model.interfaces) {
    const Eigen::Index count = interface.faces.points.size();
    for (Eigen::Index c = 0; interface.is_rigid() && c < count; ++c) {
      interface.faces.add_force(static_cast<fpm::Index>(c),
                                fpm::Vector<Dim>(state.interface_traction.col(first + c)), by_body);
    }
    first += count;
  }
  return state.reaction - by_body;
}

template <int Dim>
void add_strain_fields(const Model<Dim>& model, const State<Dim>& state, Collector<Dim>& fields) {
  if (state.layout.plastic) {
    fields.scalar("utilisation", "-", [&](std::size_t a) {
      using Stress = constitutive::StressVector<Dim>;
      return constitutive::utilisation<Dim>(
          model.laws[model.law[a]], Stress(state.stress.col(at(a))),
          state.plastic_volume_strain[at(a)], state.plastic_strain[at(a)]);
    });
    fields.scalar("plastic_strain", "-",
                  [&](std::size_t a) { return state.plastic_strain[at(a)]; });
    fields.scalar("plastic_volume_strain", "-",
                  [&](std::size_t a) { return state.plastic_volume_strain[at(a)]; });
    fields.scalar("yielding", "-",
                  [&](std::size_t a) { return state.plastic_increment[at(a)] > 0.0 ? 1.0 : 0.0; });
  }
  if (state.layout.finite) {
    fields.scalar("volume_ratio", "-", [&](std::size_t a) {
      const Eigen::Map<const fpm::Tensor<Dim>> f(state.deformation_gradient.col(at(a)).data());
      return state.searched_volume_ratio[at(a)] * f.determinant();
    });
  }
}

}  // namespace

template <int Dim>
std::vector<double> current_points(const Model<Dim>& model, const State<Dim>& state) {
  std::vector<double> points(3 * static_cast<std::size_t>(model.size()), 0.0);
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    for (int i = 0; i < Dim; ++i) {
      points[static_cast<std::size_t>(3 * a + i)] =
          model.particles.position(a, i) + state.displacement(a, i);
    }
  }
  return points;
}

template <int Dim>
std::vector<files::PointField> particle_fields(const Model<Dim>& model, const State<Dim>& state,
                                               std::span<const std::string> names) {
  Collector<Dim> fields(static_cast<std::size_t>(model.size()), names);
  fields.vector("displacement", "m",
                [&](std::size_t a, int i) { return state.displacement(at(a), i); });
  add_stress_fields(state, fields);
  if (fields.wanted("recovered_mean_stress")) {
    const Eigen::VectorXd mean = recovered_mean_stress(model, state);
    fields.scalar("recovered_mean_stress", "Pa", [&](std::size_t a) { return mean[at(a)]; });
  }
  add_water_fields(model, state, fields);
  add_strain_fields(model, state, fields);
  fields.scalar("material", "-", [&](std::size_t a) { return model.material[a]; });
  if (fields.wanted("reaction")) {
    const fpm::Field<Dim> force = holding_force(model, state);
    fields.vector("reaction", Dim == 2 ? "N/m" : "N",
                  [&](std::size_t a, int i) { return force(at(a), i); });
  }
  fields.scalar("searched", "-", [&](std::size_t a) {
    return state.rows.searched(static_cast<fpm::Index>(a)) ? 1.0 : 0.0;
  });
  return fields.take();
}

template std::vector<double> current_points<2>(const Model<2>&, const State<2>&);
template std::vector<double> current_points<3>(const Model<3>&, const State<3>&);
template std::vector<files::PointField> particle_fields<2>(const Model<2>&, const State<2>&,
                                                           std::span<const std::string>);
template std::vector<files::PointField> particle_fields<3>(const Model<3>&, const State<3>&,
                                                           std::span<const std::string>);

}  // namespace model
