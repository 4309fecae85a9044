#pragma once

#include <memory>
#include <type_traits>

#include "jfnk/residual.hpp"

namespace jfnk {

namespace detail {

template <class P, class V>
concept HasApply = requires(P& p, const V& r, V& z) {
  p.apply(r, z);
};
template <class P, class V>
concept CallableOn = requires(P& p, const V& r, V& z) {
  p(r, z);
};
template <class P, class V>
concept PreconditionerOn = HasApply<P, V> || CallableOn<P, V>;

/// z = P r by `apply` if there is one, else by a call.
template <class P, class V>
void apply_preconditioner(P& p, const V& r, V& z) {
  if constexpr (HasApply<P, V>) {
    p.apply(r, z);
  } else {
    p(r, z);
  }
}

}  // namespace detail

/// Any object whose `apply(r, z)` overwrites z with an approximation of J^{-1} r, or anything that
/// can be called so.
///
/// It must be linear in r and the same from call to call unless the Krylov solver is `flexible`.
template <class P>
concept Preconditioner = detail::PreconditionerOn<P, Vector>;

/// A preconditioner that wants to see the point of linearisation: `setup(u)`.
template <class P>
concept HasSetup = requires(P& p, const Vector& u) {
  p.setup(u);
};

/// No preconditioning: z = r at no cost.
struct Identity {
  void apply(const Vector& r, Vector& z) const { z = r; }
};

/// Non-owning, type-erased view of a preconditioner; the identity when default constructed.
class PreconditionerRef {
 public:
  PreconditionerRef() = default;
  template <class P>
  requires(!std::same_as<std::remove_cv_t<P>, PreconditionerRef> &&
           Preconditioner<P>) explicit PreconditionerRef(P& p) {
    if constexpr (!std::same_as<std::remove_cv_t<P>, Identity>) {
      object_ = detail::erase(p);
      apply_ = [](void* o, const Vector& r, Vector& z) {
        detail::apply_preconditioner(detail::restore<P>(o), r, z);
      };
      if constexpr (HasSetup<P>) {
        setup_ = [](void* o, const Vector& u) { detail::restore<P>(o).setup(u); };
      }
    }
  }

  /// True if `apply` only copies.
  [[nodiscard]] bool is_identity() const { return apply_ == nullptr; }
  /// True if the preconditioner has a `setup`.
  [[nodiscard]] bool has_setup() const { return setup_ != nullptr; }
  /// z = P r.
  void apply(const Vector& r, Vector& z) const {
    if (apply_ == nullptr) {
      z = r;
    } else {
      apply_(object_, r, z);
    }
  }
  /// Lets the preconditioner rebuild itself about u; nothing if it has no `setup`.
  void setup(const Vector& u) const {
    if (setup_ != nullptr) setup_(object_, u);
  }

 private:
  void* object_ = nullptr;
  void (*apply_)(void*, const Vector&, Vector&) = nullptr;
  void (*setup_)(void*, const Vector&) = nullptr;
};

}  // namespace jfnk
