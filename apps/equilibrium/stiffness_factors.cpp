#include "equilibrium/stiffness_factors.hpp"

#include <Eigen/LU>
#include <stdexcept>

#include "equilibrium/elastic_block.hpp"
#include "equilibrium/given_unknowns.hpp"
#include "equilibrium/held_directions.hpp"
#include "fpm/subpoints.hpp"

namespace equilibrium {
namespace {

// The lower triangle of the stiffness, made of small parts.
template <int Dim>
class Stiffness {
 public:
  using Sparse = Eigen::SparseMatrix<double>;

  explicit Stiffness(const model::Model<Dim>& model)
      : model_(model), n_(model.size()), sum_(model.unknowns(), model.unknowns()) {
    for (Eigen::Index k = 0; k < model.unknowns(); ++k) {
      const bool given = model.prescribed[static_cast<std::size_t>(k)] != 0;
      entries_.emplace_back(k, k, given ? 1.0 : 0.0);
    }
  }

  /// Stiffness times the square of a displacement that is sum value[j] u[unknown[j]].
  void add_spring(double stiffness, const std::vector<Eigen::Index>& unknown,
                  const std::vector<double>& value) {
    for (std::size_t i = 0; i < unknown.size(); ++i) {
      for (std::size_t j = 0; j < unknown.size(); ++j) {
        add(unknown[i], unknown[j], stiffness * value[i] * value[j]);
      }
    }
  }

  /// A block of two nodes; an image is its source, with the signs of its components.
  void add_block(fpm::Index node, fpm::Index other, const fpm::Tensor<Dim>& block) {
    for (int i = 0; i < Dim; ++i) {
      for (int j = 0; j < Dim; ++j) {
        add(i * n_ + source(node), j * n_ + source(other),
            sign(node, i) * sign(other, j) * block(i, j));
      }
    }
  }

  /// What is left of it is an empty sum.
  Sparse take() {
    gather();
    Sparse taken;
    taken.swap(sum_);
    return taken;
  }

 private:
  fpm::Index source(fpm::Index b) const {
    return b < n_ ? b : model_.ghosts.source(b - static_cast<fpm::Index>(n_));
  }
  double sign(fpm::Index b, int i) const {
    return b < n_ ? 1.0 : model_.ghosts.sign(b - static_cast<fpm::Index>(n_), i);
  }

  void add(Eigen::Index row, Eigen::Index column, double value) {
    const auto given = [&](Eigen::Index k) {
      return model_.prescribed[static_cast<std::size_t>(k)] != 0;
    };
    if (row < column || given(row) || given(column)) return;
    entries_.emplace_back(row, column, value);
    constexpr std::size_t most_entries = 4'000'000;  // at a time: each is met some ten times
    if (entries_.size() >= most_entries) gather();
  }

  void gather() {
    Sparse part(sum_.rows(), sum_.cols());
    part.setFromTriplets(entries_.begin(), entries_.end());
    entries_.clear();
    sum_ += part;
  }

  const model::Model<Dim>& model_;
  Eigen::Index n_;
  Sparse sum_;
  std::vector<Eigen::Triplet<double>> entries_;
};

// A particle of a row, the row's own included, with what its displacement does to the row.
template <int Dim>
struct Member {
  fpm::Index node = 0;
  fpm::Vector<Dim> gradient = fpm::Vector<Dim>::Zero();  // [1/m]
  double kappa = 0.0;                                    // [1/m^2]
  fpm::Vector<Dim> kappa_x = fpm::Vector<Dim>::Zero();   // [1/m]
  Eigen::Matrix<double, fpm::second_gradient_size<Dim>, 1> second =
      Eigen::Matrix<double, fpm::second_gradient_size<Dim>, 1>::Zero();  // [1/m^2]
};

// The row's own first, with minus the sums of the others; its kappa is their sum.
template <int Dim>
std::vector<Member<Dim>> members_of(const fpm::MomentOperator<Dim>& op, fpm::Index row,
                                    const fpm::Channels& channels) {
  std::vector<Member<Dim>> members(1);
  members[0].node = row;
  op.for_each_entry(row, [&](fpm::Index b, const double* w) {
    Member<Dim> member;
    member.node = b;
    member.gradient = Eigen::Map<const fpm::Vector<Dim>>(w);
    if (channels.pair) {
      member.kappa = w[fpm::Channels::kappa(Dim)];
      member.kappa_x = Eigen::Map<const fpm::Vector<Dim>>(w + fpm::Channels::kappa_x(Dim));
    }
    if (channels.second) {
      member.second = Eigen::Map<const decltype(member.second)>(w + channels.second_gradient(Dim));
    }
    members[0].gradient -= member.gradient;
    members[0].kappa += member.kappa;
    members[0].kappa_x -= member.kappa_x;
    members[0].second -= member.second;
    members.push_back(member);
  });
  return members;
}

// Sum of kappa X X^T.
template <int Dim>
fpm::Tensor<Dim> spread_of(const std::vector<Member<Dim>>& members) {
  fpm::Tensor<Dim> spread = fpm::Tensor<Dim>::Zero();
  for (std::size_t k = 1; k < members.size(); ++k) {
    const fpm::Vector<Dim>& y = members[k].kappa_x;
    if (members[k].kappa != 0.0) spread += y * y.transpose() / members[k].kappa;
  }
  return spread;
}

// Of the pairs' energy sum kappa |d - H X|^2 / 2, H the gradient of d (theory.md, section 6).
template <int Dim>
double pair_entry(const std::vector<Member<Dim>>& members, std::size_t i, std::size_t j,
                  const fpm::Tensor<Dim>& spread) {
  const Member<Dim>&one = members[i], &other = members[j];
  double link = 0.0;
  if (i == j) {
    link = one.kappa;
  } else if (i == 0 || j == 0) {
    link = -members[std::max(i, j)].kappa;
  }
  return link - one.kappa_x.dot(other.gradient) - one.gradient.dot(other.kappa_x) +
         one.gradient.dot(spread * other.gradient);
}

// The deviator alone works at the sub-points, in the plane that of the plane.
template <int Dim>
fpm::Tensor<Dim> subpoint_block(const Member<Dim>& one, const Member<Dim>& other, double shear,
                                double volume) {
  fpm::Tensor<Dim> block = fpm::Tensor<Dim>::Zero();
  for (std::size_t k = 0; k < fpm::subpoint_count; ++k) {
    const fpm::Vector<Dim> xi = fpm::subpoint_offset<Dim>(k, volume);
    const fpm::Vector<Dim> g = fpm::second_weight_at<Dim>(one.second, xi);
    const fpm::Vector<Dim> h = fpm::second_weight_at<Dim>(other.second, xi);
    block += fpm::subpoint_weights[k] * shear * volume *
             (g.dot(h) * fpm::Tensor<Dim>::Identity() + h * g.transpose() -
              2.0 / Dim * g * h.transpose());
  }
  return block;
}

template <int Dim>
void add_particle(const model::Model<Dim>& model, const fpm::MomentOperator<Dim>& op, fpm::Index a,
                  Stiffness<Dim>& stiffness) {
  const constitutive::ElasticModuli m = moduli_of(model, a);
  const double volume = model.particles.volume[a];
  const bool pair = model.channels.pair;
  const auto members = members_of(op, a, model.channels);
  const double spring = model.pair_control.stiffness_ratio * volume * model.youngs_modulus_of(a);
  const fpm::Tensor<Dim> spread = spread_of(members);
  for (std::size_t i = 0; i < members.size(); ++i) {
    for (std::size_t j = 0; j < members.size(); ++j) {
      fpm::Tensor<Dim> block =
          volume * elastic_block<Dim>(m, members[i].gradient, members[j].gradient);
      if (pair) {
        block += spring * pair_entry(members, i, j, spread) * fpm::Tensor<Dim>::Identity();
      }
      if (model.channels.second) {
        block += subpoint_block(members[i], members[j], m.shear, volume);
      }
      stiffness.add_block(members[i].node, members[j].node, block);
    }
  }
}

template <int Dim>
void add_penalties(const model::Model<Dim>& model, Stiffness<Dim>& stiffness) {
  for (const model::PenaltySupport<Dim>& support : model.penalty_supports) {
    for (fpm::Index c = 0; c < support.points.size(); ++c) {
      for (int i = 0; i < Dim; ++i) {
        if (!support.options.prescribed[static_cast<std::size_t>(i)]) continue;
        std::vector<Eigen::Index> unknown;
        std::vector<double> value;
        support.op.for_each_value(c, [&](fpm::Index a, double n, const fpm::Vector<Dim>& sign) {
          unknown.push_back(i * model.size() + a);
          value.push_back(n * sign[i]);
        });
        stiffness.add_spring(support.options.penalty * support.points.weight[c], unknown, value);
      }
    }
  }
}

template <int Dim>
void add_interfaces(const model::Model<Dim>& model, Stiffness<Dim>& stiffness) {
  for (const model::Interface<Dim>& interface : model.interfaces) {
    for (fpm::Index c = 0; c < interface.faces.points.size(); ++c) {
      const auto directions = held_directions(interface, c);
      const double across = interface.stiffness[c] * interface.faces.points.weight[c];
      for (Eigen::Index d = 0; d < directions.cols(); ++d) {
        std::vector<Eigen::Index> unknown;
        std::vector<double> value;
        const auto add = [&](double side) {
          return [&, side](fpm::Index a, double n, const fpm::Vector<Dim>& sign) {
            for (int i = 0; i < Dim; ++i) {
              unknown.push_back(i * model.size() + a);
              value.push_back(side * n * sign[i] * directions(i, d));
            }
          };
        };
        interface.faces.first.for_each_value(c, add(-1.0));
        if (!interface.is_rigid()) interface.faces.second.for_each_value(c, add(1.0));
        stiffness.add_spring(d > 0 ? interface.law.shear_stiffness * across : across, unknown,
                             value);
      }
    }
  }
}

}  // namespace

template <int Dim>
StiffnessFactors<Dim>::StiffnessFactors(const model::Model<Dim>& model,
                                        const fpm::MomentOperator<Dim>& op)
    : given_(given_unknowns(model.prescribed)) {
  Stiffness<Dim> stiffness(model);
  for (fpm::Index a = 0; a < model.size(); ++a) add_particle(model, op, a, stiffness);
  add_penalties(model, stiffness);
  add_interfaces(model, stiffness);
  Sparse matrix = stiffness.take();
  // Of a body that is free to move in some way, as one that no load moves that way may be, the last
  // pivots are round-off: this is more, and little beside the shape next to incompressibility.
  constexpr double floor = 1e-12;
  matrix.diagonal() *= 1.0 + floor;
  auto factor = std::make_shared<Eigen::SimplicialLLT<Sparse>>(matrix);
  if (factor->info() != Eigen::Success) {
    throw std::runtime_error("the stiffness of the particles could not be factorised");
  }
  factor_ = std::move(factor);
}

template <int Dim>
void StiffnessFactors<Dim>::apply(const Eigen::VectorXd& r, Eigen::VectorXd& z) {
  z = factor_->solve(r);
  for (const Eigen::Index k : given_) z[k] = 0.0;
}

template <int Dim>
std::size_t StiffnessFactors<Dim>::bytes() const {
  const auto entries = factor_->matrixL().nestedExpression().nonZeros();
  return static_cast<std::size_t>(entries) * (sizeof(double) + sizeof(int)) +
         given_.size() * sizeof(Eigen::Index);
}

template class StiffnessFactors<2>;
template class StiffnessFactors<3>;

}  // namespace equilibrium
