#pragma once

#include <type_traits>
#include <utility>

#include "jfnk/preconditioner.hpp"
#include "jfnk/residual.hpp"

// What a caller nearly got right, said in words by the compiler instead of by a list of candidates,
// or instead of being ignored.
namespace jfnk::detail {

// A class has a member of that name; overloads and templates are not seen.
template <class T>
concept NamesLinearize = requires {
  &T::linearize;
};
template <class T>
concept NamesLinearise = requires {
  &T::linearise;
};
template <class T>
concept NamesApplyJacobian = requires {
  &T::apply_jacobian;
};
template <class T>
concept NamesReferenceNorm = requires {
  &T::reference_norm;
};
template <class T>
concept NamesDot = requires {
  &T::dot;
};
template <class T>
concept NamesDots = requires {
  &T::dots;
};
template <class T>
concept NamesCombineOrRotate = requires {
  &T::combine;
}
|| requires {
  &T::rotate;
};
template <class T>
concept NamesShareOut = requires {
  &T::share_out;
};
template <class T>
concept NamesGlobalSize = requires {
  &T::global_size;
};
template <class T>
concept NamesOnAccept = requires {
  &T::on_accept;
};
template <class T>
concept NamesFilterStep = requires {
  &T::filter_step;
};
template <class T>
concept NamesApply = requires {
  &T::apply;
};
template <class T>
concept NamesSetup = requires {
  &T::setup;
};

template <class F, class V>
concept TakesUAndR = requires(F& f, const V& u, V& r) {
  f(u, r);
};

/// The optional members of a residual on V.
template <class F, class V>
constexpr void explain_members() {
  constexpr bool linearises = requires(F & f, const V& u) {
    f.linearise(u);
  };
  constexpr bool acts = requires(F & f, const V& v, V& Jv) {
    f.apply_jacobian(v, Jv);
  };
  static_assert(!NamesLinearize<F> || linearises,
                "jfnk: the residual has a member `linearize`; it is spelt `linearise(u)` here");
  static_assert(
      !NamesLinearise<F> || linearises,
      "jfnk: `linearise` of the residual cannot be called as linearise(u) with a const u");
  static_assert(!NamesApplyJacobian<F> || acts,
                "jfnk: `apply_jacobian` of the residual cannot be called as apply_jacobian(v, Jv) "
                "with a const v");
  static_assert(linearises == acts,
                "jfnk: a residual with a Jacobian action has both linearise(u) and "
                "apply_jacobian(v, Jv)");
  if constexpr (linearises && acts) {
    static_assert(is_outcome<decltype(std::declval<F&>().linearise(std::declval<const V&>()))> &&
                      is_outcome<decltype(std::declval<F&>().apply_jacobian(
                          std::declval<const V&>(), std::declval<V&>()))>,
                  "jfnk: linearise and apply_jacobian must return nothing, bool or Evaluation");
  }
  static_assert(!NamesReferenceNorm<F> || HasReferenceNorm<F>,
                "jfnk: `reference_norm` of the residual must be const and return a double");
  static_assert(!NamesDot<F> || HasInnerProduct<F>,
                "jfnk: `dot` of the residual must be const, take two jfnk::Vector and return a "
                "double");
  static_assert(!NamesDots<F> || HasDots<F>,
                "jfnk: `dots` of the residual must be const and take jfnk::Vectors, a const "
                "jfnk::Vector& and a std::span<double>");
  static_assert(!HasDots<F> || HasInnerProduct<F>,
                "jfnk: a residual with `dots` needs the `dot` that they are many of");
  static_assert(!NamesCombineOrRotate<F> || HasShareOut<F>,
                "jfnk: `combine` and `rotate` of the residual are not asked for any more: threads "
                "come by `share_out(n, numbers, work) const`");
  static_assert(!NamesShareOut<F> || HasShareOut<F>,
                "jfnk: `share_out` of the residual must be const and take two Eigen::Index and a "
                "jfnk::BlockWork");
  static_assert(!NamesGlobalSize<F> || HasGlobalSize<F>,
                "jfnk: `global_size` of the residual must be const and return a number");
  static_assert(!HasGlobalSize<F> || HasInnerProduct<F>,
                "jfnk: a residual with `global_size` needs a `dot` that sums over all processes");
  static_assert(
      !NamesOnAccept<F> || requires(F & f, const V& u) { f.on_accept(u); },
      "jfnk: `on_accept` of the residual cannot be called as on_accept(u) with a const u");
  static_assert(
      !NamesFilterStep<F> || requires(F & f, const V& u, V& du) { f.filter_step(u, du); },
      "jfnk: `filter_step` of the residual cannot be called as filter_step(u, du)");
}

/// A residual on V.
template <class F, class V>
constexpr void explain_residual() {
  static_assert(
      TakesUAndR<F, V>,
      "jfnk: the residual cannot be called as f(u, r) with a const vector u and a vector r "
      "to be overwritten, both jfnk::Vector or of the type of the first guess");
  if constexpr (TakesUAndR<F, V>) {
    static_assert(
        is_outcome<decltype(std::declval<F&>()(std::declval<const V&>(), std::declval<V&>()))>,
        "jfnk: the residual must return nothing, bool (false: no value at this u) or "
        "jfnk::Evaluation, and not a number, which might mean either");
    if constexpr (std::is_class_v<F>) explain_members<F, V>();
  }
}

/// A preconditioner on V.
template <class P, class V>
constexpr void explain_preconditioner() {
  static_assert(
      !NamesApply<P> || HasApply<P, V>,
      "jfnk: `apply` of the preconditioner cannot be called as apply(r, z) with a const r");
  static_assert(PreconditionerOn<P, V>,
                "jfnk: the preconditioner has no apply(r, z), nor can it be called as p(r, z); an "
                "observer comes after it");
  static_assert(
      !NamesSetup<P> || requires(P & p, const V& u) { p.setup(u); },
      "jfnk: `setup` of the preconditioner cannot be called as setup(u) with a const u");
}

}  // namespace jfnk::detail
