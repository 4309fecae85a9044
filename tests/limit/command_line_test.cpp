#include "limit/command_line.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "files/hdf5_file.hpp"
#include "support/temporary_folder.hpp"

namespace {

using program::ExitCode;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

struct Outcome {
  ExitCode code;
  std::string out, err;
};

Outcome run(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const ExitCode code = limit::fpm_limit(arguments, out, err);
  return {code, out.str(), err.str()};
}

TEST(FpmLimit, RefusesWhatItCannotBracketWithTheReason) {
  for (const auto& [arguments, reason] :
       std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{}, "SCENE or --strip is missing"},
           {{"--strip"}, "neither cohesion nor friction"},
           {{"--strip", "--phi", "30"}, "the soil bears nothing"},
           {{"--strip", "--c", "-1"}, "cohesion: found -1; allowed is at least 0"},
           {{"--strip", "--c", "1", "--phi", "60"},
            "friction_angle: found 60; allowed is 0 .. 50 [deg]"},
           {{"--strip", "--c", "1", "--half-width", "0"}, "half_width: found 0"},
           {{"--strip", "--c", "nan"}, "cohesion"},
           {{"--strip", "--c", "1", "--rough", "--smooth"}, "exclude each other"},
           {{FPM_SHARE_DIR "/scenes/limit/inclined.toml", "--no-tension"}, "the key tension"},
           {{"--strip", "--c", "1", "--gap", "0%"}, "--gap: found 0%"},
           {{"--strip", "--c", "1", "--gap", "2x"}, "--gap: found 2x"},
           {{"--strip", "--c", "1", "--phi", "20", "--psi", "30"}, "--psi: found 30"},
           {{"--strip", "--c", "1", "--box-width", "1"}, "box: found 1"},
           {{"--strip", "--c", "1", "--box-depth", "inf"}, "box: found"},
           {{"--strip", "--c", "1", "--surchage", "1"}, "did you mean \"--surcharge\""},
           {{"--strip", "--c", "1", "--solver", "mosek"}, "--solver: found mosek"},
           {{"--strip", "--c", "1", "--units", "psf"}, "--units: found psf"},
           {{FPM_SHARE_DIR "/scenes/footing.toml", "--units", "kPa,m"}, "exclude each other"},
           {{"--strip", "--c", "1", "--max-triangles", "0"}, "--max-triangles: found 0"}}) {
    const Outcome refused = run(arguments);
    EXPECT_EQ(refused.code, ExitCode::input_refused) << reason;
    EXPECT_THAT(refused.err, HasSubstr(reason));
    EXPECT_EQ(refused.out, "");
  }
}

// Nothing is converted: what is named is printed, and no other unit is.
void expect_pounds_and_feet(const std::vector<std::string>& arguments,
                            const std::filesystem::path& file) {
  const Outcome done = run(arguments);
  EXPECT_THAT(done.out, AllOf(HasSubstr(" psf"), HasSubstr(" psf/ft")));
  std::stringstream json;
  json << std::ifstream(file).rdbuf();
  EXPECT_EQ(nlohmann::json::parse(json.str())["unit"], "psf");
  for (const std::string& text : {done.out, json.str()}) {
    EXPECT_THAT(text, Not(AnyOf(HasSubstr(" Pa"), HasSubstr("_Pa"), HasSubstr("N/m3")))) << text;
  }
}

TEST(FpmLimit, PrintsTheUnitsThatAreNamed) {
  const support::TemporaryFolder folder;
  const auto file = folder.path() / "limit.json";
  expect_pounds_and_feet({"--strip", "--c", "200", "--gamma", "110", "--half-width", "4", "--gap",
                          "20%", "--units", "psf,ft", "--json", file.string()},
                         file);
}

// Whatever a scene lacks is the user's matter, with file, line and key; what an invalid argument
// anywhere else says is ours.
TEST(FpmLimit, RefusesAScenesFootingByFileLineAndKey) {
  const Outcome refused =
      run({FPM_SHARE_DIR "/scenes/footing.toml", "--set", "material.0.match=compression_cone"});
  EXPECT_EQ(refused.code, ExitCode::input_refused);
  EXPECT_THAT(refused.err,
              AllOf(HasSubstr("--set material.0.match=compression_cone: material.0.match"),
                    HasSubstr("matched in plane strain")));
}

TEST(FpmLimit, CallsABugABug) {
  // A stream that fails as a fault of ours would: nothing of what the user wrote.
  struct Faulty : std::stringbuf {
    int_type overflow(int_type) override { throw std::invalid_argument("a fault of ours"); }
    std::streamsize xsputn(const char*, std::streamsize) override {
      throw std::invalid_argument("a fault of ours");
    }
  };
  Faulty faulty;
  std::ostream out(&faulty);
  out.exceptions(std::ios::badbit);
  std::ostringstream err;
  EXPECT_EQ(limit::fpm_limit(std::vector<std::string>{"--version"}, out, err), ExitCode::bug);
  EXPECT_THAT(err.str(), AllOf(HasSubstr("a fault of ours"), HasSubstr("This is a bug")));
}

TEST(FpmLimit, PrintsBoundsThatAreWiderThanAskedAndSaysSo) {
  const auto file = std::filesystem::temp_directory_path() / "fpm_limit_cli_test.json";
  const Outcome wide = run({"--strip", "--c", "1e3", "--phi", "10", "--psi", "0", "--max-triangles",
                            "1", "--gap", "0.1%", "--json", file.string()});
  EXPECT_EQ(wide.code, ExitCode::not_converged);
  EXPECT_THAT(wide.out, AllOf(HasSubstr("lower bound"), HasSubstr("upper bound"),
                              HasSubstr("wider than the gap asked for"), HasSubstr("Terzaghi"),
                              HasSubstr("not rigorous"), HasSubstr("cone form, solved")));
  std::ifstream stream(file);
  const auto json = nlohmann::json::parse(stream);
  std::filesystem::remove(file);
  // N_c = 8.344926 at 10 degrees.
  EXPECT_LT(json["lower_bound"].get<double>(), 8344.926);
  EXPECT_GT(json["upper_bound"].get<double>(), 8344.926);
  EXPECT_EQ(json["status"], "wider than asked");
  EXPECT_EQ(json["certified"], true);
  EXPECT_EQ(json["davis_reduced"]["rigorous"], false);
  EXPECT_LT(json["davis_reduced"]["upper_bound"].get<double>(), json["upper_bound"].get<double>());
  EXPECT_EQ(json["attempts"].size(), 2U);
}

TEST(FpmLimit, EndsWellOnceTheGapIsReached) {
  const Outcome reached = run({"--strip", "--c", "1", "--gap", "10%", "--smooth"});
  EXPECT_EQ(reached.code, ExitCode::done);
  EXPECT_THAT(reached.out, HasSubstr("smooth base: no shear stress; bonded"));
  const Outcome lifting = run({"--strip", "--c", "1", "--gap", "10%", "--no-tension"});
  EXPECT_EQ(lifting.code, ExitCode::done);
  EXPECT_THAT(lifting.out, HasSubstr("no tension, the footing may lift off"));
}

TEST(FpmLimit, WritesFieldsInTheUnitsOfItsNumbers) {
  const support::TemporaryFolder folder;
  const std::string prefix = (folder.path() / "strip").string();
  const Outcome done = run({"--strip", "--c", "250", "--units", "psf,ft", "--gap", "50%",
                            "--max-triangles", "1", "--fields", prefix});
  ASSERT_EQ(done.code, ExitCode::done) << done.err;
  const files::Hdf5File lower = files::Hdf5File::open(prefix + "-lower.hdf");
  EXPECT_EQ(lower.info("/VTKHDF/PointData/stress").unit, "psf");
  EXPECT_EQ(lower.info("/VTKHDF/PointData/principal_stresses").unit, "psf");
  EXPECT_EQ(lower.info("/VTKHDF/PointData/utilisation").unit, "");
  const files::Hdf5File upper = files::Hdf5File::open(prefix + "-upper.hdf");
  EXPECT_EQ(upper.info("/VTKHDF/CellData/dissipation").unit, "psf/ft");
}

// Half the difference of its principal stresses over strength; of clay c, and where the factor of
// the strength is sought of that divided by it: 1 where it flows, and nowhere more.
TEST(FpmLimit, ShowsHowMuchOfItsStrengthTheSoilUses) {
  const support::TemporaryFolder folder;
  const std::string prefix = (folder.path() / "used").string();
  const auto used_of = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {"--gap", "20%", "--max-triangles", "100", "--fields", prefix});
    const Outcome done = run(all);
    EXPECT_EQ(done.code, ExitCode::done) << done.err;
    return files::Hdf5File::open(prefix + "-lower.hdf");
  };
  constexpr double cohesion = 250.0, round_off = 1e-12;
  const files::Hdf5File clay = used_of({"--strip", "--c", "250"});
  const auto used = clay.read_all<double>("/VTKHDF/PointData/utilisation");
  const auto principal = clay.read_all<double>("/VTKHDF/PointData/principal_stresses");
  ASSERT_EQ(principal.size(), 3 * used.size());
  for (std::size_t k = 0; k < used.size(); ++k) {
    EXPECT_NEAR(used[k], (principal[3 * k] - principal[3 * k + 1]) / (2.0 * cohesion), round_off);
  }
  const files::Hdf5File slope =
      used_of({std::string(FPM_SHARE_DIR) + "/scenes/limit/slope_safety.toml"});
  const double most = std::ranges::max(slope.read_all<double>("/VTKHDF/PointData/utilisation"));
  EXPECT_LE(most, 1.0 + round_off);
  EXPECT_GT(most, 0.999);
}

}  // namespace
