#include "tables/diagnosis.hpp"

#include <algorithm>
#include <utility>

namespace tables {

std::string Complaint::text() const {
  std::string line = where + ": ";
  if (!key.empty()) line += key + ": ";
  line += found;
  if (!allowed.empty()) line += "; " + allowed;
  if (!nearest.empty()) line += "; did you mean \"" + nearest + "\"?";
  return line;
}

std::string Diagnosis::where(const std::string& key) const {
  for (std::string at = key; !at.empty();) {
    if (const auto found = places_.find(at); found != places_.end()) return found->second;
    const std::size_t dot = at.rfind('.');
    at = dot == std::string::npos ? "" : at.substr(0, dot);
  }
  return source_;
}

void Diagnosis::error(const std::string& key, std::string found, std::string allowed,
                      std::string nearest) {
  bad_.insert(key);
  errors_.push_back({where(key), key, std::move(found), std::move(allowed), std::move(nearest)});
}

void Diagnosis::warning(const std::string& key, std::string found, std::string allowed) {
  warnings_.push_back({where(key), key, std::move(found), std::move(allowed), ""});
}

bool Diagnosis::good(const std::vector<std::string>& keys) const {
  // A bad table (say, one that is no table at all) makes all its keys bad.
  return std::none_of(keys.begin(), keys.end(), [&](std::string key) {
    while (true) {
      if (bad_.count(key) != 0) return true;
      const std::size_t dot = key.rfind('.');
      if (dot == std::string::npos) return false;
      key.resize(dot);
    }
  });
}

}  // namespace tables
