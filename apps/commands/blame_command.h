// `neumann blame PICTURES SCENE`: finds the bounce of another renderer that is wrong, and the mistake.
#pragma once

#include "apps/requests/blame_request.h"
#include "operators/experiments/blame/blame.h"

namespace neumann {

// Throws InputError for an unknown counting.
BlameSettings blame_settings(const BlameRequest& request);

// Prints the verdict, and writes it with pictures into the output folder, all or nothing. The exit code is 0 for any
// verdict. Throws InputError, and Stopped at Ctrl-C.
int blame_command(const BlameRequest& request);

}  // namespace neumann
