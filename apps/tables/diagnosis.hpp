#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace tables {

/// One thing wrong (or doubtful) in what the user wrote.
struct Complaint {
  std::string where;    // file:line:column, or `--set a.b=value`
  std::string key;      // dotted, as --set takes it: material.0.cohesion; "" for the whole file
  std::string found;    // what is there
  std::string allowed;  // what may be there instead
  std::string nearest;  // the name probably meant, or ""

  /// `where: key: found; allowed[; did you mean "..."?]` on one line.
  [[nodiscard]] std::string text() const;
  bool operator==(const Complaint&) const = default;
};

/// Collects the complaints about one scene and knows where each key was written.
class Diagnosis {
 public:
  /// @param source  name shown before line and column, as the user gave it
  explicit Diagnosis(std::string source) : source_(std::move(source)) {}

  /// Remembers where a key or table was given.
  void place(const std::string& key, std::string where) { places_[key] = std::move(where); }
  /// Where a key, or else the nearest enclosing table, was given; else the source's name.
  [[nodiscard]] std::string where(const std::string& key) const;
  /// Whether the user wrote this key.
  [[nodiscard]] bool given(const std::string& key) const { return places_.count(key) != 0; }

  /// Adds an error; the key then counts as bad.
  void error(const std::string& key, std::string found, std::string allowed,
             std::string nearest = "");
  /// Adds a warning: the scene remains usable.
  void warning(const std::string& key, std::string found, std::string allowed);
  /// This one without its complaints, for rules on a table that speak of another one: what was
  /// given for `table` counts as given for `as`, and nothing else of that.
  [[nodiscard]] Diagnosis with_table_as(const std::string& table, const std::string& as) const;
  /// Adds the complaints of such a one, about its keys where they are.
  void take(const Diagnosis& other, const std::string& table, const std::string& as);

  /// Whether none of these keys has an error, so that a rule joining them can be judged.
  [[nodiscard]] bool good(const std::vector<std::string>& keys) const;

  [[nodiscard]] const std::string& source() const { return source_; }
  [[nodiscard]] const std::vector<Complaint>& errors() const { return errors_; }
  [[nodiscard]] const std::vector<Complaint>& warnings() const { return warnings_; }

 private:
  std::string source_;
  std::map<std::string, std::string> places_;
  std::set<std::string> bad_;
  std::vector<Complaint> errors_;
  std::vector<Complaint> warnings_;
};

}  // namespace tables
