#include <gtest/gtest.h>

#include <boost/archive/archive_exception.hpp>
#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/archive/text_iarchive.hpp>
#include <boost/archive/text_oarchive.hpp>
#include <boost/archive/xml_iarchive.hpp>
#include <boost/archive/xml_oarchive.hpp>
#include <boost/serialization/split_member.hpp>
#include <constitutive/serialization.hpp>
#include <sstream>
#include <string_view>

namespace newer {

// The record as a later release might write it: same name in an archive, higher class version.
struct Parameters {
  template <class Archive>
  void serialize(Archive& archive, unsigned int /*version*/) {
    archive& model;
  }
  std::string model = "elastic";
};

}  // namespace newer

namespace older {

// The record as it was: class version 1 had eight fields, version 2 the tension cut-off as well.
template <int Version>
struct Parameters {
  constitutive::MaterialParameters now;
  template <class Archive>
  void save(Archive& archive, unsigned int /*version*/) const {
    int field_count = 0;
    now.for_each_field([&](const char* name, const auto& field) {
      if (++field_count > 7 + Version) return;
      constitutive::detail::FieldSaver<Archive>{archive}(name, field);
    });
  }
  template <class Archive>
  void load(Archive&, unsigned int) {}
  BOOST_SERIALIZATION_SPLIT_MEMBER()
};

}  // namespace older

BOOST_CLASS_VERSION(older::Parameters<1>, 1)
BOOST_CLASS_VERSION(older::Parameters<2>, 2)
BOOST_CLASS_VERSION(newer::Parameters, constitutive::material_parameters_version + 1)

namespace {

using namespace constitutive;

struct Text {
  using Out = boost::archive::text_oarchive;
  using In = boost::archive::text_iarchive;
};
struct Xml {
  using Out = boost::archive::xml_oarchive;
  using In = boost::archive::xml_iarchive;
};
struct Binary {
  using Out = boost::archive::binary_oarchive;
  using In = boost::archive::binary_iarchive;
};

template <class Kind, class Record>
Record round_trip(const Record& record) {
  std::stringstream stream;
  {
    typename Kind::Out out(stream);
    out << boost::serialization::make_nvp("record", record);
  }
  Record copy;
  typename Kind::In in(stream);
  in >> boost::serialization::make_nvp("record", copy);
  return copy;
}

template <class Kind>
class Archives : public testing::Test {};
using Kinds = testing::Types<Text, Xml, Binary>;
TYPED_TEST_SUITE(Archives, Kinds);

TYPED_TEST(Archives, ReturnMaterialParametersBitForBit) {
  MaterialParameters p;
  p.model = "mohr_coulomb";
  p.youngs_modulus = 1e7 / 3;
  p.poissons_ratio = -0.1;
  p.cohesion = 1e-300;
  p.friction_angle = 100.0 / 3;
  p.dilation_angle = 0.1;
  p.density = 1850;
  EXPECT_EQ(round_trip<TypeParam>(p), p) << "with the infinite cut-off";
  p.dilation_cutoff = 0.05;
  p.tension_cutoff = 0;
  p.residual_strain = 0.1;
  p.residual_cohesion = 1.0 / 3;
  p.preconsolidation_pressure = 1e5;
  p.gsi = 100.0 / 3;
  p.strength_factor = 1.1;
  EXPECT_EQ(round_trip<TypeParam>(p), p);
}

template <class Kind, int Dim>
void expect_state_returns() {
  PointState<Dim> s;
  s.stress.setLinSpaced(-1.0 / 3, 1e9 / 7);
  s.plastic_strain = 0.1;
  s.plastic_volume_strain = -1e-17;
  const PointState<Dim> copy = round_trip<Kind>(s);
  EXPECT_EQ(copy.stress, s.stress);
  EXPECT_EQ(copy.plastic_strain, s.plastic_strain);
  EXPECT_EQ(copy.plastic_volume_strain, s.plastic_volume_strain);
}

TYPED_TEST(Archives, ReturnPointStatesBitForBit) {
  expect_state_returns<TypeParam, 2>();
  expect_state_returns<TypeParam, 3>();
}

TEST(Archive, CarriesTheClassVersion) {
  using boost::serialization::version;
  static_assert(version<MaterialParameters>::value == material_parameters_version);
  static_assert(version<PointState<2>>::value == point_state_version);
  static_assert(version<PointState<3>>::value == point_state_version);
  std::stringstream stream;
  boost::archive::xml_oarchive out(stream);
  const PointState<2> s;
  out << boost::serialization::make_nvp("record", s);
  EXPECT_NE(stream.str().find("version=\"1\""), std::string::npos) << stream.str();
}

TEST(Archive, OfANewerClassVersionIsRefused) {
  std::stringstream stream;
  {
    boost::archive::text_oarchive out(stream);
    const newer::Parameters p;
    out << p;
  }
  boost::archive::text_iarchive in(stream);
  MaterialParameters p;
  try {
    in >> p;
    FAIL() << "a newer record was read without complaint";
  } catch (const boost::archive::archive_exception& refused) {
    EXPECT_EQ(refused.code, boost::archive::archive_exception::unsupported_class_version);
  }
}

template <int Version>
MaterialParameters read_from_older() {
  older::Parameters<Version> old;
  old.now.model = "mohr_coulomb";
  old.now.dilation_cutoff = 0.05;
  old.now.tension_cutoff = 1e3;
  old.now.residual_strain = 0.1;
  std::stringstream stream;
  {
    boost::archive::text_oarchive out(stream);
    const older::Parameters<Version>& record = old;
    out << record;
  }
  boost::archive::text_iarchive in(stream);
  MaterialParameters p;
  in >> p;
  EXPECT_EQ(p.model, "mohr_coulomb");
  EXPECT_EQ(p.dilation_cutoff, 0.05);
  return p;
}

TEST(Archive, OfARecordBeforeTheTensionCutoffIsReadWithoutOne) {
  EXPECT_TRUE(std::isinf(read_from_older<1>().tension_cutoff));
}

TEST(Archive, OfARecordBeforeResidualStrengthsIsReadWithoutThem) {
  const MaterialParameters p = read_from_older<2>();
  EXPECT_EQ(p.tension_cutoff, 1e3);
  EXPECT_TRUE(std::isinf(p.residual_strain));
  EXPECT_EQ(p.compression_index, 0);
}

}  // namespace
