// `neumann replay`: traces one sample of a render again and shows its path.
#pragma once

#include "apps/requests/requests_of_renders.h"

namespace neumann {

// Throws InputError if the folder, its run.json or the sample does not exist, and if the method has no paths.
int replay_command(const ReplayRequest& request);

}  // namespace neumann
