// The parts that the files of this module share: calls that may fail, and PETSc's objects with owners.
#pragma once

#include "operators/solvers/petsc/petsc.h"

#include <petscksp.h>

#include <exception>
#include <utility>

namespace neumann::petsc {

// Throws what a function of a matrix has thrown, or else PETSc's message; does nothing if the code is 0.
void check(PetscErrorCode code);

// guarded() calls f, which may throw, from a function that PETSc calls; keep() stores what f threw for check().
void keep(std::exception_ptr thrown);
template <class F>
PetscErrorCode guarded(const F& f) {
    try {
        f();
        return 0;
    } catch (...) {
        keep(std::current_exception());
        return PETSC_ERR_USER;
    }
}

template <class Object, PetscErrorCode (*destroy)(Object*)>
class Owned {
public:
    Owned() = default;
    Owned(const Owned&) = delete;
    Owned& operator=(const Owned&) = delete;
    ~Owned() { destroy(&object_); }
    operator Object() const { return object_; }
    Object* operator&() { return &object_; }

private:
    Object object_ = nullptr;
};
using OwnedMat = Owned<Mat, MatDestroy>;
using OwnedVec = Owned<Vec, VecDestroy>;

// make_shell() represents the matrix by its products, and make_entries() by its entries; both for PETSC_COMM_WORLD.
void make_shell(const PetscMatrix& A, Mat* shell);
void make_entries(const PetscMatrix& A, Mat* entries);
void make_vector(const PetscMatrix& A, Vec* x);

void copy(Vec from, Vector& to);
void copy(const Vector& from, Vec to);

std::unique_ptr<PetscLinear> make_linear(const PetscMatrix& A);
PetscEigenpairs find_eigenpairs(const PetscMatrix& A, const PetscEigenTask& task);

}  // namespace neumann::petsc
