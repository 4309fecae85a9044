#include "restart.hpp"

#include <cstring>
#include <fstream>
#include <set>
#include <sstream>

#include "files/hdf5_file.hpp"
#include "record/checkpoint_folder.hpp"
#include "record/checkpoint_name.hpp"
#include "record/curve_file.hpp"
#include "run/command_line.hpp"
#include "run/run_loop.hpp"
#include "support/box_mesh.hpp"
#include "support/small_footing.hpp"

namespace restart {

const std::string footing = "title = \"small footing\"" + support::small_footing + R"([re_search]
enabled = true
trigger = 0.02
[output]
frames_every = 4
checkpoints_every = 1
checkpoints_kept = 100
)";

const std::string staged = footing + R"([[stage]]
name = "there"
to = 0.1
steps = 10
[[stage]]
name = "back"
to = 0.08
steps = 5
[[stage]]
name = "on"
to = 0.15
steps = 9
)";

const std::string layered = footing + R"([[material]]
name = "firm"
model = "drucker_prager"
youngs_modulus = 4e6
poissons_ratio = 0.3
cohesion = 4e3
friction_angle = 25.0
dilation_angle = 5.0
density = 1800.0
region_min = [-1.0, -3.0]
region_max = [4.0, -1.0]
[[interface]]
between = ["soil", "firm"]
)";

const std::string loaded_plate = [] {
  std::string text = footing;
  const auto swap = [&](const std::string& what, const std::string& instead) {
    text.replace(text.find(what), what.size(), instead);
  };
  swap("[[symmetry]]\naxis = \"x\"\nposition = 0.0\n",
       "[[support]]\nname = \"near side\"\nside = \"left\"\ndirections = [\"x\"]\n");
  swap("kind = \"displacement\"\n",
       "kind = \"load\"\nscales = [\"plate\"]\nmethod = \"contact\"\nlateral = \"free\"\n"
       "friction_angle = 15.0\nat = 1.7\nforce = [500.0, -5e3]\n");
  swap("range_min = 0.0\nrange_max = 1.0\ndirection = [0.0, -1.0]\ntarget = 0.15\n",
       "range_min = 1.0\nrange_max = 2.0\n");
  swap("width = 1.0\n", "");
  return text;
}();

const std::string staged_load = loaded_plate + R"([[stage]]
name = "there"
to = 0.6
steps = 10
[[stage]]
name = "back"
to = 0.3
steps = 5
[[stage]]
name = "on"
to = 0.8
steps = 6
)";

namespace {

std::string of_elements(const support::BoxMesh& mesh) {
  return "[mesh]\nparticles = \"elements\"\ntext = '''\n" + text_of(mesh) + R"('''
[[material]]
name = "soil"
model = "drucker_prager"
youngs_modulus = 1e6
poissons_ratio = 0.3
cohesion = 8e3
friction_angle = 20.0
dilation_angle = 5.0
density = 1800.0
match = "MATCH"
[[region]]
material = "soil"
group = "low"
[[region]]
material = "soil"
group = "high"
)";
}

std::string with_match(std::string text, const std::string& match) {
  const std::string given = "MATCH";
  return text.replace(text.find(given), given.size(), match);
}

std::string side(const std::string& name, const std::string& kind) {
  return "[[side]]\nname = \"" + name + "\"\ngroup = \"" + name + "\"\nkind = \"" + kind + "\"\n";
}

}  // namespace

const std::string triangles = "[geometry]\ndimension = 2\n" +
                              with_match(of_elements({.kind = support::BoxMesh::Kind::triangles,
                                                      .cells = {8, 6, 0},
                                                      .size = {2.0, 1.5, 1.0},
                                                      .jitter = 0.2}),
                                         "plane_strain") +
                              side("x0", "symmetry") + side("x1", "roller") + side("y0", "fixed") +
                              R"(
[[side]]
name = "surface"
kind = "free"
along = [[0.5, 1.5], [2.0, 1.5]]
[[side]]
name = "strip"
kind = "footing"
along = [[0.0, 1.5], [0.5, 1.5]]
[drive]
kind = "displacement"
target = 0.3
[programme]
steps = 20
[re_search]
enabled = true
[output]
checkpoints_every = 1
checkpoints_kept = 1000
)";

const std::string tetrahedra = "[geometry]\ndimension = 3\n" +
                               with_match(of_elements({.kind = support::BoxMesh::Kind::tetrahedra,
                                                       .cells = {2, 4, 2},
                                                       .size = {0.5, 1.0, 0.5},
                                                       .jitter = 0.2}),
                                          "compression_cone") +
                               side("x0", "symmetry") + side("x1", "free") + side("y0", "fixed") +
                               side("y1", "free") + side("z0", "symmetry") + side("z1", "free") +
                               R"(
[gravity]
acceleration = [0.0, -9.81, 0.0]
[drive]
kind = "load"
scales = ["gravity"]
[programme]
steps = 6
[output]
checkpoints_every = 1
checkpoints_kept = 1000
)";

const std::string tunnel = R"(
title = "small tunnel in a slope"
[geometry]
dimension = 2
min = [0.0, 0.0]
max = [3.0, 2.0]
spacing = 0.25
[[cutout]]
name = "tunnel"
centre = [1.0, 0.8]
radius = 0.4
kind = "roller"
[[cutout]]
name = "air"
outline = [[2.0, 2.5], [2.2, 1.0], [3.5, 0.6], [3.5, 2.5]]
pressure = 500
[[material]]
name = "soil"
model = "drucker_prager"
youngs_modulus = 1e6
poissons_ratio = 0.3
cohesion = 8e3
friction_angle = 20.0
dilation_angle = 5.0
density = 1800.0
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
[gravity]
acceleration = [0.0, -9.81]
[drive]
kind = "load"
scales = ["gravity", "traction"]
[programme]
steps = 8
[output]
frames_every = 0
checkpoints_every = 1
checkpoints_kept = 100
)";

const std::string layered_slope = R"(
title = "small footing on a layered slope at rest"
[geometry]
spacing = 0.25
[grading]
enabled = true
growth = 0.5
[[material]]
name = "soil"
model = "drucker_prager"
youngs_modulus = 1e6
poissons_ratio = 0.3
cohesion = 8e3
friction_angle = 20.0
dilation_angle = 5.0
unit_weight = 18e3
[[material]]
name = "firm"
model = "drucker_prager"
youngs_modulus = 3e6
poissons_ratio = 0.3
cohesion = 15e3
friction_angle = 25.0
dilation_angle = 0.0
unit_weight = 19e3
[[region]]
material = "firm"
outline = [[0, 0], [4, 0], [4, 0.8], [0, 1.3]]
[[region]]
material = "soil"
outline = [[0, 1.3], [4, 0.8], [4, 1.2], [2, 2], [0, 2]]
[[side]]
name = "left"
kind = "symmetry"
along = [[0, 2], [0, 0]]
[[side]]
name = "rigid"
kind = "fixed"
along = [[0, 0], [4, 0], [4, 1.2]]
[[side]]
name = "slope"
kind = "loaded"
pressure = 500
along = [[4, 1.2], [2, 2]]
[[side]]
name = "level"
kind = "free"
along = [[2, 2], [1, 2]]
[[side]]
name = "strip"
kind = "footing"
along = [[0, 2], [1, 2]]
[initial_stress]
kind = "gravity"
[drive]
kind = "displacement"
target = 0.1
[re_search]
enabled = true
trigger = 0.02
[output]
frames_every = 0
checkpoints_every = 1
checkpoints_kept = 100
)";

const std::string block = R"(
title = "small block"
[geometry]
dimension = 3
min = [0.0, 0.0, 0.0]
max = [1.0, 1.5, 1.0]
spacing = 0.25
layout = "vertex"
[[material]]
name = "block"
model = "elastic"
youngs_modulus = 1e6
poissons_ratio = 0.3
density = 2000.0
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y", "z"]
[gravity]
acceleration = [0.0, -9.81, 0.0]
[drive]
kind = "load"
scales = ["gravity"]
[programme]
steps = 6
[output]
frames_every = 0
checkpoints_every = 1
checkpoints_kept = 100
)";

Outcome fpm_run_in(const std::filesystem::path& folder, const std::string& scene,
                   const std::vector<std::string>& arguments, const files::SystemCalls& system) {
  std::filesystem::path file = folder;
  file += ".toml";
  std::ofstream(file) << scene;
  std::vector<std::string> all{file.string(), "--out", folder.string()};
  all.insert(all.end(), arguments.begin(), arguments.end());
  std::ostringstream out, err;
  const auto run = [&](const run::RunRequest& request) {
    return run::run_programme(request, out, err, system);
  };
  const program::ExitCode code = run::fpm_run(all, out, err, run);
  return {code, out.str(), err.str()};
}

std::filesystem::path last_checkpoint(const std::filesystem::path& folder) {
  const auto all = record::list_checkpoints(folder / "checkpoints");
  return all.empty() ? std::filesystem::path() : all.front();
}

std::filesystem::path checkpoint_of(const std::filesystem::path& folder, int step) {
  return folder / "checkpoints" / record::checkpoint_name(step);
}

namespace {

void collect(const files::Hdf5File& file, const std::string& group,
             std::set<std::string>& datasets) {
  for (const std::string& name : file.list(group)) {
    const std::string path = group + "/" + name;
    if (file.is_group(path)) {
      collect(file, path, datasets);
    } else {
      datasets.insert(path);
    }
  }
}

template <class T>
std::string bits(const files::Hdf5File& file, const std::string& path) {
  const std::vector<T> values = file.read_all<T>(path);
  std::string bytes(values.size() * sizeof(T), '\0');
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::string content(const files::Hdf5File& file, const std::string& path) {
  if (!file.has(path)) return "absent";
  const std::string type = file.info(path).type;
  if (type == "float64") return type + bits<double>(file, path);
  if (type == "float32") return type + bits<float>(file, path);
  if (type == "int64") return type + bits<std::int64_t>(file, path);
  if (type == "int32") return type + bits<std::int32_t>(file, path);
  throw std::runtime_error(path + " has type " + type);
}

}  // namespace

std::vector<std::string> differing_fields(const std::filesystem::path& a,
                                          const std::filesystem::path& b) {
  const files::Hdf5File first = files::Hdf5File::open(a);
  const files::Hdf5File second = files::Hdf5File::open(b);
  std::set<std::string> datasets;
  collect(first, "/state", datasets);
  collect(second, "/state", datasets);
  std::vector<std::string> different;
  for (const std::string& path : datasets) {
    if (content(first, path) != content(second, path)) different.push_back(path);
  }
  if (datasets.empty()) different.emplace_back("there is no state");
  return different;
}

std::vector<std::string> curve_without_wall(const std::filesystem::path& folder) {
  std::ifstream file(folder / "curve.csv");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    lines.push_back(line.substr(0, line.rfind(',')));
  }
  return lines;
}

double column_sum_after(const std::filesystem::path& folder, const std::string& column, int step) {
  double sum = 0.0;
  for (const record::CurveRow& row : record::read_curve(folder / "curve.csv")) {
    if (row.step <= step) continue;
    record::CurveRow::for_each_column(row,
                                      [&](std::string_view name, const auto& value, auto&&...) {
                                        if (name == column) sum += static_cast<double>(value);
                                      });
  }
  return sum;
}

std::string bytes_of_file(const std::filesystem::path& file) {
  std::ostringstream bytes;
  bytes << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

}  // namespace restart
