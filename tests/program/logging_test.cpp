#include "program/logging.hpp"

#include <gmock/gmock.h>

#include "files/durable_file.hpp"
#include "support/temporary_folder.hpp"

namespace program {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Log, WritesEveryLineToTheFileAtOnce) {
  const support::TemporaryFolder folder;
  Log log(folder / "run.log", false);
  log.info("step 1 {not a format}");
  log.warning("cut back");
  log.error("stopped");
  const std::string text = files::read_text(folder / "run.log");
  EXPECT_THAT(text, HasSubstr("info: step 1 {not a format}\n"));
  EXPECT_THAT(text, HasSubstr("warning: cut back\n"));
  EXPECT_THAT(text, HasSubstr("error: stopped\n"));
}

TEST(Log, AppendsToTheLogOfAnEarlierRun) {
  const support::TemporaryFolder folder;
  Log(folder / "run.log", false).info("first");
  Log(folder / "run.log", false).info("second");
  EXPECT_THAT(files::read_text(folder / "run.log"), HasSubstr("first"));
}

TEST(Log, EchoesWarningsButNotInformation) {
  const support::TemporaryFolder folder;
  Log log(folder / "run.log");
  ::testing::internal::CaptureStderr();
  log.info("quiet");
  log.warning("loud");
  const std::string shown = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(shown, HasSubstr("warning: loud"));
  EXPECT_THAT(shown, Not(HasSubstr("quiet")));
}

TEST(Log, NamesTheFileItCannotOpen) {
  const support::TemporaryFolder folder;
  files::create_folder(folder / "run.log");
  EXPECT_THROW(Log(folder / "run.log", false), files::FileError);
}

}  // namespace
}  // namespace program
