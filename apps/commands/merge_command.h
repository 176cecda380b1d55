// `neumann merge A B C -o DIR`: renders of one scene by different seeds, or parts of one, become one.
#pragma once

#include "apps/requests/requests_of_renders.h"

namespace neumann {

// Returns the exit code, 0. Throws InputError and RunError.
int merge_command(const MergeRequest& request);

}  // namespace neumann
