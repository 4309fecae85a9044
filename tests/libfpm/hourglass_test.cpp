// Stiffness control of zero-energy modes, assembled as a residual does it, against its energy.
#include <gtest/gtest.h>
#include <fpm/hourglass.hpp>

#include <Eigen/Geometry>

#include "operator_reference.hpp"

namespace {

using namespace fpm_test;
using fpm::MomentOperator;
using fpm::PairRow;

/// A body in some deformed state n, from which increments are taken.
template <int Dim>
struct Body {
  Model<Dim> model;
  MomentOperator<Dim> op;
  Field<Dim> position;        // x(n), not affine
  Eigen::MatrixXd moments_n;  // of x(n)
  Eigen::VectorXd stiffness;  // k_a
  std::vector<Tensor<Dim>> defect;

  explicit Body(const std::vector<SymmetryPlane>& planes = {})
      : model(lattice<Dim>(Dim == 2 ? Counts<Dim>::Constant(9) : Counts<Dim>::Constant(5), 0.1,
                           LatticeLayout::cell, 0.1),
              false, planes),
        op(model.rows, model.ghosts, {.pair = true}),
        stiffness((2.0 + random_vector(op.size(), 1).array()).matrix()),
        defect(static_cast<std::size_t>(op.size()), Tensor<Dim>::Zero()) {
    Tensor<Dim> stretch = Tensor<Dim>::Identity();
    stretch(0, 0) = 1.2;  // admitted by a plane of symmetry normal to x
    position = affine<Dim>(model.set.position, stretch, Vector<Dim>::Zero()) +
               0.005 * random_field<Dim>(op.size(), 2);
    moments_n = moments(position, true);
  }

  Index size() const { return op.size(); }

  Eigen::MatrixXd moments(const Field<Dim>& field, bool positions) const {
    Eigen::VectorXd nodal(op.stride() * Dim);
    positions ? op.extend_positions(field.data(), nodal.data())
              : op.extend(field.data(), nodal.data());
    Eigen::MatrixXd all(size(), op.channel_count() * Dim);
    Eigen::MatrixXd buffer(MomentOperator<Dim>::block_stride, all.cols());
    for (Index block = 0; block < op.block_count(); ++block) {
      op.gather(block, nodal.data(), buffer.data());
      all.middleRows(op.block_first(block), op.block_size(block)) =
          buffer.topRows(op.block_size(block));
    }
    return all;
  }

  PairRow<Dim> row(Index a) const {
    PairRow<Dim> r;
    r.first_moment = op.first_moment(a);
    r.second_moment = op.second_moment(a);
    r.position = position.row(a).transpose();
    r.gradient = gradient(moments_n, a);
    r.memory_first = first(moments_n, a) - r.gradient * r.first_moment;
    r.memory_second = second(moments_n, a) - r.gradient * r.second_moment;
    return r;
  }

  /// Force of the control for the increment du.
  Field<Dim> force(const Field<Dim>& du) const {
    const Eigen::MatrixXd m = moments(du, false);
    Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(op.stride(), op.stress_count());
    Field<Dim> own(size(), Dim);
    for (Index a = 0; a < size(); ++a) {
      const auto r =
          pair_response<Dim>(stiffness[a], row(a), du.row(a).transpose(), first(m, a), second(m, a),
                             gradient(m, a), defect[static_cast<std::size_t>(a)]);
      Eigen::Index e = 0;
      const auto put = [&](const auto& values) {
        for (const double value : values) stress(a, e++) = value;
      };
      put(r.stress.reshaped());
      put(Vector<1>::Constant(r.stiffness).reshaped());
      put(r.constant);
      put(r.on_position.transpose().reshaped());
      put(r.affine.transpose().reshaped());
      own.row(a) = r.own_force.transpose();
    }
    Eigen::VectorXd v(op.stride() * Dim), x(op.stride() * Dim);
    op.extend(du.data(), v.data());
    op.extend_positions(position.data(), x.data());
    Eigen::MatrixXd f(op.stride(), Dim);
    op.scatter(stress.data(), v.data(), x.data(), f.data());
    return f.topRows(size()) + own;
  }

  /// 1/2 sum k_a kappa_ab |y_ab|^2, pair by pair.
  double energy(const Field<Dim>& du) const {
    Eigen::VectorXd v(op.stride() * Dim), x(op.stride() * Dim);
    op.extend(du.data(), v.data());
    op.extend_positions(position.data(), x.data());
    const auto at = [&](const Eigen::VectorXd& field, Index b) {
      Vector<Dim> value;
      for (int i = 0; i < Dim; ++i) value[i] = field[i * op.stride() + b];
      return value;
    };
    const Eigen::MatrixXd m = moments(du, false);
    double sum = 0.0;
    for (Index a = 0; a < size(); ++a) {
      op.for_each_entry(a, [&](Index b, const double* w) {
        const double kappa = w[fpm::Channels::kappa(Dim)];
        const Vector<Dim> reference =
            Eigen::Map<const Vector<Dim>>(w + fpm::Channels::kappa_x(Dim)) / kappa;
        const Vector<Dim> before = at(x, b) - at(x, a) - gradient(moments_n, a) * reference;
        const Vector<Dim> y = at(v, b) - at(v, a) - gradient(m, a) * reference +
                              defect[static_cast<std::size_t>(a)] * before;
        sum += 0.5 * stiffness[a] * kappa * y.squaredNorm();
      });
    }
    return sum;
  }

  static Tensor<Dim> gradient(const Eigen::MatrixXd& m, Index a) {
    return m.row(a).head(Dim * Dim).reshaped(Dim, Dim);
  }
  static Vector<Dim> first(const Eigen::MatrixXd& m, Index a) {
    return m.row(a).segment(Dim * Dim, Dim).transpose();
  }
  static Tensor<Dim> second(const Eigen::MatrixXd& m, Index a) {
    return m.row(a).segment(Dim * Dim + Dim, Dim * Dim).reshaped(Dim, Dim);
  }
};

template <int Dim>
void expect_gradient_of_energy(const std::vector<SymmetryPlane>& planes, double defect) {
  Body<Dim> body(planes);
  for (Index a = 0; a < body.size(); ++a) {
    body.defect[static_cast<std::size_t>(a)] =
        defect * random_vector(Dim * Dim, 50 + static_cast<unsigned>(a)).reshaped(Dim, Dim);
  }
  const Field<Dim> du = 0.01 * random_field<Dim>(body.size(), 3);
  const Field<Dim> v = 0.01 * random_field<Dim>(body.size(), 4);
  // The energy is quadratic in du: central differences are exact up to round-off.
  const double plus = body.energy(Field<Dim>(du + v));
  const double minus = body.energy(Field<Dim>(du - v));
  EXPECT_GT(plus, 0.0);
  EXPECT_NEAR(body.force(du).cwiseProduct(v).sum(), 0.5 * (plus - minus),
              round_off(90.0, plus + minus));
}

TEST(PairControl, ForceIsTheGradientOfItsEnergy) {
  for (const double defect : {0.0, 0.3}) {
    expect_gradient_of_energy<2>({}, defect);
    expect_gradient_of_energy<2>({{0, 0.0}}, defect);
    expect_gradient_of_energy<3>({}, defect);
    expect_gradient_of_energy<3>({{0, 0.0}}, defect);
  }
}

TEST(PairControl, HasNoResultant) {
  const Body<3> body;
  const Field<3> f = body.force(random_field<3>(body.size(), 5));
  EXPECT_LE(f.colwise().sum().norm(), 400.0 * epsilon * f.cwiseAbs().sum());
}

TEST(PairControl, LetsAffineIncrementsPass) {
  const Body<2> body;  // defect 0: the total form, or the incremental one without rotation
  const Field<2> du = affine<2>(body.model.set.position, some_tensor<2>(), Vector<2>::Ones());
  const Field<2> checkerboard = random_field<2>(body.size(), 6);
  EXPECT_LE(body.force(du).norm(),
            (4.0 * 100.0 + 90.0) * epsilon * body.force(checkerboard).norm());
}

TEST(PairControl, LetsARigidRotationOfADeformedBodyPass) {
  // du = (Q - I) x(n), so e = Q e(n) and y = e - Q e(n) = 0.
  Body<2> body;
  const Tensor<2> q = Eigen::Rotation2Dd(0.8).toRotationMatrix();
  for (auto& defect : body.defect) defect = Tensor<2>::Identity() - q;
  const Field<2> du = affine<2>(body.position, q - Tensor<2>::Identity(), Vector<2>::Zero());
  const double scale = body.force(random_field<2>(body.size(), 7)).norm();
  EXPECT_LE(body.force(du).norm(), (4.0 * 100.0 + 90.0) * epsilon * scale);
}

TEST(PairModulus, IsElasticUntilTheRowYields) {
  EXPECT_EQ(fpm::pair_modulus(5.0, 1.0, 0.1, 0.0), 5.0);
}

TEST(PairModulus, IsTheSecantOfTheFlowWithinItsBounds) {
  const double root_three = std::sqrt(3.0);
  EXPECT_DOUBLE_EQ(fpm::pair_modulus(100.0, 1.0, 2.0, 0.5), root_three * 2.0 / 0.5);
  EXPECT_DOUBLE_EQ(fpm::pair_modulus(100.0, 0.5, 2.0, 0.5), 0.5 * root_three * 2.0 / 0.5);
  EXPECT_EQ(fpm::pair_modulus(100.0, 1.0, 2.0, 1e-9), 100.0);
  EXPECT_DOUBLE_EQ(fpm::pair_modulus(100.0, 1.0, 0.0, 0.5), 1e-5 * 100.0);
  EXPECT_DOUBLE_EQ(fpm::pair_modulus(100.0, 0.5, 0.0, 0.5), 0.5e-5 * 100.0);
}

}  // namespace
