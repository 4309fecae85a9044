#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace {

std::string text(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Readme, ShowsTheExampleThatIsBuiltAndRun) {
  const std::string folder = LIBFPM_FOLDER;
  const std::string example = text(folder + "/examples/stretched_block.cpp");
  ASSERT_FALSE(example.empty());
  EXPECT_NE(text(folder + "/README.md").find("```cpp\n" + example + "```\n"), std::string::npos);
}

}  // namespace
