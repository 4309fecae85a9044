#pragma once

#include <bit>
#include <boost/archive/archive_exception.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/split_free.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/version.hpp>
#include <cstdint>
#include <string>
#include <string_view>

#include "constitutive/material.hpp"
#include "constitutive/state.hpp"

/// Boost archives of the records of this library; the user links Boost::serialization.
///
/// Both records walk their `for_each_field`, so that no field can be forgotten. Numbers are
/// archived as the 64 bits of their IEEE form: exact and able to hold infinity (the default
/// `dilation_cutoff`) in text and XML archives too, which cannot read back "inf". Materials are not
/// archived but made again from their parameters. A record of a newer class version is refused with
/// archive_exception::unsupported_class_version (Boost itself no longer checks this).
namespace constitutive {

/// Class version of an archived `MaterialParameters`; raised when its fields change.
inline constexpr int material_parameters_version = 4;

/// Class version of an archived `PointState`; raised when its fields change.
inline constexpr int point_state_version = 1;

namespace detail {

/// @throws boost::archive::archive_exception if the record was written by a later release
inline void refuse_newer(unsigned int archived, int known, const char* record) {
  using boost::archive::archive_exception;
  if (archived > static_cast<unsigned int>(known)) {
    throw archive_exception(archive_exception::unsupported_class_version, record);
  }
}

template <class Archive>
struct FieldSaver {
  Archive& archive;

  void operator()(const char* name, const std::string& field) const {
    archive << boost::serialization::make_nvp(name, field);
  }
  void operator()(const char* name, double field) const {
    const auto bits = std::bit_cast<std::uint64_t>(field);
    archive << boost::serialization::make_nvp(name, bits);
  }
  template <int Rows>
  void operator()(const char* name, const Eigen::Matrix<double, Rows, 1>& field) const {
    for (const double component : field) (*this)(name, component);
  }
};

template <class Archive>
struct FieldLoader {
  Archive& archive;

  void operator()(const char* name, std::string& field) const {
    archive >> boost::serialization::make_nvp(name, field);
  }
  void operator()(const char* name, double& field) const {
    std::uint64_t bits = 0;
    archive >> boost::serialization::make_nvp(name, bits);
    field = std::bit_cast<double>(bits);
  }
  template <int Rows>
  void operator()(const char* name, Eigen::Matrix<double, Rows, 1>& field) const {
    for (double& component : field) (*this)(name, component);
  }
};

}  // namespace detail
}  // namespace constitutive

namespace boost::serialization {

/// Writes the parameters of a material.
template <class Archive>
void save(Archive& archive, const constitutive::MaterialParameters& p, unsigned int /*version*/) {
  p.for_each_field(constitutive::detail::FieldSaver<Archive>{archive});
}

/// Reads the parameters of a material; they are not validated here.
template <class Archive>
void load(Archive& archive, constitutive::MaterialParameters& p, unsigned int version) {
  constitutive::detail::refuse_newer(version, constitutive::material_parameters_version,
                                     "constitutive::MaterialParameters");
  const constitutive::detail::FieldLoader<Archive> loader{archive};
  // A record of an earlier version ends before the fields that came later, which keep their
  // defaults.
  constexpr unsigned int with_tension_cutoff = 2, with_residuals = 3, with_curves = 4;
  const std::string_view last = version < with_tension_cutoff ? "dilation_cutoff"
                                : version < with_residuals    ? "tension_cutoff"
                                : version < with_curves       ? "preconsolidation_pressure"
                                                              : "";
  bool ended = false;
  p.for_each_field([&](const char* name, auto& field) {
    if (ended) return;
    loader(name, field);
    ended = last == name;
  });
}

/// Boost's entry point for `MaterialParameters`.
template <class Archive>
void serialize(Archive& archive, constitutive::MaterialParameters& p, unsigned int version) {
  split_free(archive, p, version);
}

/// Writes the state of a point.
template <class Archive, int Dim>
void save(Archive& archive, const constitutive::PointState<Dim>& s, unsigned int /*version*/) {
  s.for_each_field(constitutive::detail::FieldSaver<Archive>{archive});
}

/// Reads the state of a point.
template <class Archive, int Dim>
void load(Archive& archive, constitutive::PointState<Dim>& s, unsigned int version) {
  constitutive::detail::refuse_newer(version, constitutive::point_state_version,
                                     "constitutive::PointState");
  s.for_each_field(constitutive::detail::FieldLoader<Archive>{archive});
}

/// Boost's entry point for `PointState`.
template <class Archive, int Dim>
void serialize(Archive& archive, constitutive::PointState<Dim>& s, unsigned int version) {
  split_free(archive, s, version);
}

/// Class version of every dimension of `PointState` (Boost's macro takes no templates).
template <int Dim>
struct version<constitutive::PointState<Dim>> {
  // NOLINTBEGIN(readability-identifier-naming): the names are Boost's.
  using type = mpl::int_<constitutive::point_state_version>;
  using tag = mpl::integral_c_tag;
  // NOLINTEND(readability-identifier-naming)
  static constexpr int value = constitutive::point_state_version;
};

}  // namespace boost::serialization

BOOST_CLASS_VERSION(constitutive::MaterialParameters, constitutive::material_parameters_version)
