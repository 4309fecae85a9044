#pragma once

#include <bit>
#include <boost/archive/archive_exception.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/split_free.hpp>
#include <boost/serialization/vector.hpp>
#include <boost/serialization/version.hpp>
#include <cstdint>
#include <vector>

#include "jfnk/solver.hpp"

/// Boost archives of a solve in progress; the user links Boost::serialization.
///
///   archive << solver.save();                     // between two steps
///   jfnk::Snapshot state;  archive >> state;  solver.load(state);
///
/// Numbers are archived as the 64 bits of their IEEE form: exact, and able to hold infinity and NaN
/// in text and XML archives too. A record of a newer class version is refused with
/// archive_exception::unsupported_class_version.
namespace jfnk {

/// Class version of an archived `Snapshot`; raised when its form changes.
inline constexpr int snapshot_archive_version = 1;

}  // namespace jfnk

namespace boost::serialization {

template <class Archive>
void save(Archive& archive, const jfnk::Snapshot& snapshot, unsigned int /*version*/) {
  std::vector<std::uint64_t> bits;
  bits.reserve(snapshot.reals.size());
  for (const double value : snapshot.reals) bits.push_back(std::bit_cast<std::uint64_t>(value));
  archive << make_nvp("integers", snapshot.integers);
  archive << make_nvp("reals", bits);
}

template <class Archive>
void load(Archive& archive, jfnk::Snapshot& snapshot, unsigned int version) {
  using boost::archive::archive_exception;
  if (version > static_cast<unsigned int>(jfnk::snapshot_archive_version)) {
    throw archive_exception(archive_exception::unsupported_class_version, "jfnk::Snapshot");
  }
  std::vector<std::uint64_t> bits;
  archive >> make_nvp("integers", snapshot.integers);
  archive >> make_nvp("reals", bits);
  snapshot.reals.clear();
  for (const std::uint64_t value : bits) snapshot.reals.push_back(std::bit_cast<double>(value));
}

}  // namespace boost::serialization

BOOST_SERIALIZATION_SPLIT_FREE(jfnk::Snapshot)
BOOST_CLASS_VERSION(jfnk::Snapshot, jfnk::snapshot_archive_version)
