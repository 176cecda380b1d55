// `neumann export SCENE`: writes T, R, Le and the measures as files that SciPy reads.
#pragma once

#include "apps/commands/patch_scene.h"

#include <string>

namespace neumann {

// Throws InputError if T and R of the system are too large for memory as matrices.
void check_matrix_memory(const PatchOptions& options, const TracedSystem& system);
// patches.csv: a row for each side of a patch, with its first unknown.
std::string patches_table(const PatchSpace& space);

// Writes all files or none. Returns the exit code, 0. Throws InputError, and RunError if the disk is full or Ctrl-C was pressed.
int export_command(const ExportRequest& request);

}  // namespace neumann
