// `neumann conform DIR`: renders a folder of Mitsuba's regression scenes and tests the pictures against its references.
#pragma once

#include "apps/requests/requests_of_scenes.h"

namespace neumann {

// Prints a table of all scenes under FOLDER/tests/scenes, and writes pictures of those that are rejected. Returns the exit code: 1
// if a scene is rejected, otherwise 0. Throws InputError if there are no scenes.
int conform_command(const ConformRequest& request);

}  // namespace neumann
