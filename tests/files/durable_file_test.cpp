#include "files/durable_file.hpp"

#include <gmock/gmock.h>

#include "support/temporary_folder.hpp"

namespace files {
namespace {

std::size_t entries_of(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(DurableFile, ReplacesTheWholeContentAndLeavesNothingElse) {
  const support::TemporaryFolder folder;
  write_text_durably(folder / "a.txt", "a long first content");
  write_text_durably(folder / "a.txt", "short");
  EXPECT_EQ(read_text(folder / "a.txt"), "short");
  EXPECT_EQ(entries_of(folder.path()), 1U);
}

TEST(DurableFile, IsAsItWasWhenWritingFails) {
  const support::TemporaryFolder folder;
  write_text_durably(folder / "a.txt", "old");
  const auto broken = [&](const std::filesystem::path& temporary) {
    write_text_durably(temporary, "half of the n");
    throw std::runtime_error("power is gone");
  };
  EXPECT_THROW(write_durably(folder / "a.txt", broken), std::runtime_error);
  EXPECT_EQ(read_text(folder / "a.txt"), "old");
  EXPECT_EQ(entries_of(folder.path()), 1U);
}

TEST(DurableFile, NamesFileAndReasonWhenTheFolderIsGone) {
  const support::TemporaryFolder folder;
  try {
    write_text_durably(folder / "no such" / "a.txt", "x");
    FAIL() << "wrote into a folder that does not exist";
  } catch (const FileError& failure) {
    EXPECT_THAT(failure.what(), ::testing::HasSubstr("no such/a.txt"));
    EXPECT_THAT(failure.what(), ::testing::HasSubstr("No such file or directory"));
  }
}

TEST(DurableFile, CannotTakeTheNameOfAFolder) {
  const support::TemporaryFolder folder;
  create_folder(folder / "a" / "b");
  EXPECT_THROW(write_text_durably(folder / "a", "x"), FileError);
  EXPECT_EQ(entries_of(folder.path()), 1U);
}

TEST(DurableFile, CannotMakeAFolderBelowAFile) {
  const support::TemporaryFolder folder;
  write_text_durably(folder / "a", "x");
  EXPECT_THROW(create_folder(folder / "a" / "b"), FileError);
}

}  // namespace
}  // namespace files
