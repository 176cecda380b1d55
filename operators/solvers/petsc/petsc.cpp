#include "operators/solvers/petsc/petsc.h"

#include "core/base/module.h"

namespace neumann {

namespace {

auto find_start() {
    return reinterpret_cast<Petsc* (*)(const std::string&)>(
        function_in_module("libneumann_petsc.so", "neumann_petsc", "PETSc needs neumann with -DNEUMANN_MPI=ON"));
}

}  // namespace

std::unique_ptr<Petsc> start_petsc(const std::string& options) { return std::unique_ptr<Petsc>(find_start()(options)); }

void require_petsc() { find_start(); }

}  // namespace neumann
