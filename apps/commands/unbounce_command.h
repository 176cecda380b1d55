// `neumann unbounce INPUT`: finds the bounces in pictures of a scene under separate lights.
#pragma once

#include "apps/requests/unbounce_request.h"

namespace neumann {

// Prints a table and doubts, and writes pictures into the output folder, all or nothing. The exit code is 0 whatever
// the doubts. Throws InputError, RunError, and Stopped at Ctrl-C.
int unbounce_command(const UnbounceRequest& request);

}  // namespace neumann
