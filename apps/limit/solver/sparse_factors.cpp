#include "limit/solver/sparse_factors.hpp"

#include <dmumps_c.h>
#include <fmt/format.h>

#include <stdexcept>

namespace limit::solver {

namespace {

// Values of `job`, and of the communicator that stands for the world (MUMPS users' guide).
constexpr int begin = -1, end = -2, analyse = 1, factorise_job = 2, solve_job = 3;
constexpr int world = -987654;

}  // namespace

struct SparseFactors::Mumps {
  DMUMPS_STRUC_C data{};
  std::vector<int> rows, columns;  // from 1

  void run(int job) {
    data.job = job;
    dmumps_c(&data);
  }
  // As the users' guide counts them.
  int& control(int i) { return data.icntl[i - 1]; }
};

SparseFactors::SparseFactors(Kind kind, int size, const std::vector<int>& rows,
                             const std::vector<int>& columns)
    : mumps_(std::make_unique<Mumps>()) {
  Mumps& mumps = *mumps_;
  for (const int row : rows) mumps.rows.push_back(row + 1);
  for (const int column : columns) mumps.columns.push_back(column + 1);
  mumps.data.par = 1;
  mumps.data.sym = kind == Kind::positive_definite ? 1 : 2;
  mumps.data.comm_fortran = world;
  mumps.run(begin);
  for (const int messages : {1, 2, 3}) mumps.control(messages) = -1;
  mumps.control(4) = 0;
  mumps.control(14) = 50;        // percent of memory beyond the estimate
  constexpr int least_fill = 2;  // the better order where pivots are put off
  if (kind == Kind::indefinite) mumps.control(7) = least_fill;
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

SparseFactors::~SparseFactors() {
  mumps_->run(end);
}

bool SparseFactors::factorise(std::vector<double>& entries) {
  mumps_->data.a = entries.data();
  mumps_->run(factorise_job);
  // Pivots that are put off need more room than is foreseen.
  constexpr int too_small = -9, most = 3200;
  for (int more = 100; mumps_->data.infog[0] == too_small && more <= most; more *= 2) {
    mumps_->control(14) = more;
    mumps_->run(factorise_job);
  }
  constexpr double move = 20.0;  // what it takes to put an entry where it belongs, in operations
  work_ += mumps_->data.rinfog[2] + move * entries_in_factors();
  return mumps_->data.infog[0] >= 0;
}

double SparseFactors::entries_in_factors() const {
  const double count = mumps_->data.infog[28];
  constexpr double million = 1e6;  // of which there are so many, if it is negative
  return count < 0.0 ? -million * count : count;
}

void SparseFactors::solve(Eigen::VectorXd& right_side) {
  mumps_->data.rhs = right_side.data();
  mumps_->run(solve_job);
  // Two operations for each entry, forth and back; but what they wait for is memory.
  constexpr double wait = 4.0;
  work_ += 4.0 * wait * entries_in_factors();
}

}  // namespace limit::solver
