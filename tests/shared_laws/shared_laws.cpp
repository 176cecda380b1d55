// What must hold where processes share a scene's matrices: started by mpirun, beside the matrices of one process.
//
//     mpirun -n P shared_laws SCENE PATCHES RAYS
//
// Prints JSON: defects and largest differences over all processes.
#include "core/base/module.h"
#include "core/reader/read_scene.h"
#include "operators/fields/matrix/traced_system.h"
#include "operators/fields/shared/shared_system.h"
#include "operators/solvers/petsc/petsc_solver.h"
#include "operators/solvers/series_run.h"
#include "operators/solvers/spectrum/closure.h"

#include <fmt/format.h>

#include <cstdlib>

namespace {

using namespace neumann;

std::unique_ptr<Processes> start() {
    const auto make = reinterpret_cast<Processes* (*)()>(function_in_module("libneumann_mpi.so", "neumann_processes", "no MPI"));
    return std::unique_ptr<Processes>(make());
}

// Entries as PETSc stores them, against products.
double difference_of_entries(const SharedChannel& K) {
    const PetscMatrix A = petsc_matrix(K);
    const std::unique_ptr<Petsc> petsc = start_petsc("");
    const Vector x = K.measure();
    Vector y(x.size()), z(x.size());
    petsc->entries(A)->apply(x, y);
    K.apply(x, z);
    return K.agreement().size(y - z) / K.agreement().size(z);
}

void check(const std::string& path, const TracedSettings& settings, Processes& processes) {
    const Scene scene = read_scene(path, {});
    const SharedSystem shared(scene, settings, processes);
    const TracedSystem alone(scene, settings);
    const SharedRays& table = shared.table();
    double terms = 0.0, fields = 0.0, adjoint = 0.0, sums = 0.0, entries = 0.0, enclosed = 0.0;
    for (int c = 0; c < shared.channels(); ++c) {
        const SharedChannel K = shared.channel(c);
        const TracedChannel K1 = alone.channel(c);
        Vector t = shared.direct(c), t1 = alone.direct(c), next(t.size()), next1(t1.size());
        for (int bounce = 1; bounce <= 16; ++bounce) {
            terms = std::max(terms, table.size(t - table.own_of(t1)));
            K.apply(t, next);
            K1.apply(t1, next1);
            std::swap(t, next);
            std::swap(t1, next1);
        }
        const Vector all = table.gathered(t);
        if (processes.rank() == 0) fields = std::max(fields, (all - t1).lpNorm<Eigen::Infinity>());
        K.apply_adjoint(t, next);
        K1.apply_adjoint(t1, next1);
        adjoint = std::max(adjoint, table.size(next - table.own_of(next1)) / table.size(next));
        adjoint = std::max(adjoint, adjoint_defect(K));
        entries = std::max(entries, difference_of_entries(K));
        SeriesOptions options;
        options.tolerance = 1e-10;
        options.most_bounces = 60;
        const SeriesRun run = run_series(K, shared.direct(c), options), run1 = run_series(K1, alone.direct(c), options);
        sums = std::max(sums, table.size(run.sum - table.own_of(run1.sum)) / table.size(run.sum));
        enclosed = std::max(enclosed, std::abs(run.rows.back().enclosure_width - run1.rows.back().enclosure_width));
        if (run.rows.size() != run1.rows.size() || run.verdict != run1.verdict) sums = 1.0;
    }
    double most[] = {static_cast<double>(table.rays())};
    processes.largest(most);
    if (processes.rank() == 0)
        fmt::print(
            "{{\"processes\": {}, \"closure\": {}, \"terms\": {}, \"gathered\": {}, \"adjoint\": {}, \"entries\": {}, \"sums\": "
            "{}, "
            "\"enclosures\": {}, \"rays\": {}, \"most_rays\": {}}}\n",
            processes.size(), closure_defect(*shared.transported()), terms, fields, adjoint, entries, sums, enclosed, shared.rays(),
            most[0]);
    else
        closure_defect(*shared.transported());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    const std::unique_ptr<neumann::Processes> processes = start();
    check(argv[1], {std::strtoul(argv[2], nullptr, 10), static_cast<std::uint32_t>(std::atoi(argv[3])), 1}, *processes);
    return 0;
}
