// Commands that all processes of a launch run together.
#pragma once

#include "apps/commands/patch_scene.h"
#include "apps/processes/launch.h"

#include <functional>

namespace neumann {

// Runs a command for which each process reads the same command line. Calls run(options), with the output of processes
// other than 0 silenced, and returns the exit code. All processes find the same errors of the input, and process 0
// reports them; another error of one process ends them all.
int run_together(Processes& processes, PatchOptions options, const std::function<int(const PatchOptions&)>& run);

// Runs a command by all processes of this launch, as run(request, processes), or by this one alone, with null.
template <class Request>
int run_by_all(const Request& request, int (*run)(const Request&, Processes*)) {
    Processes* const processes = launched();
    if (!processes) return run(request, nullptr);
    return run_together(*processes, request.patches, [&](const PatchOptions& options) {
        Request mine = request;
        mine.patches = options;
        return run(mine, processes);
    });
}

}  // namespace neumann
