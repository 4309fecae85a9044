#include "files/hdf5_file.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "files/durable_file.hpp"
#include "support/temporary_folder.hpp"

namespace files {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

template <class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const FileError& failure) {
    return failure.what();
  }
  return "no FileError";
}

TEST(Hdf5File, ReadsBackEveryTypeBitForBit) {
  const support::TemporaryFolder folder;
  const std::vector<double> doubles{0.1,
                                    -0.0,
                                    std::numeric_limits<double>::denorm_min(),
                                    std::numeric_limits<double>::infinity(),
                                    1e308,
                                    3.0};
  const std::vector<float> floats{0.1F, -2.5F};
  const std::vector<std::int64_t> longs{std::numeric_limits<std::int64_t>::min(), 7};
  const std::vector<std::int32_t> ints{-1, 2, 3};
  const std::vector<std::uint8_t> bytes{0, 255};
  {
    Hdf5File file = Hdf5File::create(folder / "a.hdf");
    file.write<double>("/state/deep/doubles", doubles, {2, 3}, "Pa");
    file.write<float>("/floats", floats, {2});
    file.write<std::int64_t>("/longs", longs, {2});
    file.write<std::int32_t>("/ints", ints, {3, 1});
    file.write<std::uint8_t>("/bytes", bytes, {2});
    file.close();
  }
  const Hdf5File file = Hdf5File::open(folder / "a.hdf");
  const auto read = file.read_all<double>("/state/deep/doubles");
  EXPECT_EQ(read, doubles);
  EXPECT_TRUE(std::signbit(read[1]));
  EXPECT_EQ(file.read_all<float>("/floats"), floats);
  EXPECT_EQ(file.read_all<std::int64_t>("/longs"), longs);
  EXPECT_EQ(file.read_all<std::int32_t>("/ints"), ints);
  EXPECT_EQ(file.read_all<std::uint8_t>("/bytes"), bytes);
  EXPECT_THAT(file.info("/state/deep/doubles").shape, ElementsAre(2, 3));
  EXPECT_EQ(file.info("/state/deep/doubles").unit, "Pa");
  EXPECT_EQ(file.info("/ints").type, "int32");
  EXPECT_EQ(file.info("/ints").unit, "");
}

TEST(Hdf5File, KeepsManyChunksAndCompressesOnRequest) {
  const support::TemporaryFolder folder;
  std::vector<double> values(400000);
  std::iota(values.begin(), values.end(), 0.0);
  for (const int deflate : {0, 4}) {
    Hdf5File file = Hdf5File::create(folder / std::to_string(deflate), {.deflate = deflate});
    file.write<double>("/values", values, {100000, 4});
    file.close();
    EXPECT_EQ(Hdf5File::open(folder / std::to_string(deflate)).read_all<double>("/values"), values);
  }
  EXPECT_LT(std::filesystem::file_size(folder / "4"), std::filesystem::file_size(folder / "0") / 2);
}

TEST(Hdf5File, KeepsEmptyDatasetsAndTexts) {
  const support::TemporaryFolder folder;
  Hdf5File file = Hdf5File::create(folder / "a.hdf");
  file.write<double>("/none", {}, {0, 4}, "m");
  file.write_text("/scene", "title = \"größe\"\n");
  file.write_text("/empty", "");
  file.close();
  const Hdf5File again = Hdf5File::open(folder / "a.hdf");
  EXPECT_TRUE(again.read_all<double>("/none").empty());
  EXPECT_THAT(again.info("/none").shape, ElementsAre(0, 4));
  EXPECT_EQ(again.read_text("/scene"), "title = \"größe\"\n");
  EXPECT_EQ(again.read_text("/empty"), "");
}

TEST(Hdf5File, KeepsAttributes) {
  const support::TemporaryFolder folder;
  Hdf5File file = Hdf5File::create(folder / "a.hdf");
  file.make_group("/state");
  file.write_attribute("/", "title", std::string("Ü"));
  file.write_attribute("/", "none", std::string());
  file.write_attribute("/state", "step", std::int64_t{120});
  file.write_attribute("/state", "time", 0.1);
  file.write_attribute("/state", "version", std::vector<std::int64_t>{1, 0});
  file.close();
  const Hdf5File again = Hdf5File::open(folder / "a.hdf");
  EXPECT_EQ(again.read_attribute("/", "title"), Attribute(std::string("Ü")));
  EXPECT_EQ(again.read_attribute("/", "none"), Attribute(std::string()));
  EXPECT_EQ(again.read_attribute("/state", "step"), Attribute(std::int64_t{120}));
  EXPECT_EQ(again.read_attribute("/state", "time"), Attribute(0.1));
  EXPECT_EQ(again.read_attribute("/state", "version"), Attribute(std::vector<std::int64_t>{1, 0}));
  EXPECT_THAT(again.list_attributes("/state"), ElementsAre("step", "time", "version"));
  EXPECT_TRUE(again.has_attribute("/state", "step"));
  EXPECT_FALSE(again.has_attribute("/state", "steps"));
  EXPECT_FALSE(again.has_attribute("/nowhere", "step"));
}

TEST(Hdf5File, KnowsWhatItHolds) {
  const support::TemporaryFolder folder;
  Hdf5File file = Hdf5File::create(folder / "a.hdf");
  file.write<double>("/b/data", std::vector<double>{1.0}, {1});
  file.make_group("/a/inner");
  EXPECT_THAT(file.list("/"), ElementsAre("a", "b"));
  EXPECT_TRUE(file.is_group("/b"));
  EXPECT_FALSE(file.is_group("/b/data"));
  EXPECT_TRUE(file.has("/a/inner"));
  EXPECT_FALSE(file.has("/c/inner"));
}

// Found by the fuzzer: a damaged link that leads back to its own group.
TEST(Hdf5File, RefusesToListGroupsThatLeadInACircle) {
  const support::TemporaryFolder folder;
  Hdf5File file = Hdf5File::create(folder / "a.hdf");
  file.make_group("/a/b/c/d");
  EXPECT_THAT(file.list("/a/b/c"), ElementsAre("d"));
  EXPECT_THROW(static_cast<void>(file.list("/a/b/c/d")), FileError);
}

TEST(Hdf5File, RefusesAnotherShapeOrTypeAndNamesIt) {
  const support::TemporaryFolder folder;
  Hdf5File file = Hdf5File::create(folder / "a.hdf");
  file.write<double>("/stress", std::vector<double>(8), {2, 4});
  std::vector<double> values(8);
  EXPECT_THAT(message_of([&] {
                file.read<double>("/stress", values, {4, 2});
              }),
              ::testing::EndsWith("a.hdf: /stress has the shape 2 x 4, not 4 x 2"));
  EXPECT_THAT(message_of([&] { (void)file.read_all<std::int64_t>("/stress"); }),
              ::testing::EndsWith("a.hdf: /stress holds float64, not int64"));
  EXPECT_THAT(message_of([&] { (void)file.read_all<double>("/strain"); }),
              HasSubstr("a.hdf: /strain cannot be opened (HDF5: "));
  EXPECT_THAT(message_of([&] { (void)file.read_text("/stress"); }),
              ::testing::EndsWith("/stress is no text"));
  EXPECT_THROW(file.write<double>("/more", values, {7}), std::invalid_argument);
}

TEST(Hdf5File, PrintsNothingWhenItFails) {
  const support::TemporaryFolder folder;
  ::testing::internal::CaptureStderr();
  EXPECT_THROW((void)Hdf5File::open(folder / "none.hdf"), FileError);
  EXPECT_THROW((void)Hdf5File::create(folder / "no such folder" / "a.hdf"), FileError);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Hdf5File, RefusesAFileThatIsCutOrIsNone) {
  const support::TemporaryFolder folder;
  {
    Hdf5File file = Hdf5File::create(folder / "a.hdf");
    file.write<double>("/values", std::vector<double>(1000, 1.0), {1000});
    file.close();
  }
  std::filesystem::resize_file(folder / "a.hdf", std::filesystem::file_size(folder / "a.hdf") - 8);
  EXPECT_THAT(message_of([&] { (void)Hdf5File::open(folder / "a.hdf"); }),
              HasSubstr("is no whole HDF5 file"));
  write_text_durably(folder / "b.hdf", "not HDF5");
  EXPECT_THAT(message_of([&] { (void)Hdf5File::open(folder / "b.hdf"); }),
              HasSubstr("is no whole HDF5 file"));
}

TEST(Hdf5File, DetectsAFlippedByteInItsData) {
  const support::TemporaryFolder folder;
  {
    Hdf5File file = Hdf5File::create(folder / "a.hdf");
    file.write<double>("/values", std::vector<double>(1000, 1.0), {1000});
    file.close();
  }
  std::string bytes = read_text(folder / "a.hdf");
  // 1.0 is 3ff0...: a run of many of them is the data.
  const double ones[2] = {1.0, 1.0};
  const std::size_t at = bytes.find(std::string(reinterpret_cast<const char*>(ones), sizeof ones));
  ASSERT_NE(at, std::string::npos);
  bytes[at + 64] = static_cast<char>(bytes[at + 64] ^ 1);
  write_text_durably(folder / "a.hdf", bytes);
  const Hdf5File file = Hdf5File::open(folder / "a.hdf");
  EXPECT_THAT(message_of([&] { (void)file.read_all<double>("/values"); }),
              HasSubstr("a.hdf: /values cannot be read (HDF5: "));
}

}  // namespace
}  // namespace files
