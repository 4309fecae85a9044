#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "equilibrium/equilibrium.hpp"
#include "support/box_mesh.hpp"

namespace verification {

/// A small free body of one material; nothing is supported or driven, so a test may move every
/// particle as it likes.
struct BodyOptions {
  int dimension = 2;
  std::string layout = "cell";
  double jitter = 0.0;
  std::string kinematics = "finite_strain";
  std::string control = "mixed";
  std::string model = "drucker_prager";
  std::string consistency = "off";
  bool elements = false;  // triangles or tetrahedra of a mesh, whose nodes are moved by the jitter
  std::string hourglass;  // further keys of [hourglass]
  std::string extra;      // further tables
};

inline std::string geometry_of(const BodyOptions& o) {
  const bool plane = o.dimension == 2;
  const std::string dimension = "[geometry]\ndimension = " + std::to_string(o.dimension);
  if (!o.elements) {
    return dimension +
           (plane ? "\nmin = [0.0, 0.0]\nmax = [1.1, 0.9]\nspacing = 0.1\n"
                  : "\nmin = [0.0, 0.0, 0.0]\nmax = [0.7, 0.6, 0.5]\nspacing = 0.1\n") +
           "layout = \"" + o.layout + "\"\njitter = " + std::to_string(o.jitter) + "\n";
  }
  using Kind = support::BoxMesh::Kind;
  const support::BoxMesh mesh{.kind = plane ? Kind::triangles : Kind::tetrahedra,
                              .cells = plane ? std::array{9, 7, 0} : std::array{4, 4, 3},
                              .size = plane ? std::array{1.1, 0.9, 1.0} : std::array{0.7, 0.6, 0.5},
                              .jitter = o.jitter};
  std::string text =
      dimension + "\n[mesh]\nparticles = \"elements\"\ntext = '''\n" + text_of(mesh) + "'''\n";
  for (const char* group : {"low", "high"}) {
    text += std::string("[[region]]\nmaterial = \"soil\"\ngroup = \"") + group + "\"\n";
  }
  for (const char* group : {"x0", "x1", "y0", "y1", "z0", "z1"}) {
    if (plane && group[0] == 'z') continue;
    text += std::string("[[side]]\nkind = \"free\"\nname = \"") + group + "\"\ngroup = \"" + group +
            "\"\n";
  }
  return text;
}

inline std::string body_scene(const BodyOptions& o) {
  const bool plane = o.dimension == 2;
  std::string text = geometry_of(o) + "[approximation]\nkinematics = \"" + o.kinematics +
                     "\"\nconsistency = \"" + o.consistency + "\"\n[hourglass]\ncontrol = \"" +
                     o.control + "\"\n" + o.hourglass +
                     "[[material]]\nname = \"soil\"\nmodel = \"" + o.model +
                     "\"\nyoungs_modulus = 1e6\npoissons_ratio = 0.3\n";
  if (o.model != "elastic") text += "cohesion = 5e3\n";
  if (o.model == "drucker_prager" || o.model == "mohr_coulomb") {
    text += "friction_angle = 20\ndilation_angle = 10\n";
    if (!plane && o.model == "drucker_prager") text += "match = \"compression_cone\"\n";
  }
  return text + o.extra;
}

/// Numbers in [-1, 1], the same on every machine.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : state_(seed) {}
  double operator()() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 11U) * 0x1.0p-52 - 1.0;
  }
  Eigen::VectorXd vector(Eigen::Index n, double size) {
    Eigen::VectorXd v(n);
    for (auto& x : v) x = size * (*this)();
    return v;
  }

 private:
  std::uint64_t state_;
};

/// An increment field du(x) of the current configuration as a vector of unknowns.
template <int Dim, class Motion>
Eigen::VectorXd increment_field(const model::Model<Dim>& model, const model::State<Dim>& state,
                                Motion&& motion) {
  Eigen::VectorXd u(model.unknowns());
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    const fpm::Vector<Dim> x =
        (model.particles.position.row(a) + state.displacement.row(a)).transpose();
    const fpm::Vector<Dim> du = motion(x);
    for (int i = 0; i < Dim; ++i) u[i * model.size() + a] = du[i];
  }
  return u;
}

/// Evaluates and commits one increment without solving.
template <int Dim>
void move(equilibrium::Equilibrium<Dim>& equilibrium, const Eigen::VectorXd& increment) {
  equilibrium.begin_step(0.0);
  Eigen::VectorXd residual(increment.size());
  if (equilibrium(increment, residual) != jfnk::Evaluation::ok) {
    throw std::runtime_error("this motion cannot be evaluated");
  }
  equilibrium.commit(increment);
}

/// A smooth motion that bends, shears and compresses the body.
template <int Dim>
fpm::Vector<Dim> bending(const fpm::Vector<Dim>& x, double size) {
  fpm::Vector<Dim> u = fpm::Vector<Dim>::Zero();
  u[0] = size * (0.5 * x[0] + 0.3 * x[1] - x[0] * x[1]);
  u[1] = size * (0.5 * x[0] * x[0] - 0.8 * x[1] + 0.2 * x[0] * x[1]);
  if constexpr (Dim == 3) u[2] = size * (0.3 * x[2] * x[0] - 0.2 * x[1]);
  return u;
}

}  // namespace verification
