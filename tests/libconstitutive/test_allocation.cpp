#include <gtest/gtest.h>

#include <constitutive/constitutive.hpp>
#include <cstdlib>
#include <new>

#include "points.hpp"

namespace {

long allocations = 0;

void* counted_allocation(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) {
  return counted_allocation(size);
}
void* operator new[](std::size_t size) {
  return counted_allocation(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace {

using namespace constitutive;

template <int Dim>
void evaluate(const Material& material, const StressVector<Dim>& stress) {
  const SpatialMatrix<Dim> dF = SpatialMatrix<Dim>::Constant(0.01) + SpatialMatrix<Dim>::Identity();
  PointState<Dim> s0, s1;
  const auto inc = objective_increment(dF);
  const auto trial = elastic_trial(stress, inc, moduli(material));
  (void)update(material, trial, s0, s1);
  const TangentMatrix<Dim> t = tangent(material, trial, s0);
  const auto d = elastic_trial_derivative(stress, inc, derivative(inc, dF), moduli(material));
  const StressVector<Dim> change = t * d;
  ASSERT_TRUE(change.allFinite());
}

TEST(HotFunctions, DoNotAllocate) {
  const auto cone = std::get<DruckerPrager>(make_material(points::soil("drucker_prager")));
  std::vector<MaterialParameters> soils = points::plastic_soils();
  soils.push_back(points::clay());
  MaterialParameters softening = points::soil("mohr_coulomb");
  softening.residual_strain = 0.1;
  softening.residual_cohesion = 1e3;
  soils.push_back(softening);
  for (const MaterialParameters& p : soils) {
    const Material material = make_material(p);
    const double size = 3 * std::max(p.cohesion, 1e4);
    points::RandomStress<2> flat(size);
    points::RandomStress<3> solid(size);
    const long before = allocations;
    for (int i = 0; i < 100; ++i) {
      evaluate<2>(material, flat());
      evaluate<3>(material, solid());
      MixedTrial<4> trial;
      trial.pressure = -p.cohesion;
      for (auto& s : trial.deviator) s = deviator(flat());
      constexpr std::array<double, 4> weights{0.25, 0.25, 0.25, 0.25};
      const auto r = mixed_return(cone, trial, weights, 0.0);
      mixed_tangent(cone, trial, weights, 0.0, r).apply_to_trial(trial, trial);
    }
    EXPECT_EQ(allocations, before) << points::label(p);
  }
}

TEST(HotFunctions, AllocationCounterCounts) {
  const long before = allocations;
  const std::vector<double> witness(100, 1.0);
  EXPECT_GT(allocations, before) << witness.size();
}

}  // namespace
