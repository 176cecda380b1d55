// PETSc's solvers and SLEPc's eigenpairs, for matrices that one process has or several share. Their headers are
// included only in a module, which start_petsc() loads.
//
// S. Balay, W. D. Gropp, L. C. McInnes, B. F. Smith, Efficient management of parallelism in object oriented numerical software
// libraries, 1997; V. Hernandez, J. E. Roman, V. Vidal, SLEPc, ACM Trans. Math. Softw. 31 (2005).
#pragma once

#include "operators/algebra/vector.h"

#include <complex>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace neumann {

// The rows that this process has of a square matrix. Vectors hold the values of this process's unknowns.
struct PetscMatrix {
    Eigen::Index size = 0;
    std::size_t first = 0, all = 0;  // the number of the first row among all, and how many there are in all
    std::function<void(const Vector& x, Vector& y)> apply;
    std::function<void(const Vector& x, Vector& y)> apply_transposed;
    std::function<double(Eigen::Index u)> diagonal;
    // Calls each(v, a) for the entries a of row u; v is a number among all unknowns, and may come several times.
    std::function<void(Eigen::Index u, const std::function<void(std::size_t v, double a)>& each)> row;
};

// A linear solver of PETSc (KSP).
class PetscLinear {
public:
    struct End {
        bool converged = false;
        std::string why;             // "CONVERGED_RTOL"
        bool own_tolerance = false;  // the options set another tolerance
    };
    // Called for each iterate; `residual` is ‖r‖₂ in the norm that the method uses.
    using OnIterate = std::function<void(int iteration, double residual, const std::function<Vector()>& iterate)>;

    virtual ~PetscLinear() = default;
    // The names of method and preconditioner: "gmres/jacobi".
    virtual std::string method() const = 0;
    // Solves A x = b from the given x until the residual is `tolerance` times that of x = 0.
    virtual End solve(const Vector& b, Vector& x, double tolerance, int most, const OnIterate& on_iterate) = 0;
};

// Entries as PETSc stores them (MATAIJ), whose products are compared with others.
class PetscEntries {
public:
    virtual ~PetscEntries() = default;
    virtual void apply(const Vector& x, Vector& y) = 0;
    virtual double entries() const = 0;  // of this process
    virtual double bytes() const = 0;
};

struct PetscEigenTask {
    int count = 1;  // of largest modulus
    bool symmetric = false;
    Vector start = {};
    double tolerance = 1e-10;  // of the residuals, relative to the eigenvalues
    int restarts = 1000;
};
struct PetscEigenpairs {
    std::string method;  // "krylovschur"
    bool converged = false;
    std::vector<std::complex<double>> values;
    std::vector<Eigen::VectorXcd> vectors;
    int restarts = 0;
};

// PETSc between its start and its end; there must not be two at the same time. Throws RunError with PETSc's message,
// InputError if the options name something that PETSc does not know, and what the functions of a matrix throw.
class Petsc {
public:
    virtual ~Petsc() = default;
    // Keeps a reference to the matrix. Its entries are stored only if the preconditioner needs them.
    virtual std::unique_ptr<PetscLinear> linear(const PetscMatrix& A) = 0;
    virtual std::unique_ptr<PetscEntries> entries(const PetscMatrix& A) = 0;
    virtual PetscEigenpairs eigenpairs(const PetscMatrix& A, const PetscEigenTask& task) = 0;
    // The options that nothing has read so far.
    virtual std::vector<std::string> unused_options() const = 0;
};

// `options` are written as on the command line of a program that uses PETSc, "-ksp_type gmres -pc_type asm". What they
// let PETSc print goes to stderr. Throws RunError if neumann was built without PETSc.
std::unique_ptr<Petsc> start_petsc(const std::string& options);
// Throws RunError if neumann was built without PETSc, and does nothing else.
void require_petsc();

}  // namespace neumann
