#include "apps/commands/run_by_all.h"

#include "apps/processes/together.h"
#include "core/base/error.h"

#include <cstdio>

namespace neumann {

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
