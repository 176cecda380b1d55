// A PetscMatrix as matrices of PETSc.
#include "operators/solvers/petsc/module/session.h"

#include <algorithm>

namespace neumann::petsc {

namespace {

const PetscMatrix& matrix_of(Mat shell) {
    void* context = nullptr;
    MatShellGetContext(shell, &context);
    return *static_cast<const PetscMatrix*>(context);
}

PetscErrorCode product(Vec x, Vec y, const std::function<void(const Vector&, Vector&)>& apply) {
    return guarded([&] {
        Vector from, to;
        copy(x, from);
        to.resize(from.size());
        apply(from, to);
        copy(to, y);
    });
}

PetscErrorCode apply(Mat shell, Vec x, Vec y) { return product(x, y, matrix_of(shell).apply); }
PetscErrorCode apply_transposed(Mat shell, Vec x, Vec y) { return product(x, y, matrix_of(shell).apply_transposed); }
PetscErrorCode get_diagonal(Mat shell, Vec d) {
    return guarded([&] {
        const PetscMatrix& A = matrix_of(shell);
        Vector diagonal(A.size);
        for (Eigen::Index u = 0; u < A.size; ++u) diagonal[u] = A.diagonal(u);
        copy(diagonal, d);
    });
}

// A row with its columns in order, each of them once.
class Row {
public:
    void read(const PetscMatrix& A, Eigen::Index u) {
        entries_.clear();
        A.row(u, [&](std::size_t v, double a) { entries_.emplace_back(static_cast<PetscInt>(v), a); });
        std::stable_sort(entries_.begin(), entries_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        columns.clear();
        values.clear();
        for (const auto& [v, a] : entries_) {
            if (columns.empty() || columns.back() != v) {
                columns.push_back(v);
                values.push_back(0.0);
            }
            values.back() += a;
        }
    }
    std::vector<PetscInt> columns;
    std::vector<double> values;

private:
    std::vector<std::pair<PetscInt, double>> entries_;
};

}  // namespace

void copy(Vec from, Vector& to) {
    PetscInt n = 0;
    const PetscScalar* values = nullptr;
    check(VecGetLocalSize(from, &n));
    check(VecGetArrayRead(from, &values));
    to = Eigen::Map<const Vector>(values, n);
    check(VecRestoreArrayRead(from, &values));
}

void copy(const Vector& from, Vec to) {
    PetscScalar* values = nullptr;
    check(VecGetArrayWrite(to, &values));
    std::copy(from.begin(), from.end(), values);
    check(VecRestoreArrayWrite(to, &values));
}

void make_vector(const PetscMatrix& A, Vec* x) {
    check(VecCreateMPI(PETSC_COMM_WORLD, static_cast<PetscInt>(A.size), static_cast<PetscInt>(A.all), x));
}

void make_shell(const PetscMatrix& A, Mat* shell) {
    const auto own = static_cast<PetscInt>(A.size), all = static_cast<PetscInt>(A.all);
    check(MatCreateShell(PETSC_COMM_WORLD, own, own, all, all, const_cast<PetscMatrix*>(&A), shell));
    const auto set = [&](MatOperation operation, auto function) {
        check(MatShellSetOperation(*shell, operation, reinterpret_cast<void (*)()>(function)));
    };
    set(MATOP_MULT, apply);
    if (A.apply_transposed) set(MATOP_MULT_TRANSPOSE, apply_transposed);
    if (A.diagonal) set(MATOP_GET_DIAGONAL, get_diagonal);
}

void make_entries(const PetscMatrix& A, Mat* entries) {
    const auto own = static_cast<PetscInt>(A.size), first = static_cast<PetscInt>(A.first);
    std::vector<PetscInt> of_own(static_cast<std::size_t>(own)), of_others(of_own);
    Row row;
    for (PetscInt u = 0; u < own; ++u) {
        row.read(A, u);
        const auto i = static_cast<std::size_t>(u);
        for (const PetscInt v : row.columns) ++(v >= first && v < first + own ? of_own : of_others)[i];
    }
    check(MatCreateAIJ(PETSC_COMM_WORLD, own, own, static_cast<PetscInt>(A.all), static_cast<PetscInt>(A.all), 0, of_own.data(), 0,
                       of_others.data(), entries));
    for (PetscInt u = 0; u < own; ++u) {
        row.read(A, u);
        const PetscInt global = first + u;
        check(MatSetValues(*entries, 1, &global, static_cast<PetscInt>(row.columns.size()), row.columns.data(), row.values.data(),
                           INSERT_VALUES));
    }
    check(MatAssemblyBegin(*entries, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(*entries, MAT_FINAL_ASSEMBLY));
}

}  // namespace neumann::petsc
