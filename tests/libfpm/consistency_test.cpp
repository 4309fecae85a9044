// The consistency correction: what it mends, and what it must not spoil.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <fpm/consistency.hpp>

#include "corrected_body.hpp"

namespace {

using namespace fpm_test;
template <int Dim>
void expect_force_patch_test(const Cells<Dim>& cells, bool symmetric) {
  const Corrected<Dim> body(cells, symmetric);
  const Tensor<Dim> stress = some_stress<Dim>(symmetric);
  const Field<Dim> external = body.external_force(stress);
  const MomentOperator<Dim> plain(body.model.rows, body.model.ghosts, {});
  const double before = (body.internal_force(plain, stress) - external).norm();
  const double after = (body.internal_force(body.op, stress) - external).norm();
  const Field<Dim> defect = consistency_defect(body.model.rows, body.model.ghosts, body.area);
  EXPECT_GT(before, 1e-3 * external.norm());
  // The boundary is where its coordinates say but for the round-off of their differences.
  const double misplaced = body.model.rows.coordinate_round_off() / (support * body.box.spacing);
  EXPECT_LE(after, 2.0 * (solver_tolerance * defect.norm() + misplaced * body.area.norm()) *
                       stress.norm());
}

template <int Dim>
void expect_force_patch_test(const LatticeOptions<Dim>& box, bool symmetric) {
  expect_force_patch_test(Cells<Dim>(box), symmetric);
}

TEST(Consistency, MakesTheForcePatchTestExact) {
  for (const bool symmetric : {false, true}) {
    for (const double jitter : {0.0, 0.2}) {
      for (const auto layout : {LatticeLayout::cell, LatticeLayout::vertex}) {
        SCOPED_TRACE(testing::Message() << "symmetric " << symmetric << ", jitter " << jitter
                                        << ", vertices " << (layout == LatticeLayout::vertex));
        expect_force_patch_test<2>(lattice<2>({18, 10}, 0.1, layout, jitter), symmetric);
        expect_force_patch_test<3>(lattice<3>({6, 5, 5}, 0.1, layout, jitter), symmetric);
      }
    }
  }
}

TEST(Consistency, HoldsWhereCellsDifferInWidth) {
  for (const bool symmetric : {false, true}) {
    for (const double jitter : {0.0, 0.2, 0.4}) {
      SCOPED_TRACE(testing::Message() << "symmetric " << symmetric << ", jitter " << jitter);
      expect_force_patch_test(graded_cells<2>({32, 24}, 0.1, jitter), symmetric);
      expect_force_patch_test(graded_cells<3>({12, 12, 8}, 0.1, jitter), symmetric);
    }
  }
}

TEST(Consistency, HoldsOnALongFineBody) {
  // The smoothest potentials cost the least energy: S has eigenvalues down to (spacing / length)^4.
  expect_force_patch_test<2>(lattice<2>({200, 8}, 0.1, LatticeLayout::cell, 0.2), false);
}

TEST(Consistency, HoldsFarFromTheOrigin) {
  for (const double jitter : {0.0, 0.2}) {
    for (const auto layout : {LatticeLayout::cell, LatticeLayout::vertex}) {
      for (const double origin : {1e5, -5e6}) {
        SCOPED_TRACE(testing::Message() << "origin " << origin << ", jitter " << jitter
                                        << ", vertices " << (layout == LatticeLayout::vertex));
        expect_force_patch_test<2>(lattice<2>({18, 10}, 0.1, layout, jitter, origin), false);
        expect_force_patch_test<3>(lattice<3>({6, 5, 5}, 0.1, layout, jitter, origin), false);
      }
    }
  }
}

TEST(Consistency, DoesNotDependOnTheUnitOfLength) {
  const Corrected<2> metres(lattice<2>({12, 8}, 0.125, LatticeLayout::cell, 0.2), false);
  const Corrected<2> other(lattice<2>({12, 8}, 128.0, LatticeLayout::cell, 0.2), false);
  const Tensor<2> stress = some_stress<2>(false);
  const Field<2> force = other.internal_force(other.op, stress);
  EXPECT_LE((force - other.external_force(stress)).norm(), 100.0 * solver_tolerance * force.norm());
  EXPECT_LE((force / 1024.0 - metres.internal_force(metres.op, stress)).norm(),
            100.0 * solver_tolerance * force.norm() / 1024.0);
}

template <int Dim>
void expect_linear_fields_kept(bool symmetric) {
  const Counts<Dim> cells = Counts<Dim>::Constant(Dim == 2 ? 12 : 5);
  const Corrected<Dim> body(lattice<Dim>(cells, 0.1, LatticeLayout::cell, 0.2), symmetric);
  Tensor<Dim> f = some_tensor<Dim>();
  Vector<Dim> shift = Vector<Dim>::Ones();
  if (symmetric) {  // a field that the plane admits
    f.row(0).setZero();
    f.col(0).setZero();
    f(0, 0) = 1.2;
    shift[0] = 0.0;
  }
  const Field<Dim> field = affine<Dim>(body.model.set.position, f, shift);
  const Eigen::MatrixXd moments = gathered(body.op, field);
  double sum_of_weights = 0.0;
  for (Index a = 0; a < body.size(); ++a) {
    double sum = 0.0;
    body.op.for_each_entry(
        a, [&](Index, const double* g) { sum += Eigen::Map<const Vector<Dim>>(g).norm(); });
    sum_of_weights = std::max(sum_of_weights, sum);
  }
  // Condition numbers are below 200 here, rows have up to 90 terms.
  const double tolerance =
      (4.0 * 200.0 + 90.0) * epsilon * sum_of_weights * field.cwiseAbs().maxCoeff();
  const Eigen::RowVectorXd expected = f.reshaped().transpose();
  EXPECT_LE((moments.rowwise() - expected).cwiseAbs().maxCoeff(), tolerance);
}

TEST(Consistency, KeepsLinearExactness) {
  for (const bool symmetric : {false, true}) {
    expect_linear_fields_kept<2>(symmetric);
    expect_linear_fields_kept<3>(symmetric);
  }
}

TEST(Consistency, LeavesAloneWhatOnlyRoundsOff) {
  // Planes of symmetry on all sides: the body has no boundary, and sum V G = 0 = s.
  const auto box = lattice<2>({10, 8});
  const Model<2> m(box, false, {{0, 0.0}, {0, box.max[0]}, {1, 0.0}, {1, box.max[1]}});
  const Field<2> none = Field<2>::Zero(80, 2);
  const double round_off_of_defect = 1e3 * epsilon * 0.1 * 9.0;  // |V G| summed over all rows
  EXPECT_LE(consistency_defect(m.rows, m.ghosts, none).norm(), round_off_of_defect);
  const auto correction = consistency_correction(m.rows, m.ghosts, none);
  const MomentOperator<2> corrected(m.rows, m.ghosts, {}, correction);
  const MomentOperator<2> plain(m.rows, m.ghosts, {});
  const Field<2> u = random_field<2>(80, 3);
  const Eigen::MatrixXd expected = gathered(plain, u);
  EXPECT_LE((gathered(corrected, u) - expected).norm(), 1e3 * epsilon * 9.0 * expected.norm());
}

TEST(Consistency, SaysSoIfTheAreaVectorsCloseNoSurface) {
  const auto box = lattice<2>({10, 8}, 0.1, LatticeLayout::vertex);
  const Model<2> m(box);
  const Field<2> open = fpm::tributary_area_vectors(box, {{0, false}, {0, true}, {1, false}});
  EXPECT_THAT([&] { consistency_correction(m.rows, m.ghosts, open); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("close the surface")));
}

TEST(Consistency, LeavesTheStencilsOfALatticeShared) {
  // Rows of the two layers next to a face are cut by it (support 2.4 spacings); the others are not.
  const Corrected<2> body(lattice<2>({40, 30}), false);
  const MomentOperator<2> plain(body.model.rows, body.model.ghosts, {});
  Index corrected = 0;
  for (Index a = 0; a < body.size(); ++a) {
    const auto x = body.model.set.position.row(a) / 0.1;
    const bool cut = x[0] < 2.0 || x[0] > 38.0 || x[1] < 2.0 || x[1] > 28.0;
    EXPECT_EQ(body.correction.corrects(a), cut) << a;
    EXPECT_EQ(gradient_weights(body.op, a) == gradient_weights(plain, a), !cut) << a;
    if (cut) ++corrected;
  }
  EXPECT_EQ(corrected, 40 * 30 - 36 * 26);
}

TEST(Consistency, DefectVanishesInsideARegularLattice) {
  const Corrected<2> body(lattice<2>({16, 16}), false);
  const Field<2> defect = consistency_defect(body.model.rows, body.model.ghosts, body.area);
  double inside = 0.0;
  for (Index a = 0; a < 256; ++a) {
    const Vector<2> x = body.model.set.position.row(a).transpose() / 0.1;
    // Two supports off the boundary, rows and their neighbours are all alike.
    if (x.minCoeff() > 5.0 && x.maxCoeff() < 11.0) {
      inside = std::max(inside, defect.row(a).norm());
    }
  }
  EXPECT_GT(defect.cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LE(inside, round_off(90.0, 0.01));  // V G <= spacing^2 / spacing / 10
}

TEST(Consistency, DefectIsOrthogonalToAffineFields) {
  // sum e = 0 and sum e x X = 0, since sum s and sum s x X are those of the volume.
  const Corrected<3> body(lattice<3>({5, 5, 5}, 0.1, LatticeLayout::cell, 0.2), false);
  const Field<3> defect = consistency_defect(body.model.rows, body.model.ghosts, body.area);
  const double tolerance = (4.0 * 500.0 + 90.0) * epsilon * defect.cwiseAbs().sum();
  EXPECT_LE(defect.colwise().sum().norm(), tolerance);
  EXPECT_LE((defect.transpose() * body.model.set.position).norm(), 10.0 * tolerance);
}

TEST(Consistency, ResearchedRowsDropIt) {
  Corrected<2> body(lattice<2>({12, 10}, 0.1, LatticeLayout::cell, 0.2), false);
  const std::vector<char> excluded(120, 0);
  const auto rebuilt =
      body.model.rows.research({0, 54}, body.model.set.position, body.model.set.volume, excluded);
  ASSERT_EQ(rebuilt.size(), 2U);
  const MomentOperator<2> after(body.model.rows, body.model.ghosts, {}, body.correction);
  const MomentOperator<2> plain(body.model.rows, body.model.ghosts, {});
  for (const Index a : rebuilt) {
    EXPECT_EQ(gradient_weights(after, a), gradient_weights(plain, a));
    EXPECT_NE(gradient_weights(after, a), gradient_weights(body.op, a));
  }
  EXPECT_EQ(gradient_weights(after, 53), gradient_weights(body.op, 53));
}

TEST(Consistency, RefusesAreaVectorsOfAnotherSize) {
  const Model<2> m(lattice<2>({8, 8}));
  const Field<2> few = Field<2>::Zero(63, 2);
  EXPECT_THROW(consistency_defect(m.rows, m.ghosts, few), fpm::ShapeError);
  EXPECT_THROW(consistency_correction(m.rows, m.ghosts, few), fpm::ShapeError);
}

}  // namespace
