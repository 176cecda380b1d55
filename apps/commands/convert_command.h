// `neumann convert SCENE OUT.xml`: writes a scene of any format as a Mitsuba 3 file.
#pragma once

#include "apps/requests/requests_of_scenes.h"

namespace neumann {

// Writes OUT.xml, and beside it the folders meshes and textures with the files that it names: all files or none.
// Returns the exit code, 0. Throws InputError, and RunError if the disk is full.
int convert_command(const ConvertRequest& request);

}  // namespace neumann
