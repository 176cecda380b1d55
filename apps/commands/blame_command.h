// `neumann blame PICTURES SCENE`: which bounce of another renderer is wrong, and in what way.
#pragma once

#include "apps/requests/blame_request.h"
#include "operators/experiments/blame/blame.h"

namespace neumann {

// Throws InputError for a counting that there is not.
BlameSettings blame_settings(const BlameRequest& request);

// Prints the verdict, and writes it with pictures into the output folder, all or nothing. Exit code 0, whatever it is. Throws
// InputError, and Stopped at Ctrl-C.
int blame_command(const BlameRequest& request);

}  // namespace neumann
