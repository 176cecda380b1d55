// `neumann replay`: one sample of a render traced again, with its path.
#pragma once

#include "apps/requests/requests_of_renders.h"

namespace neumann {

// Throws InputError if the folder, its run.json or the sample does not exist, and if the method has no paths.
int replay_command(const ReplayRequest& request);

}  // namespace neumann
