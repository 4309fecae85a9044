#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "sets.hpp"

// The moment operator written down as its header states it: loops over rows and neighbours.
namespace fpm_test {

/// The entries of one row as the operator should hold them, from the rows themselves.
template <int Dim>
struct ReferenceRow {
  std::vector<Index> node;
  Eigen::MatrixXd weight;  // channels x neighbours
};

template <int Dim>
ReferenceRow<Dim> reference_row(const Rows<Dim>& rows, Index a, fpm::Channels channels) {
  fpm::RowGeometry<Dim> geometry;
  fpm::RowWeights<Dim> weights;
  rows.geometry(a, geometry);
  compute_weights(geometry, rows.options().kernel, channels.second, weights);
  ReferenceRow<Dim> row;
  row.node.assign(rows.neighbours(a).begin(), rows.neighbours(a).end());
  row.weight.resize(channels.count(Dim), geometry.size());
  row.weight.template topRows<Dim>() = weights.gradient;
  if (channels.pair) {
    row.weight.row(Dim) = weights.kappa.transpose();
    row.weight.template middleRows<Dim>(Dim + 1) = geometry.offset * weights.kappa.asDiagonal();
  }
  if (channels.second) {
    row.weight.template bottomRows<fpm::second_gradient_size<Dim>>() = weights.second;
  }
  return row;
}

/// A nodal field and its images, in the operator's extended layout.
template <int Dim>
Eigen::VectorXd extended(const fpm::MomentOperator<Dim>& op, const Field<Dim>& field) {
  // What is not written must not matter.
  Eigen::VectorXd result = Eigen::VectorXd::Constant(op.stride() * Dim, NAN);
  op.extend(field.data(), result.data());
  return result;
}

/// All moments, one row per particle, channel c of component i in column c Dim + i.
template <int Dim>
Eigen::MatrixXd gathered(const fpm::MomentOperator<Dim>& op, const Field<Dim>& field) {
  using Operator = fpm::MomentOperator<Dim>;
  const Eigen::VectorXd nodal = extended(op, field);
  Eigen::MatrixXd moments(op.size(), op.channel_count() * Dim);
  Eigen::MatrixXd buffer(Operator::block_stride, moments.cols());
  for (Index block = 0; block < op.block_count(); ++block) {
    buffer.setConstant(NAN);
    op.gather(block, nodal.data(), buffer.data());
    moments.middleRows(op.block_first(block), op.block_size(block)) =
        buffer.topRows(op.block_size(block));
  }
  return moments;
}

/// Nodal forces of `stress` (one row per particle, one column per stress entry).
template <int Dim>
Field<Dim> scattered(const fpm::MomentOperator<Dim>& op, const Eigen::MatrixXd& stress,
                     const Field<Dim>& v, const Field<Dim>& x) {
  Eigen::MatrixXd padded = Eigen::MatrixXd::Constant(op.stride(), op.stress_count(), NAN);
  padded.topRows(op.size()) = stress;
  Eigen::MatrixXd force = Eigen::MatrixXd::Constant(op.stride(), Dim, NAN);
  op.scatter(padded.data(), extended(op, v).data(), extended(op, x).data(), force.data());
  return force.topRows(op.size());
}

/// What `gathered` should give.
template <int Dim>
Eigen::MatrixXd reference_moments(const fpm::MomentOperator<Dim>& op, const Rows<Dim>& rows,
                                  const Field<Dim>& field) {
  const Eigen::VectorXd nodal = extended(op, field);
  Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(op.size(), op.channel_count() * Dim);
  for (Index a = 0; a < op.size(); ++a) {
    const auto row = reference_row(rows, a, op.channels());
    for (std::size_t k = 0; k < row.node.size(); ++k) {
      for (int c = 0; c < op.channel_count(); ++c) {
        for (int i = 0; i < Dim; ++i) {
          const double difference =
              nodal[i * op.stride() + row.node[k]] - nodal[i * op.stride() + a];
          moments(a, c * Dim + i) += row.weight(c, static_cast<Eigen::Index>(k)) * difference;
        }
      }
    }
  }
  return moments;
}

/// What `scattered` should give: the formula in the operator's header, entry by entry.
template <int Dim>
Field<Dim> reference_force(const fpm::MomentOperator<Dim>& op, const Rows<Dim>& rows,
                           const Eigen::MatrixXd& stress, const Field<Dim>& v,
                           const Field<Dim>& x) {
  const auto channels = op.channels();
  const Eigen::VectorXd nodal_v = extended(op, v);
  const Eigen::VectorXd nodal_x = extended(op, x);
  const Index n = op.size();
  constexpr int second = fpm::second_gradient_size<Dim>;
  Field<Dim> force = Field<Dim>::Zero(n, Dim);
  for (Index a = 0; a < n; ++a) {
    const auto row = reference_row(rows, a, channels);
    int at = 0;
    const auto block = [&](int r, int c) {  // r x c entries, column by column
      Eigen::MatrixXd m(r, c);
      for (int j = 0; j < c; ++j) {
        for (int i = 0; i < r; ++i) m(i, j) = stress(a, at++);
      }
      return m;
    };
    const Eigen::MatrixXd p = block(Dim, Dim);
    Eigen::MatrixXd k, c, a_matrix, b_matrix, t;
    if (channels.pair) {
      k = block(1, 1);
      c = block(Dim, 1);
      a_matrix = block(Dim, Dim).transpose();
      b_matrix = block(Dim, Dim).transpose();
    }
    if (channels.second) t = block(Dim, second);
    for (std::size_t e = 0; e < row.node.size(); ++e) {
      const Index b = row.node[e];
      const Eigen::VectorXd w = row.weight.col(static_cast<Eigen::Index>(e));
      Vector<Dim> on_neighbour = Vector<Dim>::Zero();  // not taken back from row a
      Vector<Dim> on_difference = p * w.template head<Dim>();
      if (channels.pair) {
        Vector<Dim> vb, xb;
        for (int i = 0; i < Dim; ++i) {
          vb[i] = nodal_v[i * op.stride() + b];
          xb[i] = nodal_x[i * op.stride() + b];
        }
        on_neighbour += w[Dim] * (k(0, 0) * vb + c + a_matrix * xb);
        on_neighbour -= b_matrix * w.template segment<Dim>(Dim + 1);
      }
      if (channels.second) on_difference += t * w.template tail<second>();
      const auto add = [&](Index node, const Vector<Dim>& f) {
        if (node < n) {
          force.row(node) += f.transpose();
        } else {
          const Index g = node - n;
          for (int i = 0; i < Dim; ++i) {
            force(op.ghosts().source(g), i) += op.ghosts().sign(g, i) * f[i];
          }
        }
      };
      add(b, on_neighbour + on_difference);
      add(a, -on_difference);
    }
  }
  return force;
}

}  // namespace fpm_test
