#include "limit/solver/sparse_cholesky.hpp"

#include <dmumps_c.h>
#include <fmt/format.h>

#include <stdexcept>

namespace limit::solver {

namespace {

// Values of `job`, and of the communicator that stands for the world (MUMPS users' guide).
constexpr int begin = -1, end = -2, analyse = 1, factorise_job = 2, solve_job = 3;
constexpr int world = -987654;

}  // namespace

struct SparseCholesky::Mumps {
  DMUMPS_STRUC_C data{};
  std::vector<int> rows, columns;  // from 1

  void run(int job) {
    data.job = job;
    dmumps_c(&data);
  }
  // As the users' guide counts them.
  int& control(int i) { return data.icntl[i - 1]; }
};

SparseCholesky::SparseCholesky(int size, const std::vector<int>& rows,
                               const std::vector<int>& columns)
    : mumps_(std::make_unique<Mumps>()) {
  Mumps& mumps = *mumps_;
  for (const int row : rows) mumps.rows.push_back(row + 1);
  for (const int column : columns) mumps.columns.push_back(column + 1);
  mumps.data.par = 1;
  mumps.data.sym = 1;  // positive definite: no pivoting
  mumps.data.comm_fortran = world;
  mumps.run(begin);
  for (const int messages : {1, 2, 3}) mumps.control(messages) = -1;
  mumps.control(4) = 0;
  mumps.control(14) = 50;  // percent of memory beyond the estimate
  mumps.data.n = size;
  mumps.data.nz = static_cast<int>(rows.size());
  mumps.data.irn = mumps.rows.data();
  mumps.data.jcn = mumps.columns.data();
  mumps.run(analyse);
  if (mumps.data.infog[0] < 0) {
    const int code = mumps.data.infog[0];
    mumps.run(end);
    throw std::runtime_error(fmt::format("MUMPS: analysis failed, error {}", code));
  }
}

SparseCholesky::~SparseCholesky() {
  mumps_->run(end);
}

bool SparseCholesky::factorise(std::vector<double>& entries) {
  mumps_->data.a = entries.data();
  mumps_->run(factorise_job);
  return mumps_->data.infog[0] >= 0;
}

void SparseCholesky::solve(Eigen::VectorXd& right_side) {
  mumps_->data.rhs = right_side.data();
  mumps_->run(solve_job);
}

}  // namespace limit::solver
