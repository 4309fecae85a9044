#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "tables/diagnosis.hpp"
#include "tables/field.hpp"

namespace scene {

/// Reads the file of a number's samples, beside the text that named it; nothing of the file is left
/// then. What is wrong with it is an error of the diagnosis, under `key`.
void take_samples(tables::VaryingNumber& number, const std::string& key, const tables::Range& range,
                  tables::Diagnosis& diagnosis);

/// Likewise of every key that names such a file.
template <class Root>
void take_sample_files(const std::vector<tables::Table<Root>>& tables, Root& root,
                       tables::Diagnosis& diagnosis) {
  for (const tables::Table<Root>& table : tables) {
    for (const tables::Field<Root>& field : table.fields) {
      if (field.kind != tables::ValueKind::varying) continue;
      for (std::size_t entry = 0; entry < table.size(root); ++entry) {
        auto value = field.read(root, entry);
        if (!value || !std::get<tables::VaryingNumber>(*value).file) continue;
        take_samples(std::get<tables::VaryingNumber>(*value), table.path(entry, field.key),
                     field.notes.range, diagnosis);
        field.write(root, entry, *value);
      }
    }
  }
}

}  // namespace scene
