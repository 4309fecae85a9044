#include "wiring/logging.hpp"

#include <gmock/gmock.h>

#include "temporary_folder.hpp"
#include "wiring/durable_file.hpp"

namespace wiring {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Log, WritesEveryLineToTheFileAtOnce) {
  const test::TemporaryFolder folder;
  Log log(folder / "run.log", false);
  log.info("step 1 {not a format}");
  log.warning("cut back");
  log.error("stopped");
  const std::string text = read_text(folder / "run.log");
  EXPECT_THAT(text, HasSubstr("info: step 1 {not a format}\n"));
  EXPECT_THAT(text, HasSubstr("warning: cut back\n"));
  EXPECT_THAT(text, HasSubstr("error: stopped\n"));
}

TEST(Log, AppendsToTheLogOfAnEarlierRun) {
  const test::TemporaryFolder folder;
  Log(folder / "run.log", false).info("first");
  Log(folder / "run.log", false).info("second");
  EXPECT_THAT(read_text(folder / "run.log"), HasSubstr("first"));
}

TEST(Log, EchoesWarningsButNotInformation) {
  const test::TemporaryFolder folder;
  Log log(folder / "run.log");
  ::testing::internal::CaptureStderr();
  log.info("quiet");
  log.warning("loud");
  const std::string shown = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(shown, HasSubstr("warning: loud"));
  EXPECT_THAT(shown, Not(HasSubstr("quiet")));
}

TEST(Log, NamesTheFileItCannotOpen) {
  const test::TemporaryFolder folder;
  create_folder(folder / "run.log");
  EXPECT_THROW(Log(folder / "run.log", false), FileError);
}

}  // namespace
}  // namespace wiring
