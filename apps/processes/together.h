// A command in which all processes that were started together take part, each reading the same command line: process 0 speaks.
#pragma once

#include "apps/commands/patch_scene.h"
#include "core/processes/processes.h"

#include <functional>

namespace neumann {

// Calls run(options), on other processes than 0 with their output silenced, and returns the exit code. What is wrong with the input
// all find, and process 0 says it; another error of one process ends them all.
int run_together(Processes& processes, PatchOptions options, const std::function<int(const PatchOptions&)>& run);

}  // namespace neumann
