#include "problem.hpp"

#include <Eigen/SparseLU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace peers {
namespace {

/// Bars between the nodes of a lattice, elastoplastic, in small displacements from rest: a unit of
/// strain is that of yield. `held` says of node (i, j) and axis how far it is held, NaN: it is
/// free.
class Frame {
 public:
  struct Shape {
    int columns;
    int rows;
    bool by_columns = false;  ///< nodes are numbered column after column, else row after row
    double hardening = 0.01;
  };
  using There = std::function<bool(int i, int j)>;
  using Held = std::function<double(int i, int j, int axis)>;

  Frame(const Shape& shape, const There& there, const Held& held) : shape_(shape) {
    const int outer = shape.by_columns ? shape.columns : shape.rows;
    const int inner = shape.by_columns ? shape.rows : shape.columns;
    nodes_.resize(static_cast<std::size_t>((shape.columns + 1) * (shape.rows + 1)));
    for (int a = 0; a <= outer; ++a) {
      for (int b = 0; b <= inner; ++b) {
        const int i = shape.by_columns ? a : b;
        const int j = shape.by_columns ? b : a;
        Node& node = at(i, j);
        node.there = there(i, j);
        for (std::size_t axis = 0; node.there && axis < 2; ++axis) {
          node.held[axis] = held(i, j, static_cast<int>(axis));
          if (std::isnan(node.held[axis])) node.index[axis] = unknowns_++;
        }
      }
    }
    for (int j = 0; j <= shape.rows; ++j) {
      for (int i = 0; i <= shape.columns; ++i) {
        add_bar(i, j, i + 1, j);
        add_bar(i, j, i, j + 1);
        add_bar(i, j, i + 1, j + 1);
        add_bar(i, j, i - 1, j + 1);
      }
    }
  }

  [[nodiscard]] Eigen::Index size() const { return unknowns_; }

  void operator()(const Vector& u, Vector& r) const {
    r.setZero();
    for (const Bar& bar : bars_) {
      const Node& a = nodes_[bar.a];
      const Node& b = nodes_[bar.b];
      const double strain = (bar.nx * (moved(b, 0, u) - moved(a, 0, u)) +
                             bar.ny * (moved(b, 1, u) - moved(a, 1, u))) /
                            bar.length;
      const double yielded = std::clamp(strain, -1.0, 1.0);
      const double force = yielded + shape_.hardening * (strain - yielded);
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const double part = force * (axis == 0 ? bar.nx : bar.ny);
        if (std::isnan(a.held[axis])) r[a.index[axis]] -= part;
        if (std::isnan(b.held[axis])) r[b.index[axis]] += part;
      }
    }
  }

 private:
  struct Node {
    bool there = false;
    std::array<Eigen::Index, 2> index{-1, -1};
    std::array<double, 2> held{};
  };
  struct Bar {
    std::size_t a;
    std::size_t b;
    double nx;
    double ny;
    double length;
  };
  [[nodiscard]] std::size_t place(int i, int j) const {
    return static_cast<std::size_t>(j * (shape_.columns + 1) + i);
  }
  Node& at(int i, int j) { return nodes_[place(i, j)]; }
  void add_bar(int i, int j, int k, int l) {
    if (k < 0 || k > shape_.columns || l > shape_.rows) return;
    if (!at(i, j).there || !at(k, l).there) return;
    const double length = std::hypot(k - i, l - j);
    bars_.push_back({place(i, j), place(k, l), (k - i) / length, (l - j) / length, length});
  }
  [[nodiscard]] static double moved(const Node& node, std::size_t axis, const Vector& u) {
    const Eigen::Index k = node.index[axis];
    return k < 0 ? node.held[axis] : u[k];
  }

  Shape shape_;
  std::vector<Node> nodes_;
  std::vector<Bar> bars_;
  Eigen::Index unknowns_ = 0;
};

constexpr double is_free = std::numeric_limits<double>::quiet_NaN();

Problem frame(const char* name, const Frame::Shape& shape, const Frame::There& there,
              const Frame::Held& held) {
  const auto bars = std::make_shared<const Frame>(shape, there, held);
  return {name, false, Vector::Zero(bars->size()), [bars](const Vector& u, Vector& r) {
            (*bars)(u, r);
            return true;
          }};
}

bool everywhere(int, int) {
  return true;
}

/// A footing pressed into half a stratum: held below, on rollers at both sides.
Problem footing(const char* name, bool by_columns) {
  const Frame::Shape shape{20, 14, by_columns, 0.01};
  return frame(name, shape, everywhere, [](int i, int j, int axis) {
    if (j == 0) return 0.0;
    if (j == 14 && i <= 6) return axis == 1 ? -50.0 : 0.0;
    return axis == 0 && (i == 0 || i == 20) ? 0.0 : is_free;
  });
}

/// A strip with a hole, pulled at its ends.
Problem holed_strip(const char* name) {
  const Frame::Shape shape{16, 16, false, 0.02};
  const auto there = [](int i, int j) { return std::hypot(i - 8, j - 8) > 3.2; };
  return frame(name, shape, there, [](int, int j, int axis) {
    if (j != 0 && j != 16) return is_free;
    return axis == 1 ? 2.0 * j : 0.0;
  });
}

/// A wall that is pushed into the soil behind it over the lower half of its height.
Problem pushed_wall(const char* name) {
  const Frame::Shape shape{20, 12, true, 0.02};
  return frame(name, shape, everywhere, [](int i, int j, int axis) {
    if (j == 0) return 0.0;
    if (i == 0 && j <= 6) return axis == 0 ? 40.0 : is_free;
    return i == 20 && axis == 0 ? 0.0 : is_free;
  });
}

/// A slab on piles: some nodes are held, here and there, and one corner is lifted.
Problem nailed_slab(const char* name) {
  const Frame::Shape shape{18, 16, false, 0.01};
  return frame(name, shape, everywhere, [](int i, int j, int axis) {
    if (i >= 16 && j >= 14) return axis == 1 ? 30.0 : is_free;
    return i % 5 == 1 && j % 4 == 1 ? 0.0 : is_free;
  });
}

/// Bratu's equation on part of a lattice of m x m nodes.
template <class Inside>
Problem bratu(const char* name, int m, double lambda, const Inside& inside) {
  std::vector<Eigen::Index> index(static_cast<std::size_t>(m * m), -1);
  Eigen::Index unknowns = 0;
  for (int k = 0; k < m * m; ++k) {
    if (inside(k % m, k / m)) index[static_cast<std::size_t>(k)] = unknowns++;
  }
  return {name, false, Vector::Zero(unknowns), [=](const Vector& u, Vector& r) {
            const auto at = [&](int i, int j) {
              if (i < 0 || j < 0 || i >= m || j >= m) return 0.0;
              const Eigen::Index k = index[static_cast<std::size_t>(j * m + i)];
              return k < 0 ? 0.0 : u[k];
            };
            const double h = 1.0 / (m + 1.0);
            for (int j = 0; j < m; ++j) {
              for (int i = 0; i < m; ++i) {
                const Eigen::Index k = index[static_cast<std::size_t>(j * m + i)];
                if (k < 0) continue;
                r[k] = 4.0 * u[k] - at(i - 1, j) - at(i + 1, j) - at(i, j - 1) - at(i, j + 1) -
                       h * h * lambda * std::exp(u[k]);
              }
            }
            return true;
          }};
}

/// A beam above an obstacle, its stiffness and load scaled by h^4.
struct Beam {
  int n;
  double load;
  double depth;
  bool clamped = false;  ///< at its left end, else hinged

  [[nodiscard]] double push(const Vector& u, int i) const {
    const auto at = [&](int k) {
      if (k < 0) return k == -1 ? 0.0 : (clamped ? 1.0 : -1.0) * u[0];
      if (k >= n) return k == n ? 0.0 : -u[n - 1];
      return u[k];
    };
    return at(i - 2) - 4.0 * at(i - 1) + 6.0 * at(i) - 4.0 * at(i + 1) + at(i + 2) +
           load * std::pow(n + 1.0, -4);
  }
};

/// Where it comes to lie, by pivots: all that is wrong changes sides while that makes fewer wrong,
/// else the last one alone (Júdice & Pires 1994, Comput. Oper. Res. 21, 587).
Vector lie_down(const Beam& beam) {
  constexpr int most_pivots = 4000;
  const int n = beam.n;
  std::vector<bool> touches(static_cast<std::size_t>(n), false);
  Vector u(n);
  int fewest = n + 1;
  int patience = 0;
  for (int pivot = 0; pivot < most_pivots; ++pivot) {
    std::vector<Eigen::Triplet<double>> entries;
    Vector right = Vector::Zero(n);
    for (int i = 0; i < n; ++i) {
      if (touches[static_cast<std::size_t>(i)]) {
        entries.emplace_back(i, i, 1.0);
        right[i] = -beam.depth;
        continue;
      }
      right[i] = -beam.push(Vector::Zero(n), i);
      for (int j = std::max(0, i - 2); j <= std::min(n - 1, i + 2); ++j) {
        entries.emplace_back(i, j, beam.push(Vector::Unit(n, j), i) + right[i]);
      }
    }
    Eigen::SparseMatrix<double> stiffness(n, n);
    stiffness.setFromTriplets(entries.begin(), entries.end());
    u = Eigen::SparseLU<Eigen::SparseMatrix<double>>(stiffness).solve(right);
    std::vector<std::size_t> wrong;
    for (int i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (touches[k] ? beam.push(u, i) < 0.0 : u[i] < -beam.depth) wrong.push_back(k);
    }
    if (wrong.empty()) break;
    const auto count = static_cast<int>(wrong.size());
    patience = count < fewest ? 10 : patience - 1;
    fewest = std::min(fewest, count);
    if (patience <= 0) wrong.assign(1, wrong.back());
    for (const std::size_t k : wrong) touches[k] = !touches[k];
  }
  return u;
}

/// Gap and contact force are complementary (Fischer 1992, Optimization 24, 269).
Problem contact_beam(const char* name, const Beam& beam) {
  Problem problem{name, false, Vector::Zero(beam.n), [beam](const Vector& u, Vector& r) {
                    for (int i = 0; i < beam.n; ++i) {
                      const double gap = u[i] + beam.depth;
                      const double push = beam.push(u, i);
                      r[i] = gap + push - std::hypot(gap, push);
                    }
                    return true;
                  }};
  problem.root = lie_down(beam);
  return problem;
}

}  // namespace

void add_fifth_set(std::vector<Problem>& problems) {
  const std::size_t before = problems.size();
  problems.push_back(footing("footing, by rows", false));
  problems.push_back(footing("footing, by columns", true));
  problems.push_back(holed_strip("holed strip"));
  problems.push_back(pushed_wall("pushed wall"));
  problems.push_back(nailed_slab("nailed slab"));
  problems.push_back(bratu("Bratu, L", 24, 12.0, [](int i, int j) { return i < 12 || j < 12; }));
  problems.push_back(bratu("Bratu, disc", 24, 6.0,
                           [](int i, int j) { return std::hypot(i - 11.5, j - 11.5) <= 12.0; }));
  problems.push_back(bratu("Bratu, hole", 40, 6.0,
                           [](int i, int j) { return std::hypot(i - 19.5, j - 19.5) >= 8.0; }));
  problems.push_back(contact_beam("contact beam 50", {50, 50.0, 0.1, false}));
  problems.push_back(contact_beam("contact beam 200", {200, 1000.0, 0.1, false}));
  problems.push_back(contact_beam("contact beam 400", {400, 5000.0, 0.01, false}));
  problems.push_back(contact_beam("clamped contact beam", {200, 300.0, 0.02, true}));
  for (std::size_t i = before; i < problems.size(); ++i) problems[i].set = 5;
}

}  // namespace peers
