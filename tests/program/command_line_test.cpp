#include "program/command_line.hpp"

#include <gmock/gmock.h>

#include <new>
#include <sstream>

#include "files/file_error.hpp"

namespace program {
namespace {

namespace po = boost::program_options;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::ThrowsMessage;

po::options_description options() {
  po::options_description all;
  all.add_options()("threads", po::value<int>(), "")("quiet", po::bool_switch(), "");
  return all;
}

po::variables_map parsed(const std::vector<std::string>& arguments) {
  return parse(arguments, options(), "scene");
}

TEST(CommandLine, TellsOptionsFromWords) {
  const po::variables_map values = parsed({"a.toml", "--threads", "3", "b.toml"});
  EXPECT_EQ(values["threads"].as<int>(), 3);
  EXPECT_FALSE(values["quiet"].as<bool>());
  EXPECT_THAT(texts(values, "scene"), ElementsAre("a.toml", "b.toml"));
  EXPECT_THAT(texts(parsed({"--quiet"}), "scene"), IsEmpty());
}

TEST(CommandLine, TakesNoAbbreviation) {
  EXPECT_THAT([] { (void)parsed({"--quie"}); },
              ThrowsMessage<UsageError>(HasSubstr("--quie: no such option")));
}

TEST(CommandLine, NamesTheNearestOptionIfOneIsNear) {
  EXPECT_THAT([] { (void)parsed({"--thraeds=3"}); },
              ThrowsMessage<UsageError>(HasSubstr("did you mean \"--threads\"?")));
  EXPECT_THAT([] { (void)parsed({"--viscosity=3"}); },
              ThrowsMessage<UsageError>(Not(HasSubstr("did you mean"))));
}

TEST(CommandLine, SaysWhatIsWrongWithAValue) {
  EXPECT_THAT(
      [] {
        (void)parsed({"--threads", "many"});
      },
      ThrowsMessage<UsageError>(HasSubstr("many")));
  EXPECT_THAT([] { (void)parsed({"--threads"}); },
              ThrowsMessage<UsageError>(HasSubstr("--threads")));
}

struct Ending {
  ExitCode code;
  std::string said;
};

Ending ending_of(const std::function<ExitCode()>& run) {
  std::ostringstream err;
  const ExitCode code = run_program("fpm-any", err, run);
  return {code, err.str()};
}

TEST(RunProgram, PassesOnWhatTheProgramReturns) {
  const Ending ending = ending_of([] { return ExitCode::interrupted; });
  EXPECT_EQ(ending.code, ExitCode::interrupted);
  EXPECT_EQ(ending.said, "");
}

TEST(RunProgram, SendsWrongUseToTheHelp) {
  const Ending ending = ending_of([]() -> ExitCode { throw UsageError("--x: no such option"); });
  EXPECT_EQ(ending.code, ExitCode::input_refused);
  EXPECT_EQ(ending.said, "error: --x: no such option\nTry fpm-any --help.\n");
}

TEST(RunProgram, NamesTheFileThatCannotBeUsed) {
  const Ending ending = ending_of([]() -> ExitCode { throw files::FileError("a.hdf", "is cut"); });
  EXPECT_EQ(ending.code, ExitCode::checkpoint_unusable);
  EXPECT_EQ(ending.said, "error: a.hdf: is cut\n");
}

TEST(RunProgram, CallsAllElseABugButTheLackOfMemory) {
  // An argument refused somewhere inside is no fault of the user's, whatever its type.
  for (const char* what : {"index", "shape"}) {
    const Ending ending = ending_of([&]() -> ExitCode { throw std::invalid_argument(what); });
    EXPECT_EQ(ending.code, ExitCode::bug);
    EXPECT_EQ(ending.said,
              "internal error: " + std::string(what) + "\nThis is a bug: please report it.\n");
  }
  const Ending memory = ending_of([]() -> ExitCode { throw std::bad_alloc(); });
  EXPECT_EQ(memory.code, ExitCode::bug);
  EXPECT_EQ(memory.said, "error: out of memory\n");
}

}  // namespace
}  // namespace program
