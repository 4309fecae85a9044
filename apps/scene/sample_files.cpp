#include "scene/sample_files.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "files/durable_file.hpp"
#include "tables/sample_text.hpp"

namespace scene {

void take_samples(tables::VaryingNumber& number, const std::string& key, const tables::Range& range,
                  tables::Diagnosis& diagnosis) {
  const tables::SampleFile file = *number.file;
  number.file.reset();
  if (!diagnosis.good({key})) return;
  const auto path = std::filesystem::path(diagnosis.source()).parent_path() / file.name;
  try {
    number = tables::VaryingNumber(tables::read_samples(files::read_text(path), file, range));
  } catch (const files::FileError& failure) {
    diagnosis.error(key, fmt::format("{}: {}", path.string(), failure.reason()),
                    "allowed is a file of values, its path from the scene's folder");
  } catch (const tables::SampleError& failure) {
    const std::string line = failure.line() > 0 ? fmt::format(":{}", failure.line()) : "";
    diagnosis.error(key, fmt::format("{}{}: {}", path.string(), line, failure.what()),
                    failure.allowed());
  }
}

}  // namespace scene
