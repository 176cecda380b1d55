// `neumann unbounce INPUT`: the bounces in pictures of a scene under separate lights.
#pragma once

#include "apps/requests/unbounce_request.h"

namespace neumann {

// Prints a table and doubts, and writes pictures into the output folder, all or nothing. Exit code 0, whatever is doubted. Throws
// InputError, RunError, and Stopped at Ctrl-C.
int unbounce_command(const UnbounceRequest& request);

}  // namespace neumann
