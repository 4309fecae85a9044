#include <gtest/gtest.h>

#include <constitutive/elastic.hpp>
#include <constitutive/tensor.hpp>

namespace {

using namespace constitutive;

template <class Dimension>
class Tensor : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Tensor, Dimensions);

template <int Dim>
StressVector<Dim> counted() {
  return StressVector<Dim>::LinSpaced(1, stress_size<Dim>);
}

TYPED_TEST(Tensor, MatrixAndVoigtVectorAreInverseToEachOther) {
  constexpr int Dim = TypeParam::value;
  const StressVector<Dim> v = counted<Dim>();
  EXPECT_EQ(from_matrix<Dim>(to_matrix(v)), v);
}

TYPED_TEST(Tensor, ContractionEqualsTraceOfMatrixProduct) {
  constexpr int Dim = TypeParam::value;
  const StressVector<Dim> a = counted<Dim>(), b = a.reverse();
  EXPECT_DOUBLE_EQ(contract(a, b), (to_matrix(a) * to_matrix(b)).trace());
  EXPECT_DOUBLE_EQ(a.dot(with_engineering_shear(b)), contract(a, b));
}

TYPED_TEST(Tensor, DeviatorIsTracelessAndComplementsMeanStress) {
  constexpr int Dim = TypeParam::value;
  const StressVector<Dim> v = counted<Dim>();
  EXPECT_EQ(trace(deviator(v)), 0);
  EXPECT_EQ(StressVector<Dim>(deviator(v) + isotropic<Dim>(mean_stress(v))), v);
  EXPECT_DOUBLE_EQ(j2(v), (to_matrix(deviator(v)) * to_matrix(deviator(v))).trace() / 2);
}

TYPED_TEST(Tensor, StiffnessTimesStrainEqualsElasticStress) {
  constexpr int Dim = TypeParam::value;
  const ElasticModuli m = elastic_moduli(3, 0.25);
  const StrainVector<Dim> strain = counted<Dim>();
  const StressVector<Dim> by_matrix = elastic_stiffness<Dim>(3, 0.25) * strain;
  EXPECT_TRUE(by_matrix.isApprox(elastic_stress<Dim>(m, strain)));
}

TEST(ElasticModuli, UniaxialStressReturnsYoungsModulusAndPoissonsRatio) {
  const double nu = 0.3, e = 7;
  StrainVector<3> strain;
  strain << 1, -nu, -nu, 0, 0, 0;
  const StressVector<3> stress = elastic_stress<3>(elastic_moduli(e, nu), strain);
  EXPECT_DOUBLE_EQ(stress[0], e);
  EXPECT_NEAR(stress[1], 0, 1e-15 * e);
  EXPECT_NEAR(stress[2], 0, 1e-15 * e);
}

}  // namespace
