// The first search and the record a checkpoint keeps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/LU>
#include <fpm/rows.hpp>

#include <any>
#include <functional>
#include <map>
#include <ostream>
#include <string>

#include "sets.hpp"

namespace {

using namespace fpm_test;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Rows, HoldAllNeighboursWithinTheSupportAndNotTheirOwnParticle) {
  const Model<2> m(lattice<2>({12, 9}));
  for (Index a = 0; a < m.rows.size(); ++a) {
    std::vector<Index> expected;
    for (Index b = 0; b < m.rows.size(); ++b) {
      const double distance = (m.set.position.row(b) - m.set.position.row(a)).norm();
      if (b != a && distance < support * 0.1) expected.push_back(b);
    }
    const auto found = m.rows.neighbours(a);
    EXPECT_EQ(std::vector<Index>(found.begin(), found.end()), expected);
    EXPECT_FALSE(m.rows.searched(a));
  }
}

TEST(Rows, TakeLatticeOffsetsAsExactMultiples) {
  // 0.1 is not a binary number: differences of coordinates would round differently in every row.
  const Model<2> m(lattice<2>({12, 9}, 0.1, LatticeLayout::cell, 0.0, 100.0));
  fpm::RowGeometry<2> inner;
  fpm::RowGeometry<2> other;
  m.rows.geometry(12 * 4 + 5, inner);
  m.rows.geometry(12 * 4 + 6, other);
  EXPECT_EQ(inner.offset, other.offset);
}

TEST(Rows, WidenTheSupportOfASparseRowAndOfNoOther) {
  // A particle 3.2 spacings off the lattice's side: none is within 2.4.
  const double spacing = 0.1;
  const auto block = fpm::make_lattice(lattice<2>({8, 8}, spacing));
  ParticleSet<2> set;
  set.position.resize(65, 2);
  set.position.topRows(64) = block.position;
  set.position.row(64) << 0.75 + 3.2 * spacing, 0.4;
  set.volume = Eigen::VectorXd::Constant(65, spacing * spacing);
  const Model<2> m(set, row_options<2>(spacing));
  fpm::RowGeometry<2> row;
  m.rows.geometry(64, row);
  EXPECT_GT(row.support_radius, 3.2 * spacing);
  EXPECT_LE(row.support_radius, 2.0 * support * spacing);
  EXPECT_GE(row.size(), 4);
  m.rows.geometry(30, row);
  EXPECT_EQ(row.support_radius, support * spacing);
}

TEST(Rows, NameTheParticleThatHasNoNeighbourhood) {
  auto set = fpm::make_lattice(lattice<2>({8, 8}));
  set.position.row(17) << 5.0, 5.0;
  EXPECT_THAT([&] { Model<2>(set, row_options<2>()); },
              ThrowsMessage<fpm::PoorNeighbourhood>(HasSubstr("particle 17 at (5, 5) m has no")));
}

TEST(Rows, RefuseAPlaneOfParticlesInSpace) {
  const auto plane = fpm::make_lattice(lattice<2>({8, 8}));
  ParticleSet<3> set;
  set.position.setZero(64, 3);
  set.position.leftCols(2) = plane.position;
  set.volume = plane.volume;
  EXPECT_THAT(
      [&] { Model<3>(set, row_options<3>()); },
      ThrowsMessage<fpm::PoorNeighbourhood>(HasSubstr("particle 0 at (0.05, 0.05, 0) m has no")));
}

TEST(Rows, AskForMoreNeighboursWhenSecondGradientsAreFitted) {
  EXPECT_EQ(row_options<2>(0.1, false).min_neighbours<2>(), 4);
  EXPECT_EQ(row_options<2>(0.1, true).min_neighbours<2>(), 5);
  EXPECT_EQ(row_options<3>(0.1, false).min_neighbours<3>(), 5);
  EXPECT_EQ(row_options<3>(0.1, true).min_neighbours<3>(), 9);
}

TEST(Rows, RefuseSizesAndOptionsThatCannotBe) {
  auto set = fpm::make_lattice(lattice<2>({8, 8}));
  const Ghosts<2> none;
  auto options = row_options<2>();
  options.support_radius = 0.0;
  EXPECT_THAT([&] { Rows<2>(set, none, options); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("support radius must be positive")));
  set.volume.conservativeResize(63);
  EXPECT_THAT(
      [&] { Rows<2>(set, none, row_options<2>()); },
      ThrowsMessage<fpm::ShapeError>(HasSubstr("particle volumes has size 63, expected 64")));
}

// What a checkpoint does with a state: every field by its name.
template <int Dim>
std::map<std::string, std::any> saved(Rows<Dim>& rows) {
  std::map<std::string, std::any> record;
  rows.for_each_field(
      [&](const char* name, const char*, const auto& field) { record[name] = field; });
  return record;
}

template <int Dim>
void load(Rows<Dim>& rows, const std::map<std::string, std::any>& record) {
  rows.for_each_field([&]<class T>(const char* name, const char*, T& field) {
    field = std::any_cast<const T&>(record.at(name));
  });
}

// A model of which some rows were re-searched after a shear.
struct ResearchedModel : Model<2> {
  ResearchedModel() : Model<2>(lattice<2>({10, 7}, 0.1), false, {{0, 0.0}}) {
    Tensor<2> f;
    f << 1.0, 0.0, 0.2, 1.1;
    const Field<2> now = affine<2>(set.position, f, Vector<2>::Zero());
    const std::vector<char> excluded(70, 0);
    rebuilt = rows.research({3, 24, 25, 60}, now, f.determinant() * set.volume, excluded);
  }
  std::vector<Index> rebuilt;
};

TEST(Rows, AreTheSameToTheLastBitAfterSaveAndRestore) {
  ResearchedModel m;
  ASSERT_THAT(m.rebuilt, ElementsAre(3, 24, 25, 60));
  Rows<2> copy;
  load(copy, saved(m.rows));
  copy.restore(m.set, m.ghosts, m.rows.options());

  fpm::RowGeometry<2> expected;
  fpm::RowGeometry<2> found;
  ASSERT_EQ(copy.size(), m.rows.size());
  for (Index a = 0; a < copy.size(); ++a) {
    EXPECT_TRUE(std::ranges::equal(copy.neighbours(a), m.rows.neighbours(a)));
    EXPECT_EQ(copy.searched(a), m.rows.searched(a));
    m.rows.geometry(a, expected);
    copy.geometry(a, found);
    EXPECT_EQ(found.offset, expected.offset);
    EXPECT_EQ(found.volume, expected.volume);
    EXPECT_EQ(found.own_volume, expected.own_volume);
    EXPECT_EQ(found.support_radius, expected.support_radius);
  }
  EXPECT_EQ(saved(copy).size(), 9U);
}

struct Damage {
  const char* name;
  const char* message;
  std::function<void(std::map<std::string, std::any>&)> apply;

  friend void PrintTo(const Damage& damage, std::ostream* out) { *out << damage.name; }
};

template <class T>
T& entry(std::map<std::string, std::any>& record, const char* name) {
  return std::any_cast<T&>(record.at(name));
}
using Indices = std::vector<Index>;
using Doubles = std::vector<double>;

class DamagedRows : public testing::TestWithParam<Damage> {};

INSTANTIATE_TEST_SUITE_P(
    Fields, DamagedRows,
    testing::Values(Damage{"offsets_short", "row offsets has size 70, expected 71",
                           [](auto& r) { entry<Indices>(r, "row_offset").pop_back(); }},
                    Damage{"offsets_empty", "row offsets has size 0, expected 71",
                           [](auto& r) { entry<Indices>(r, "row_offset").clear(); }},
                    Damage{"offsets_decrease", "not decrease",
                           [](auto& r) { entry<Indices>(r, "row_offset")[5] = 0; }},
                    Damage{"offsets_start", "start at 0",
                           [](auto& r) { entry<Indices>(r, "row_offset")[0] = 1; }},
                    Damage{"neighbours_short", "neighbours has size",
                           [](auto& r) { entry<Indices>(r, "neighbour").pop_back(); }},
                    Damage{"neighbour_unknown", "neighbour 100000 of",
                           [](auto& r) { entry<Indices>(r, "neighbour")[9] = 100000; }},
                    Damage{"neighbour_negative", "neighbour -1 of",
                           [](auto& r) { entry<Indices>(r, "neighbour")[0] = -1; }},
                    Damage{"neighbour_itself", "neighbours of row 0",
                           [](auto& r) { entry<Indices>(r, "neighbour")[0] = 0; }},
                    Damage{"neighbours_disordered", "neighbours of row 0",
                           [](auto& r) {
                             auto& list = entry<Indices>(r, "neighbour");
                             std::swap(list[0], list[1]);
                           }},
                    Damage{"radii_short", "support radii has size 69, expected 70",
                           [](auto& r) {
                             entry<Eigen::VectorXd>(r, "support_radius").conservativeResize(69);
                           }},
                    Damage{"radius_zero", "support radius of row 4",
                           [](auto& r) { entry<Eigen::VectorXd>(r, "support_radius")[4] = 0.0; }},
                    Damage{"volumes_short", "reference volumes has size 1, expected 70",
                           [](auto& r) {
                             entry<Eigen::VectorXd>(r, "reference_volume").conservativeResize(1);
                           }},
                    Damage{"volume_nan", "reference volume of row 6",
                           [](auto& r) { entry<Eigen::VectorXd>(r, "reference_volume")[6] = NAN; }},
                    Damage{"searched_unknown", "re-searched row 70 of 70",
                           [](auto& r) { entry<Indices>(r, "searched_row")[3] = 70; }},
                    Damage{"searched_disordered", "re-searched rows must ascend",
                           [](auto& r) {
                             auto& list = entry<Indices>(r, "searched_row");
                             std::swap(list[1], list[2]);
                           }},
                    Damage{"searched_missing", "volumes of re-searched rows",
                           [](auto& r) { entry<Indices>(r, "searched_row").pop_back(); }},
                    Damage{"searched_offsets_short", "offsets of re-searched rows",
                           [](auto& r) { entry<Doubles>(r, "searched_offset").pop_back(); }},
                    Damage{"searched_volumes_short", "volumes of re-searched rows",
                           [](auto& r) { entry<Doubles>(r, "searched_volume").pop_back(); }}),
    [](const auto& info) { return info.param.name; });

TEST_P(DamagedRows, AreRefusedOnRestore) {
  ResearchedModel m;
  auto record = saved(m.rows);
  GetParam().apply(record);
  Rows<2> copy;
  load(copy, record);
  EXPECT_THAT([&] { copy.restore(m.set, m.ghosts, m.rows.options()); },
              ThrowsMessage<fpm::ShapeError>(HasSubstr(GetParam().message)));
}

}  // namespace
