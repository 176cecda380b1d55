// Commands that all processes of a launch run together.
#pragma once

#include "apps/commands/patch_scene.h"
#include "apps/processes/launch.h"

#include <functional>

namespace neumann {

// A command for which each reads the same command line: process 0 speaks. Calls run(options), on other processes than 0 with their
// output silenced, and returns the exit code. What is wrong with the input all find, and process 0 says it; another error of one
// process ends them all.
int run_together(Processes& processes, PatchOptions options, const std::function<int(const PatchOptions&)>& run);

// A command by all processes of this launch, run(request, processes), or by this one alone, with null.
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
