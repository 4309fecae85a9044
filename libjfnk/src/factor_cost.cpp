#include "factor_cost.hpp"

#include <Eigen/OrderingMethods>
#include <vector>

namespace jfnk::detail {

Order order_of_elimination(const Eigen::SparseMatrix<double>& pattern) {
  Order order;
  Eigen::AMDOrdering<int>()(pattern, order);
  return order;
}

FactorCost factor_cost(const Eigen::SparseMatrix<double>& pattern, const Order& order,
                       double most_entries) {
  const Eigen::Index n = pattern.cols();
  const Order place = order.inverse();
  std::vector<int> parent(static_cast<std::size_t>(n), -1);
  std::vector<int> met(static_cast<std::size_t>(n), -1);
  std::vector<double> below(static_cast<std::size_t>(n), 0.0);  // entries of L under the diagonal
  FactorCost cost;
  for (int row = 0; row < n && cost.entries <= most_entries; ++row) {
    met[static_cast<std::size_t>(row)] = row;
    const int old = order.indices()[row];
    for (Eigen::SparseMatrix<double>::InnerIterator it(pattern, old); it; ++it) {
      // L has an entry of this row in every column on the way up the tree.
      int column = place.indices()[it.row()];
      if (column > row) continue;
      while (met[static_cast<std::size_t>(column)] != row) {
        const auto c = static_cast<std::size_t>(column);
        if (parent[c] < 0) parent[c] = row;
        met[c] = row;
        below[c] += 1.0;
        cost.entries += 2.0;
        column = parent[c];
      }
    }
  }
  for (const double count : below) cost.operations += 2.0 * count * count;
  cost.entries += static_cast<double>(n);
  return cost;
}

}  // namespace jfnk::detail
