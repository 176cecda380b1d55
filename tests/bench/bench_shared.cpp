// What matrices of growing size take, on one process and on several that share them:
//
//     mpirun -n P bench_shared [PATCHES …]     scenes/cornell-box with 64 rays; without numbers 10⁴, 10⁵, 10⁶ patches
//
// A row each: rays; resident memory of all processes by ray, patches, R and vectors included, with 4 bytes of it the ray's; seconds
// of T, of a product, of its exchange alone, and of 64 bounces; what a product sends; and where --entries is given the same product
// with PETSc's MATAIJ and its bytes by entry. Seconds are of a processor, but by the clock for exchanges; the fastest of several.
// First the machine: the bandwidth of copying with all processes at once, and of exchanging all with all.
#include "core/base/module.h"
#include "core/base/stopwatch.h"
#include "core/reader/read_scene.h"
#include "operators/algebra/term_series.h"
#include "operators/fields/shared/shared_system.h"
#include "operators/solvers/petsc/petsc_solver.h"

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <string_view>

namespace {

using namespace neumann;

double resident_bytes() {
    std::ifstream statm("/proc/self/statm");
    double pages = 0.0;
    statm >> pages >> pages;
    return pages * 4096.0;
}

class Machine : public Agreement {
public:
    explicit Machine(Processes& processes) : processes_(&processes) {}
    void sum(std::span<double> values) const override { processes_->sum(values); }
    void largest(std::span<double> values) const override { processes_->largest(values); }
    using Agreement::largest;
    using Agreement::sum;

    // The fastest of several, in which the slowest process counts, by the clock; and by the time of processors, which other work on
    // the machine does not add to.
    template <class Work>
    double fastest(int times, const Work& work) const {
        double best = 1e300;
        for (int i = 0; i < times; ++i) {
            sum(0.0);
            const Stopwatch clock;
            work();
            best = std::min(best, largest(clock.seconds()));
        }
        return best;
    }
    template <class Work>
    double fastest_processing(int times, const Work& work) const {
        double best = 1e300;
        for (int i = 0; i < times; ++i) {
            sum(0.0);
            const std::clock_t begin = std::clock();
            work();
            best = std::min(best, largest(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC));
        }
        return best;
    }

private:
    Processes* processes_;
};

void measure_machine(Processes& processes, const Machine& machine) {
    const std::size_t n = std::size_t{1} << 26;
    std::vector<char> from(n, 1), to(n);
    const double copy = machine.fastest(9, [&] { std::memcpy(to.data(), from.data(), n); });
    const auto size = static_cast<std::size_t>(processes.size());
    const Processes::Counts counts = processes.counts(std::vector<int>(size, 1 << 20));
    std::vector<double> given(size << 20), taken(size << 20);
    const double exchange =
        machine.fastest(25, [&] { processes.exchange(std::span<const double>(given), std::span(taken), counts); });
    const Processes::Counts few = processes.counts(std::vector<int>(size, 1));
    const double latency = machine.fastest(
        99, [&] { processes.exchange(std::span<const double>(given).first(size), std::span(taken).first(size), few); });
    if (processes.rank() != 0) return;
    fmt::print(
        "{} processes: each copies {:.2f} GB/s (read and written {:.2f}); exchanges 8 MiB with each in {:.2f} ms, 8 bytes in "
        "{:.1f} µs\n",
        size, 1e-9 * static_cast<double>(n) / copy, 2e-9 * static_cast<double>(n) / copy, 1e3 * exchange, 1e6 * latency);
    fmt::print("{:>9}{:>9}{:>11}{:>11}{:>9}{:>11}{:>11}{:>11}{:>11}{:>11}{:>10}{:>11}\n", "patches", "unknowns", "rays",
               "bytes/ray", "T s", "T ns/ray", "product ms", "ns/ray", "exchange", "64 bounces", "sent MB", "messages");
}

void measure(const Scene& scene, std::size_t patches, bool with_entries, Processes& processes, const Machine& machine) {
    const double before = machine.sum(resident_bytes());
    const Stopwatch clock;
    const SharedSystem system(scene, {.patches = patches, .rays = 64, .memory = 1e12}, processes);
    const double built = machine.largest(clock.seconds());
    const double bytes = machine.sum(resident_bytes()) - before, rays = static_cast<double>(system.rays());
    const SharedRays& table = system.table();
    const double traced = machine.largest(table.seconds());
    const SharedChannel K = system.channel(0);
    const Vector b = system.direct(0);
    Vector x = b, y(b.size());
    const Processes::Traffic sent = processes.traffic();
    K.apply(x, y);
    const Processes::Traffic after = processes.traffic();
    const double megabytes = machine.sum(0.5e-6 * static_cast<double>(after.bytes - sent.bytes));
    const double messages = machine.sum(0.5 * static_cast<double>(after.messages - sent.messages));
    const double product = machine.fastest_processing(25, [&] { K.apply(x, y); });
    const double exchange = machine.fastest(9, [&] { table.fetch(x); });
    const double bounces = machine.fastest_processing(1, [&] {
        TermSeries series(K, b);
        while (series.bounce() < 64) series.advance();
    });
    if (processes.rank() == 0)
        fmt::print(
            "{:>9}{:>9}{:>11}{:>11.2f}{:>9.2f}{:>11.1f}{:>11.2f}{:>11.3f}{:>11.2f}{:>11.3f}{:>10.3f}{:>11.0f}   built in {:.2f} "
            "s\n",
            system.space().patches().size(), system.space().size(), rays, bytes / rays, traced, 1e9 * traced / rays, 1e3 * product,
            1e9 * product / rays, 1e3 * exchange, bounces, megabytes, messages, built);
    if (!with_entries) return;
    const PetscMatrix A = petsc_matrix(K);
    const std::unique_ptr<Petsc> petsc = start_petsc("");
    const Stopwatch assembling;
    const std::unique_ptr<PetscEntries> entries = petsc->entries(A);
    const double assembled = machine.largest(assembling.seconds());
    const double of_petsc = machine.fastest_processing(9, [&] { entries->apply(x, y); });
    const double all = machine.sum(entries->entries()), stored = machine.sum(entries->bytes());
    if (processes.rank() == 0)
        fmt::print(
            "          MATAIJ: {:.0f} entries, {:.2f} bytes each, {:.2f} a ray; assembled in {:.2f} s; a product {:.2f} ms\n", all,
            stored / all, stored / rays, assembled, 1e3 * of_petsc);
}

}  // namespace

int main(int argc, char** argv) {
    using namespace neumann;
    const auto make = reinterpret_cast<Processes* (*)()>(function_in_module("libneumann_mpi.so", "neumann_processes", "no MPI"));
    const std::unique_ptr<Processes> processes(make());
    const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
    const Machine machine(*processes);
    std::vector<std::size_t> sizes;
    bool with_entries = false;
    for (int i = 1; i < argc; ++i) {
        if (argv[i] == std::string_view("--entries"))
            with_entries = true;
        else
            sizes.push_back(std::strtoul(argv[i], nullptr, 10));
    }
    if (sizes.empty()) sizes = {10000, 100000, 1000000};
    const Scene scene = read_scene(SCENES "/cornell-box/cornell-box.xml", {});
    measure_machine(*processes, machine);
    for (const std::size_t patches : sizes) measure(scene, patches, with_entries, *processes, machine);
    return 0;
}
