#pragma once

#include <petscvec.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "jfnk/vector.hpp"

/// PETSc's vectors as those of libjfnk. To be copied into programs of your own.
namespace petsc {

/// Turns an error code of PETSc into an exception; PETSc itself has printed where it arose.
inline void check(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  (void)PetscErrorMessage(code, &text, nullptr);
  throw std::runtime_error("PETSc: " + std::string(text != nullptr ? text : "unknown error"));
}

/// Owns an object of PETSc; all must be gone before PetscFinalize.
template <class Object, PetscErrorCode (*destroy)(Object*)>
class Owned {
 public:
  Owned() = default;
  Owned(Owned&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Owned() {
    if (object_ != nullptr) (void)destroy(&object_);
  }
  /// The object, for calls of PETSc.
  [[nodiscard]] Object get() const { return object_; }
  /// Where a call of PETSc puts a new object; there must be none yet.
  [[nodiscard]] Object* out() { return &object_; }

 private:
  Object object_ = nullptr;
};

using Vector = Owned<Vec, VecDestroy>;

}  // namespace petsc

/// The part of a Vec that this process holds.
template <>
struct jfnk::VectorTraits<petsc::Vector> {
  using Scalar = PetscScalar;
  static Eigen::Index size(const petsc::Vector& v) {
    PetscInt n = 0;
    petsc::check(VecGetLocalSize(v.get(), &n));
    return n;
  }
  static petsc::Vector like(const petsc::Vector& v) {
    petsc::Vector other;
    petsc::check(VecDuplicate(v.get(), other.out()));
    return other;
  }
  static void read(const petsc::Vector& v, Eigen::VectorXd& out) {
    const PetscScalar* values = nullptr;
    petsc::check(VecGetArrayRead(v.get(), &values));
    out = Eigen::Map<const Eigen::VectorXd>(values, size(v));
    petsc::check(VecRestoreArrayRead(v.get(), &values));
  }
  static void write(const Eigen::VectorXd& in, petsc::Vector& v) {
    PetscScalar* values = nullptr;
    petsc::check(VecGetArrayWrite(v.get(), &values));
    Eigen::Map<Eigen::VectorXd>(values, size(v)) = in;
    petsc::check(VecRestoreArrayWrite(v.get(), &values));
  }
};
