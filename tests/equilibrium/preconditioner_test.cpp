// The two-level preconditioner: symmetric, positive definite, and as good on fine lattices as on
// coarse ones.
#include "equilibrium/two_level_preconditioner.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "equilibrium/equilibrium.hpp"
#include "model/build.hpp"
#include "scene/reader.hpp"
#include "verification/bodies.hpp"

namespace {

using verification::Noise;

// An elastic block on a fixed base, one metre wide.
std::string block(int dimension, int cells, const std::string& more = {}) {
  const bool plane = dimension == 2;
  return "[geometry]\ndimension = " + std::to_string(dimension) +
         (plane ? "\nmin = [0.0, 0.0]\nmax = [1.0, 1.0]"
                : "\nmin = [0.0, 0.0, 0.0]\nmax = [1.0, 1.0, 1.0]") +
         "\nspacing = " + std::to_string(1.0 / cells) +
         "\n[approximation]\nkinematics = \"small_strain\"\n[hourglass]\ncontrol = \"stiffness\"\n"
         "[[material]]\nname = \"soil\"\nmodel = \"elastic\"\nyoungs_modulus = 1e6\n"
         "poissons_ratio = 0.3\n[[support]]\nname = \"base\"\nside = \"bottom\"\ndirections = " +
         (plane ? "[\"x\", \"y\"]\n" : "[\"x\", \"y\", \"z\"]\n") + more;
}

template <int Dim>
struct Elastic {
  Elastic(const std::string& text, double coarse_over_spacing)
      : scene(scene::parse_scene(text, "block", {}).scene),
        model(model::build_model<Dim>(*scene)),
        state(model::initial_state(model)),
        equilibrium(model, state),
        preconditioner(model, *equilibrium.initial_rows(), coarse_over_spacing) {
    equilibrium.begin_step(0.0);
    if (!equilibrium.linearise(Eigen::VectorXd::Zero(model.unknowns()))) {
      throw std::runtime_error("not linearised");
    }
  }
  Eigen::VectorXd precondition(const Eigen::VectorXd& r) {
    Eigen::VectorXd z(r.size());
    preconditioner.apply(r, z);
    return z;
  }
  Eigen::VectorXd stiffness(const Eigen::VectorXd& v) {
    Eigen::VectorXd jv(v.size());
    equilibrium.apply_jacobian(v, jv);
    return jv;
  }
  void mask(Eigen::VectorXd& v) const {
    for (Eigen::Index k = 0; k < v.size(); ++k) {
      if (model.prescribed[static_cast<std::size_t>(k)] != 0) v[k] = 0.0;
    }
  }

  std::shared_ptr<const scene::Scene> scene;
  model::Model<Dim> model;
  model::State<Dim> state;
  equilibrium::Equilibrium<Dim> equilibrium;
  equilibrium::TwoLevelPreconditioner<Dim> preconditioner;
};

// z = M r over the free unknowns, column by column.
template <int Dim>
Eigen::MatrixXd free_matrix(Elastic<Dim>& body) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < body.model.unknowns(); ++k) {
    if (body.model.prescribed[static_cast<std::size_t>(k)] == 0) free.push_back(k);
  }
  Eigen::MatrixXd m(static_cast<Eigen::Index>(free.size()), static_cast<Eigen::Index>(free.size()));
  for (std::size_t j = 0; j < free.size(); ++j) {
    const Eigen::VectorXd z =
        body.precondition(Eigen::VectorXd::Unit(body.model.unknowns(), free[j]));
    m.col(static_cast<Eigen::Index>(j)) = z(free);
  }
  return m;
}

// The grid's factor is of single precision: its solves are exact for a matrix a few roundings away,
// so they differ from symmetric ones by those times the condition number, relative to the largest.
template <int Dim>
void expect_symmetric_positive_definite(const std::string& text, double coarse) {
  Elastic<Dim> body(text, coarse);
  const Eigen::MatrixXd m = free_matrix(body);
  const Eigen::VectorXd eigenvalues =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(0.5 * (m + m.transpose())).eigenvalues();
  const double smallest = eigenvalues[0], largest = eigenvalues[eigenvalues.size() - 1];
  ASSERT_GT(smallest, 0.0);
  const double single = std::numeric_limits<float>::epsilon() * largest / smallest;
  EXPECT_LT(single, 0.01) << "too ill conditioned to say";
  EXPECT_LT((m - m.transpose()).cwiseAbs().maxCoeff(), single * largest);
}

TEST(TwoLevelPreconditioner, IsSymmetricAndPositiveDefinite) {
  const std::string penalty =
      "[[support]]\nname=\"left\"\nside=\"left\"\ndirections=[\"x\"]\nmethod=\"penalty\"\n";
  for (const double coarse : {0.0, 3.0}) {
    SCOPED_TRACE(coarse);
    expect_symmetric_positive_definite<2>(block(2, 8), coarse);
    expect_symmetric_positive_definite<2>(block(2, 8, penalty), coarse);
    expect_symmetric_positive_definite<3>(block(3, 5), coarse);
  }
}

TEST(TwoLevelPreconditioner, LeavesPrescribedUnknownsAlone) {
  Elastic<2> body(block(2, 8), 3.0);
  Noise noise(5);
  const Eigen::VectorXd z = body.precondition(noise.vector(body.model.unknowns(), 1.0));
  for (Eigen::Index k = 0; k < z.size(); ++k) {
    const bool given = body.model.prescribed[static_cast<std::size_t>(k)] != 0;
    EXPECT_EQ(z[k] == 0.0, given);
  }
}

// Soft below and a thousand times stiffer above, told either way round: what holds the body on the
// grid is as stiff as what it holds, not as the material that comes first.
TEST(TwoLevelPreconditioner, DoesNotDependOnTheOrderOfTheMaterials) {
  const auto layered = [](const std::string& first, const std::string& second, const char* from,
                          const char* to) {
    std::string text =
        block(2, 10,
              "[[symmetry]]\naxis = \"x\"\nposition = 0.0\n[[support]]\nname = \"springs\"\n"
              "side = \"right\"\ndirections = [\"x\"]\nmethod = \"penalty\"\n"
              "[[material]]\nname = \"other\"\nmodel = \"elastic\"\npoissons_ratio = 0.3\n"
              "youngs_modulus = " +
                  second + "\nregion_min = [0.0, " + from + "]\nregion_max = [1.0, " + to + "]\n");
    const std::string soil = "youngs_modulus = 1e6";
    return text.replace(text.find(soil), soil.size(), "youngs_modulus = " + first);
  };
  Elastic<2> soft_first(layered("1e6", "1e9", "0.5", "1.0"), 3.0);
  Elastic<2> stiff_first(layered("1e9", "1e6", "0.0", "0.5"), 3.0);
  Noise noise(7);
  Eigen::VectorXd r = noise.vector(soft_first.model.unknowns(), 1.0);
  EXPECT_EQ(soft_first.precondition(r), stiff_first.precondition(r));
}

struct Course {
  int iterations = 0;
  double condition = 0.0;  // of M J, from the Lanczos process that conjugate gradients are
};

// Conjugate gradients from a random error until it has shrunk by `reduction` in energy.
template <int Dim>
Course conjugate_gradients(Elastic<Dim>& body, double reduction) {
  Noise noise(11);
  Eigen::VectorXd error = noise.vector(body.model.unknowns(), 1.0);
  body.mask(error);
  Eigen::VectorXd r = body.stiffness(error);
  const double begin = error.dot(r);
  Eigen::VectorXd z = body.precondition(r), p = z;
  double rz = r.dot(z);
  std::vector<double> alpha, beta;
  while (error.dot(body.stiffness(error)) > reduction * reduction * begin) {
    const Eigen::VectorXd jp = body.stiffness(p);
    alpha.push_back(rz / p.dot(jp));
    error -= alpha.back() * p;
    r -= alpha.back() * jp;
    z = body.precondition(r);
    const double next = r.dot(z);
    beta.push_back(next / rz);
    rz = next;
    p = z + beta.back() * p;
    if (alpha.size() > 2000) throw std::runtime_error("no convergence");
  }
  const auto count = static_cast<Eigen::Index>(alpha.size());
  Eigen::MatrixXd t = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto i = static_cast<std::size_t>(k);
    t(k, k) = 1.0 / alpha[i] + (k > 0 ? beta[i - 1] / alpha[i - 1] : 0.0);
    if (k > 0) t(k, k - 1) = t(k - 1, k) = std::sqrt(beta[i - 1]) / alpha[i - 1];
  }
  const Eigen::VectorXd ritz = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(t).eigenvalues();
  return {static_cast<int>(count), ritz[count - 1] / ritz[0]};
}

// Additive two-level methods have a condition number of M J that the ratio of the two spacings
// bounds, whatever the spacing (Dryja & Widlund 1994; overlap and quadrature are constants), and
// the diagonal blocks alone one that grows as the number of particles across, squared: halving the
// spacing multiplies it by 4. Twice, half-way on the scale of factors, tells the two apart. The
// bound on iterations follows from the condition number.
TEST(TwoLevelPreconditioner, IsAsGoodOnFineLatticesAsOnCoarseOnes) {
  constexpr double reduction = 1e-6, halfway = 2.0;
  std::vector<Course> two_level, blocks;
  for (const int cells : {10, 20, 40}) {
    Elastic<2> with(block(2, cells), 3.0);
    two_level.push_back(conjugate_gradients(with, reduction));
    Elastic<2> without(block(2, cells), 0.0);
    blocks.push_back(conjugate_gradients(without, reduction));
    const auto label = "_at_" + std::to_string(cells);
    RecordProperty("condition" + label, std::to_string(two_level.back().condition));
    RecordProperty("iterations" + label, two_level.back().iterations);
    RecordProperty("blocks_condition" + label, std::to_string(blocks.back().condition));
    RecordProperty("blocks_iterations" + label, blocks.back().iterations);
  }
  for (std::size_t k = 1; k < two_level.size(); ++k) {
    EXPECT_LT(two_level[k].condition, halfway * two_level[k - 1].condition);
    EXPECT_GT(blocks[k].condition, halfway * blocks[k - 1].condition);
  }
  const double condition = halfway * two_level.front().condition;
  const double bound = std::ceil(0.5 * std::sqrt(condition) * std::log(2.0 / reduction));
  for (const Course& course : two_level) EXPECT_LE(course.iterations, bound);
  EXPECT_GT(blocks.back().iterations, bound);
}

}  // namespace
