#pragma once

#include "jfnk/vector_operations.hpp"

namespace jfnk::detail {

/// to = from, on the threads of the product; both of one size, and other vectors.
inline void assign(const InnerProductRef& product, Vector& to, const Vector& from) {
  to.resize(from.size());
  product.pass(to.size(), 2, [&](Rows rows) { rows.of(to) = rows.of(from); });
}

/// to = a + factor b, likewise; `to` may be one of them.
inline void add(const InnerProductRef& product, Vector& to, const Vector& a, double factor,
                const Vector& b) {
  to.resize(a.size());
  product.pass(to.size(), 3, [&](Rows rows) { rows.of(to) = rows.of(a) + factor * rows.of(b); });
}

}  // namespace jfnk::detail
