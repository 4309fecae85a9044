// A damaged checkpoint is refused with its reason, or does no harm; never a wrong run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "files/content_digest.hpp"
#include "files/file_seal.hpp"
#include "files/hdf5_file.hpp"
#include "files/unsealed_file.hpp"
#include "record/checkpoint_file.hpp"
#include "restart.hpp"

namespace restart {
namespace {

using ::testing::HasSubstr;

void overwrite(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

/// Turns one bit of the first place where `pattern` stands.
void damage(const std::filesystem::path& file, const std::string& pattern) {
  std::string bytes = bytes_of_file(file);
  const std::size_t at = bytes.find(pattern);
  ASSERT_NE(at, std::string::npos);
  bytes[at + pattern.size() / 2] ^= 1;
  overwrite(file, bytes);
}

/// The bytes of the stress of a checkpoint's first particles.
std::string stress_bytes(const std::filesystem::path& checkpoint) {
  const auto stress = files::Hdf5File::open(checkpoint).read_all<double>("/state/particles/stress");
  const auto bytes = std::as_bytes(std::span(stress).first(16));
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

class DamagedCheckpoint : public ::testing::Test {
 protected:
  void SetUp() override {
    run_ = folder_ / "run";
    ASSERT_EQ(fpm_run_in(run_, block).code, program::ExitCode::done);
  }

  support::TemporaryFolder folder_;
  std::filesystem::path run_;
};

TEST_F(DamagedCheckpoint, IsRefusedAndTheNextOlderUsableOneNamed) {
  const auto newest = checkpoint_of(run_, 6), newer = checkpoint_of(run_, 5);
  damage(newest, stress_bytes(newest));
  overwrite(newer, bytes_of_file(newer).substr(0, 5000));
  const Outcome outcome = fpm_run_in(run_, block, {"--resume=" + newest.string()});
  EXPECT_EQ(outcome.code, program::ExitCode::checkpoint_unusable);
  EXPECT_THAT(outcome.err, HasSubstr("is damaged: its bytes are not those that were sealed"));
  EXPECT_THAT(outcome.err,
              HasSubstr("the next older usable one is " + checkpoint_of(run_, 4).string()));
}

TEST_F(DamagedCheckpoint, IsPassedOverWithAWarningWhenNoneIsNamed) {
  const std::string curve = bytes_of_file(run_ / "curve.csv");
  damage(checkpoint_of(run_, 6), stress_bytes(checkpoint_of(run_, 6)));
  const Outcome outcome = fpm_run_in(run_, block, {"--resume"});
  EXPECT_EQ(outcome.code, program::ExitCode::done) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("resuming from " + checkpoint_of(run_, 5).string()));
  EXPECT_THAT(bytes_of_file(run_ / "run.log"), HasSubstr("step-000006.hdf: is damaged"));
}

TEST_F(DamagedCheckpoint, IsNeverReplacedByAStartFromZero) {
  for (int step = 0; step <= 6; ++step) overwrite(checkpoint_of(run_, step), "not HDF5");
  const std::string curve = bytes_of_file(run_ / "curve.csv");
  const Outcome outcome = fpm_run_in(run_, block, {"--resume"});
  EXPECT_EQ(outcome.code, program::ExitCode::checkpoint_unusable);
  EXPECT_THAT(outcome.err, HasSubstr("no checkpoint is usable"));
  EXPECT_EQ(bytes_of_file(run_ / "curve.csv"), curve);

  const Outcome nothing = fpm_run_in(folder_ / "nowhere", block, {"--resume"});
  EXPECT_EQ(nothing.code, program::ExitCode::checkpoint_unusable);
  EXPECT_THAT(nothing.err, HasSubstr("there is no checkpoint to resume from"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "nowhere"));
}

/// Why a file is refused, or "" if it opens.
std::string refusal_of(const std::filesystem::path& file) {
  record::CheckpointNotes notes;
  try {
    (void)record::open_checkpoint(file, notes);
    return "";
  } catch (const files::FileError& failure) {
    return failure.reason();
  }
}

// By name: what each part of a checkpoint looks like in its file.
TEST_F(DamagedCheckpoint, IsRefusedWhereverAByteIsFlipped) {
  const auto sound = checkpoint_of(run_, 3), damaged = run_ / "damaged.hdf";
  const std::string bytes = bytes_of_file(sound);
  const std::string stress = stress_bytes(sound);
  const std::vector<std::pair<std::string, std::string>> parts{
      {"seal", "fpm checkpoint"},
      {"superblock", "\x89HDF"},
      {"a group's header", "TREE"},
      {"a group's names", "HEAP"},
      {"a group's entries", "SNOD"},
      {"a dataset's data", stress},
      {"a dataset's name", "subpoint_deviator"},
      {"the unit of a dataset", "unit"},
      {"an attribute", "reason"},
      {"the archive", "serialization::archive"},
      {"the scene", "[[material]]"},
      {"the curve", "step,load_parameter"},
      {"what ParaView reads", "UnstructuredGrid"},
  };
  for (const auto& [part, pattern] : parts) {
    const std::size_t at = bytes.find(pattern);
    ASSERT_NE(at, std::string::npos) << part;
    for (const std::size_t offset : {std::size_t{0}, pattern.size() / 2, pattern.size() - 1}) {
      std::string changed = bytes;
      changed[at + offset] ^= '\x20';
      overwrite(damaged, changed);
      EXPECT_NE(refusal_of(damaged), "") << part;
    }
  }
  // The four bytes after a chunk are its checksum.
  const auto whole = files::Hdf5File::open(sound).read_all<double>("/state/particles/stress");
  const std::string_view data(reinterpret_cast<const char*>(whole.data()),
                              whole.size() * sizeof(double));
  const std::size_t checksum = bytes.find(data) + data.size();
  ASSERT_LT(checksum, bytes.size());
  std::string changed = bytes;
  changed[checksum] ^= '\x01';
  overwrite(damaged, changed);
  EXPECT_NE(refusal_of(damaged), "");
}

TEST_F(DamagedCheckpoint, IsRefusedWhicheverByteIsFlipped) {
  const auto damaged = run_ / "damaged.hdf";
  const std::string bytes = bytes_of_file(checkpoint_of(run_, 3));
  constexpr std::size_t places = 500;
  // A stride coprime to the alignment of HDF5, so that all kinds of bytes are met.
  const std::size_t stride = bytes.size() / places | 1U;
  for (std::size_t at = 0; at < bytes.size(); at += stride) {
    std::string changed = bytes;
    changed[at] ^= static_cast<char>(1U << (at % 8));
    overwrite(damaged, changed);
    EXPECT_NE(refusal_of(damaged), "") << "byte " << at;
  }
}

TEST_F(DamagedCheckpoint, CutAtAnyKilobyteIsRefused) {
  const auto damaged = run_ / "damaged.hdf";
  const std::string bytes = bytes_of_file(checkpoint_of(run_, 3));
  for (std::size_t size = 0; size < bytes.size(); size += 1024) {
    overwrite(damaged, bytes.substr(0, size));
    EXPECT_THAT(refusal_of(damaged),
                size > 512 ? HasSubstr("is cut or grown") : HasSubstr("beginning is lost"))
        << size << " bytes";
  }
  overwrite(damaged, bytes + '\0');
  EXPECT_THAT(refusal_of(damaged), HasSubstr("is cut or grown"));
}

// Each layer by itself: what a seal that is made anew would let through, the datasets' checksums
// and the digest of them all find.
TEST_F(DamagedCheckpoint, BehindASoundSealIsRefusedByItsDataset) {
  const auto file = checkpoint_of(run_, 3);
  damage(file, stress_bytes(file));
  files::write_seal(file, record::checkpoint_schema, "a seal that is sound");
  EXPECT_THAT(refusal_of(file), HasSubstr("/state/particles/stress cannot be read"));
}

TEST_F(DamagedCheckpoint, ThatLacksADatasetIsRefusedByItsDigest) {
  const auto file = checkpoint_of(run_, 3);
  damage(file, "subpoint_deviator");  // its name
  files::write_seal(file, record::checkpoint_schema, "a seal that is sound");
  EXPECT_THAT(refusal_of(file), HasSubstr("its datasets are not those it was written with"));
}

TEST_F(DamagedCheckpoint, WithoutItsSealIsRefused) {
  const auto file = checkpoint_of(run_, 3);
  overwrite(file, bytes_of_file(file).substr(files::seal_size));
  EXPECT_NE(refusal_of(file), "");
}

// The first schema had no seal: HDF5 and the digest alone stand for it. A byte that nothing covers
// is one that nothing is read from.
TEST(CheckpointOfTheFirstSchema, WithAFlippedByteIsRefusedOrIsWhatItWas) {
  const support::TemporaryFolder folder;
  const auto sound = std::filesystem::path(FPM_STORED_CHECKPOINTS) / "schema-1.hdf";
  const auto damaged = folder / "damaged.hdf";
  const std::string bytes = bytes_of_file(sound);
  constexpr std::size_t places = 200;
  int refused = 0;
  for (std::size_t i = 0; i < places; ++i) {
    std::string changed = bytes;
    changed[i * (bytes.size() / places | 1U) % bytes.size()] ^= '\x10';
    overwrite(damaged, changed);
    if (refusal_of(damaged).empty()) {
      EXPECT_THAT(differing_fields(damaged, sound), ::testing::IsEmpty());
    } else {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0);
}

// Found by the fuzzer: a group that is its own grandchild, and a header on which HDF5 1.10 reads
// beyond its memory. A process of its own bears what becomes of that; this one gets a reason.
TEST(UnsealedFile, OnWhichHdf5GoesAstrayIsRefused) {
  const std::filesystem::path folder = FPM_STORED_CHECKPOINTS;
  EXPECT_NE(refusal_of(folder / "groups-in-a-circle.hdf"), "");
  EXPECT_NE(refusal_of(folder / "header-beyond-its-end.hdf"), "");
}

// Whatever HDF5 does to its process, here the worst: a file that ends the one that reads it.
TEST(UnsealedFile, ThatEndsItsReaderIsRefused) {
  const support::TemporaryFolder folder;
  const auto file = folder / "frame.hdf";
  {
    files::Hdf5File made = files::Hdf5File::create(file);
    made.write_text("/a", "text");
    made.close();
  }
  EXPECT_EQ(files::open_unsealed(file).read_text("/a"), "text");
  EXPECT_EQ(files::open_unsealed(file).file(), file);
  std::string reason;
  try {
    (void)files::open_unsealed(file, [](const auto&, const auto&) { std::abort(); });
  } catch (const files::FileError& failure) {
    reason = failure.reason();
  }
  EXPECT_EQ(reason, "is damaged: HDF5 falls on it (Aborted)");
}

TEST_F(DamagedCheckpoint, FromAnotherProgramIsRefused) {
  const auto file = run_ / "other.hdf";
  files::Hdf5File::create(file).close();
  const std::string from = "--resume=" + file.string();
  EXPECT_THAT(fpm_run_in(run_, block, {from}).err, HasSubstr("is no checkpoint of this program"));
  overwrite(file, "step,load\n");
  EXPECT_THAT(fpm_run_in(run_, block, {from}).err, HasSubstr("is no checkpoint of this program"));
}

TEST(ContentDigest, DependsOnNamesAndEveryBitButNotOnTheOrder) {
  const std::string a = "twelve bytes", b = "twelve bytez";
  const auto digest = [](std::vector<std::pair<std::string, std::string>> datasets) {
    files::ContentDigest sum;
    for (const auto& [path, text] : datasets) sum.add(path, std::as_bytes(std::span(text)));
    return sum.value();
  };
  EXPECT_EQ(digest({{"/a", a}, {"/b", b}}), digest({{"/b", b}, {"/a", a}}));
  EXPECT_NE(digest({{"/a", a}, {"/b", b}}), digest({{"/a", b}, {"/b", a}}));
  EXPECT_NE(digest({{"/a", a}}), digest({{"/a", b}}));
  EXPECT_NE(digest({{"/a", a}}), digest({{"/a", a + '\0'}}));
  EXPECT_NE(digest({{"/a", a}}), digest({{"/a", a}, {"/b", ""}}));
}

}  // namespace
}  // namespace restart
