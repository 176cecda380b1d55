#include "core/processes/processes.h"

#include "core/base/module.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace neumann {

namespace {

// What launchers tell the processes that they start: Open MPI, MPICH and its relatives, and whoever starts by PMIx, like Slurm.
bool was_launched_with_others() {
    constexpr std::array sizes = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"};
    const bool several = std::ranges::any_of(sizes, [](const char* name) {
        const char* const size = std::getenv(name);
        return size != nullptr && std::atoi(size) > 1;
    });
    return several || std::getenv("PMIX_RANK") != nullptr;
}

}  // namespace

std::unique_ptr<Processes> launched_processes() {
    if (!was_launched_with_others()) return nullptr;
    const auto make = reinterpret_cast<Processes* (*)()>(function_in_module(
        "libneumann_mpi.so", "neumann_processes", "processes that were started together need neumann with -DNEUMANN_MPI=ON"));
    std::unique_ptr<Processes> processes(make());
    if (processes->size() == 1) return nullptr;
    return processes;
}

}  // namespace neumann
