// The Bratu problem, -Laplace(u) = lambda exp(u) on the unit square, on the processes of MPI.
//
//   jfnk_petsc_bratu                      one process, 32 x 32 unknowns, lambda = 6
//   mpirun -n 2 jfnk_petsc_bratu 128 6.8  two processes with 64 rows of 128 unknowns each
//
// The vectors are PETSc's, which also fetches the values beyond the edge of each process's rows and
// factorises the Laplacian (by MUMPS) for a preconditioner. libjfnk sees the local parts and an
// inner product that sums over all processes.
//
// On more than one process each solve is repeated on each process alone, and the iterates are
// compared: they may differ by what the order of a sum does to its rounding, and by no more.
#include <petscdmda.h>
#include <petscksp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "jfnk/jfnk.hpp"
#include "petsc_vector.hpp"

namespace {

using Grid = petsc::Owned<DM, DMDestroy>;

/// m x m interior nodes in strips of whole rows, so that their order does not depend on the number
/// of processes.
Grid strips(MPI_Comm processes, int m) {
  Grid grid;
  petsc::check(DMDACreate2d(processes, DM_BOUNDARY_NONE, DM_BOUNDARY_NONE, DMDA_STENCIL_STAR, m, m,
                            1, PETSC_DECIDE, 1, 1, nullptr, nullptr, grid.out()));
  petsc::check(DMSetUp(grid.get()));
  return grid;
}

/// h^2 times the equation, with its own Jacobian action.
class Bratu {
 public:
  Bratu(DM grid, double lambda) : grid_(grid) {
    petsc::check(DMDAGetLocalInfo(grid, &info_));
    weight_ = lambda / ((info_.mx + 1.0) * (info_.mx + 1.0));
    petsc::check(DMCreateLocalVector(grid, with_neighbours_.out()));
    petsc::check(DMCreateGlobalVector(grid, at_.out()));
  }

  void operator()(const petsc::Vector& u, petsc::Vector& r) {
    for_each_node(u, r, [&](int, int, double value, double minus_laplacian) {
      return minus_laplacian - weight_ * std::exp(value);
    });
  }
  void linearise(const petsc::Vector& u) { petsc::check(VecCopy(u.get(), at_.get())); }
  void apply_jacobian(const petsc::Vector& v, petsc::Vector& Jv) {
    const PetscScalar** at = nullptr;
    petsc::check(DMDAVecGetArrayRead(grid_, at_.get(), &at));
    for_each_node(v, Jv, [&](int i, int j, double value, double minus_laplacian) {
      return minus_laplacian - weight_ * std::exp(at[j][i]) * value;
    });
    petsc::check(DMDAVecRestoreArrayRead(grid_, at_.get(), &at));
  }

  /// Over all processes. MPI gives every process the same bits, so that all take the same path; a
  /// value that is not finite on one process is none on all.
  [[nodiscard]] double dot(const jfnk::Vector& a, const jfnk::Vector& b) const {
    double sum = 0.0;
    const jfnk::Vector* const one = &a;
    dots({&one, 1}, b, {&sum, 1});
    return sum;
  }
  /// All the products of an iteration are one message.
  void dots(jfnk::Vectors columns, const jfnk::Vector& w, std::span<double> sums) const {
    jfnk::InnerProductRef().dots(columns, w, sums);  // of the parts that are here
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(columns.size()), MPI_DOUBLE, MPI_SUM,
                  PetscObjectComm(reinterpret_cast<PetscObject>(grid_)));
  }
  [[nodiscard]] Eigen::Index global_size() const {
    return static_cast<Eigen::Index>(info_.mx) * info_.my;
  }

  void on_accept(const petsc::Vector& u) {
    jfnk::VectorTraits<petsc::Vector>::read(u, path.emplace_back());
  }
  /// The accepted points, this process's part of them.
  std::vector<jfnk::Vector> path;

 private:
  /// out = f(i, j, u, -h^2 Laplace(u)) at the nodes of this process.
  template <class F>
  void for_each_node(const petsc::Vector& u, petsc::Vector& out, const F& f) {
    petsc::check(DMGlobalToLocal(grid_, u.get(), INSERT_VALUES, with_neighbours_.get()));
    const PetscScalar** in = nullptr;
    PetscScalar** result = nullptr;
    petsc::check(DMDAVecGetArrayRead(grid_, with_neighbours_.get(), &in));
    petsc::check(DMDAVecGetArrayWrite(grid_, out.get(), &result));
    const auto value = [&](int i, int j) {
      return i < 0 || j < 0 || i >= info_.mx || j >= info_.my ? 0.0 : in[j][i];
    };
    for (int j = info_.ys; j < info_.ys + info_.ym; ++j) {
      for (int i = info_.xs; i < info_.xs + info_.xm; ++i) {
        result[j][i] = f(
            i, j, in[j][i],
            4.0 * in[j][i] - value(i - 1, j) - value(i + 1, j) - value(i, j - 1) - value(i, j + 1));
      }
    }
    petsc::check(DMDAVecRestoreArrayWrite(grid_, out.get(), &result));
    petsc::check(DMDAVecRestoreArrayRead(grid_, with_neighbours_.get(), &in));
  }

  DM grid_;
  DMDALocalInfo info_{};
  double weight_ = 0.0;  // lambda h^2
  petsc::Vector with_neighbours_;
  petsc::Vector at_;
};

/// The Laplacian, factorised over all processes at once.
class Factors {
 public:
  explicit Factors(DM grid) {
    DMDALocalInfo info{};
    petsc::check(DMDAGetLocalInfo(grid, &info));
    petsc::check(DMCreateMatrix(grid, matrix_.out()));
    for (int j = info.ys; j < info.ys + info.ym; ++j) {
      for (int i = info.xs; i < info.xs + info.xm; ++i) {
        MatStencil row{};
        row.i = i;
        row.j = j;
        const auto set = [&](int di, int dj, double entry) {
          MatStencil column = row;
          column.i += di;
          column.j += dj;
          if (column.i < 0 || column.j < 0 || column.i >= info.mx || column.j >= info.my) return;
          petsc::check(
              MatSetValuesStencil(matrix_.get(), 1, &row, 1, &column, &entry, INSERT_VALUES));
        };
        set(0, 0, 4.0);
        for (const int d : {-1, 1}) {
          set(d, 0, -1.0);
          set(0, d, -1.0);
        }
      }
    }
    petsc::check(MatAssemblyBegin(matrix_.get(), MAT_FINAL_ASSEMBLY));
    petsc::check(MatAssemblyEnd(matrix_.get(), MAT_FINAL_ASSEMBLY));
    PC factors = nullptr;
    petsc::check(KSPCreate(PetscObjectComm(reinterpret_cast<PetscObject>(grid)), solve_.out()));
    petsc::check(KSPSetOperators(solve_.get(), matrix_.get(), matrix_.get()));
    petsc::check(KSPSetType(solve_.get(), KSPPREONLY));
    petsc::check(KSPGetPC(solve_.get(), &factors));
    petsc::check(PCSetType(factors, PCLU));
    petsc::check(PCFactorSetMatSolverType(factors, MATSOLVERMUMPS));
    petsc::check(KSPSetUp(solve_.get()));
  }
  void apply(const petsc::Vector& r, petsc::Vector& z) const {
    petsc::check(KSPSolve(solve_.get(), r.get(), z.get()));
  }

 private:
  petsc::Owned<Mat, MatDestroy> matrix_;
  petsc::Owned<KSP, KSPDestroy> solve_;
};

struct Choice {
  const char* name;
  jfnk::Jacobian::Source source;
  bool preconditioned;
};

struct Outcome {
  jfnk::Report report;
  std::vector<jfnk::Vector> path;
  double largest = 0.0;  // max u
};

Outcome solve_on(DM grid, double lambda, const Choice& choice) {
  Bratu bratu(grid, lambda);
  jfnk::Options options;
  options.jacobian.source = choice.source;
  petsc::Vector u;
  petsc::check(DMCreateGlobalVector(grid, u.out()));  // zeros
  Outcome outcome;
  outcome.report = choice.preconditioned ? jfnk::solve(bratu, u, options, Factors(grid))
                                         : jfnk::solve(bratu, u, options);
  petsc::check(VecMax(u.get(), nullptr, &outcome.largest));
  outcome.path = std::move(bratu.path);
  return outcome;
}

/// The largest difference of an iterate's component from that of the same solve on one process,
/// over the largest component; infinite if the iterates are not equally many.
double difference(const Outcome& together, const Outcome& alone, PetscInt first) {
  double largest = 0.0;
  if (together.path.size() != alone.path.size()) largest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < std::min(together.path.size(), alone.path.size()); ++k) {
    const jfnk::Vector& mine = together.path[k];
    const double apart = (mine - alone.path[k].segment(first, mine.size())).cwiseAbs().maxCoeff();
    largest = std::max(largest, apart / alone.largest);
  }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  return largest;
}

/// All solves; true if each converged.
bool run(int m, double lambda) {
  int rank = 0;
  int processes = 1;
  MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  MPI_Comm_size(PETSC_COMM_WORLD, &processes);
  const Grid shared = strips(PETSC_COMM_WORLD, m);
  const Grid own = strips(PETSC_COMM_SELF, m);
  DMDALocalInfo info{};
  petsc::check(DMDAGetLocalInfo(shared.get(), &info));
  bool good = true;
  using Source = jfnk::Jacobian::Source;
  for (const Choice& choice :
       {Choice{"own Jacobian action", Source::user_if_available, false},
        Choice{"differences", Source::finite_difference, false},
        Choice{"factors of the Laplacian", Source::user_if_available, true}}) {
    const Outcome together = solve_on(shared.get(), lambda, choice);
    good = good && together.report.converged();
    if (rank == 0) {
      std::printf("%-24s %4d evaluations, max u = %.6f, %s\n", choice.name,
                  together.report.counts.total(), together.largest,
                  std::string(jfnk::to_string(together.report.status)).c_str());
    }
    if (processes == 1) continue;
    const Outcome alone = solve_on(own.get(), lambda, choice);
    const double apart = difference(together, alone, info.ys * info.mx);
    if (rank == 0) {
      std::printf("  %d processes and one: iterates differ by %.1e\n", processes, apart);
    }
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  const int m = argc > 1 ? std::atoi(argv[1]) : 32;
  const double lambda = argc > 2 ? std::atof(argv[2]) : 6.0;
  if (PetscInitialize(nullptr, nullptr, nullptr, nullptr) != 0) return 1;
  int processes = 1;
  MPI_Comm_size(PETSC_COMM_WORLD, &processes);
  if (m < std::max(2, processes) || !(lambda > 0.0)) {
    (void)PetscPrintf(PETSC_COMM_WORLD,
                      "usage: jfnk_petsc_bratu [nodes per side >= 2 and processes] [lambda > 0]\n");
    (void)PetscFinalize();
    return 2;
  }
  bool good = false;
  try {
    good = run(m, lambda);
  } catch (const std::exception& error) {
    // The other processes may be waiting for this one.
    std::fprintf(stderr, "jfnk_petsc_bratu: %s\n", error.what());
    MPI_Abort(PETSC_COMM_WORLD, 1);
  }
  return PetscFinalize() == 0 && good ? 0 : 3;
}
