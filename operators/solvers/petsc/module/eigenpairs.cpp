// SLEPc's eigenvalue solvers (EPS).
#include "operators/solvers/petsc/module/session.h"

#include <slepceps.h>

#include <algorithm>

namespace neumann::petsc {

PetscEigenpairs find_eigenpairs(const PetscMatrix& A, const PetscEigenTask& task) {
    OwnedMat shell;
    OwnedVec start, real, imaginary;
    Owned<EPS, EPSDestroy> eps;
    make_shell(A, &shell);
    make_vector(A, &start);
    make_vector(A, &real);
    make_vector(A, &imaginary);
    copy(task.start, start);
    check(EPSCreate(PETSC_COMM_WORLD, &eps));
    check(EPSSetOperators(eps, shell, nullptr));
    check(EPSSetProblemType(eps, task.symmetric ? EPS_HEP : EPS_NHEP));
    check(EPSSetWhichEigenpairs(eps, EPS_LARGEST_MAGNITUDE));
    const PetscInt wanted = std::min(task.count, static_cast<int>(A.all));
    check(EPSSetDimensions(eps, wanted, std::min<PetscInt>(std::max<PetscInt>(2 * wanted + 1, 20), static_cast<PetscInt>(A.all)),
                           PETSC_DEFAULT));
    check(EPSSetTolerances(eps, task.tolerance, task.restarts));
    Vec begin = start;
    check(EPSSetInitialSpace(eps, 1, &begin));
    check(EPSSetFromOptions(eps));
    check(EPSSolve(eps));

    PetscEigenpairs found;
    EPSType type = nullptr;
    PetscInt converged = 0, restarts = 0;
    check(EPSGetType(eps, &type));
    check(EPSGetConverged(eps, &converged));
    check(EPSGetIterationNumber(eps, &restarts));
    found.method = type;
    found.converged = converged >= wanted;
    found.restarts = static_cast<int>(restarts);
    for (PetscInt i = 0; i < std::min(converged, wanted); ++i) {
        PetscScalar re = 0.0, im = 0.0;
        check(EPSGetEigenpair(eps, i, &re, &im, real, imaginary));
        Vector x, y;
        copy(real, x);
        copy(imaginary, y);
        found.values.emplace_back(re, im);
        found.vectors.push_back(x.cast<std::complex<double>>() + std::complex<double>(0.0, 1.0) * y.cast<std::complex<double>>());
    }
    return found;
}

}  // namespace neumann::petsc
