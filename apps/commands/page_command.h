// `neumann page DIR`: makes page, slides and strips again from the files of a render.
#pragma once

#include "apps/requests/requests_of_renders.h"

namespace neumann {

// Returns the exit code, 0. Throws InputError and RunError.
int page_command(const PageRequest& request);

}  // namespace neumann
