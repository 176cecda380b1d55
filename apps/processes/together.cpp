#include "apps/processes/together.h"

#include "apps/processes/launch.h"
#include "core/base/error.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

namespace neumann {

void end_all(const Processes& processes, const std::exception& error) {
    std::fputs(fmt::format("neumann: process {} on {}: {}\n", processes.rank(), processes.machine(), error.what()).c_str(), stderr);
    std::fflush(nullptr);
    std::_Exit(1);
}

int run_together(Processes& processes, PatchOptions options, const std::function<int(const PatchOptions&)>& run) {
    options.threads = threads_of_process(options.threads);
    const bool speaks = processes.rank() == 0;
    if (!speaks) {
        options.quiet = true;
        if (!std::freopen("/dev/null", "w", stdout)) throw RunError("/dev/null cannot be opened");
    }
    try {
        return together(processes, [&] { return run(options); });
    } catch (const InputError&) {
        if (speaks) throw;
        return 0;
    }
}

}  // namespace neumann
