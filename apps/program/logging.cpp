#include "program/logging.hpp"

#include <spdlog/logger.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <unistd.h>

#include "files/file_error.hpp"

namespace program {

struct Log::Sinks {
  spdlog::logger logger;
};

Log::Log(const std::filesystem::path& file, bool echo) {
  std::vector<spdlog::sink_ptr> sinks;
  try {
    sinks.push_back(std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string()));
  } catch (const spdlog::spdlog_ex& failure) {
    throw files::FileError(file, failure.what());
  }
  sinks.back()->set_pattern("%Y-%m-%d %H:%M:%S.%e %l: %v");
  if (echo) {
    sinks.push_back(std::make_shared<spdlog::sinks::stderr_sink_mt>());
    sinks.back()->set_level(spdlog::level::warn);
    // On a terminal a live progress line may be in the way.
    sinks.back()->set_pattern(::isatty(STDERR_FILENO) == 1 ? "\r\x1b[K%l: %v" : "%l: %v");
  }
  sinks_ = std::make_unique<Sinks>(Sinks{spdlog::logger("run", sinks.begin(), sinks.end())});
  sinks_->logger.flush_on(spdlog::level::info);
  // A full disk must not end a run because of its log; spdlog would otherwise print by itself.
  sinks_->logger.set_error_handler([](const std::string&) {});
}

Log::Log(Log&&) noexcept = default;
Log& Log::operator=(Log&&) noexcept = default;
Log::~Log() = default;

void Log::info(std::string_view line) {
  sinks_->logger.info(line);
}
void Log::warning(std::string_view line) {
  sinks_->logger.warn(line);
}
void Log::error(std::string_view line) {
  sinks_->logger.error(line);
}

}  // namespace program
