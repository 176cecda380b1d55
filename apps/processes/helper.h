// A process that helps the first one: it samples shares of renders, as messages request.
#pragma once

#include "core/base/processes/processes.h"

namespace neumann {

// Runs until the first process ends it. Returns the exit code.
int help(Processes& processes);

}  // namespace neumann
