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

namespace {

bool is_of(const std::string& key, const std::string& table) {
  return key == table || key.starts_with(table + ".");
}

}  // namespace

Diagnosis Diagnosis::with_table_as(const std::string& table, const std::string& as) const {
  Diagnosis other(source_);
  const auto renamed = [&](const std::string& key) { return as + key.substr(table.size()); };
  for (const auto& [key, where] : places_) {
    if (is_of(key, table)) {
      other.places_[renamed(key)] = where;
    } else if (!is_of(key, as)) {
      other.places_[key] = where;
    }
  }
  for (const std::string& key : bad_) {
    if (is_of(key, table)) {
      other.bad_.insert(renamed(key));
    } else if (!is_of(key, as)) {
      other.bad_.insert(key);
    }
  }
  return other;
}

void Diagnosis::take(const Diagnosis& other, const std::string& table, const std::string& as) {
  const auto renamed = [&](Complaint complaint) {
    if (is_of(complaint.key, as)) {
      complaint.key = table + complaint.key.substr(as.size());
      complaint.where = where(complaint.key);
    }
    return complaint;
  };
  for (const Complaint& complaint : other.errors_) {
    errors_.push_back(renamed(complaint));
    bad_.insert(errors_.back().key);
  }
  for (const Complaint& complaint : other.warnings_) warnings_.push_back(renamed(complaint));
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
