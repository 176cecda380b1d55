#include "operators/petsc/petsc.h"

#include "core/base/module.h"

namespace neumann {

std::unique_ptr<Petsc> start_petsc(const std::string& options) {
    const auto start = reinterpret_cast<Petsc* (*)(const std::string&)>(
        function_in_module("libneumann_petsc.so", "neumann_petsc", "--petsc needs neumann with -DNEUMANN_MPI=ON"));
    return std::unique_ptr<Petsc>(start(options));
}

}  // namespace neumann
