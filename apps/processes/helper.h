// A process that helps the first one: it samples shares of renders, as messages ask it to.
#pragma once

#include "core/base/processes/processes.h"

namespace neumann {

// Returns the exit code, when the first process ends it.
int help(Processes& processes);

}  // namespace neumann
