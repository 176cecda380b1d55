// `neumann study`: compares methods, error against time, bounce by bounce.
#pragma once

#include "apps/requests/study_request.h"

namespace neumann {

// Returns the exit code, 0 also if Ctrl-C ended it early. Throws InputError and RunError.
int study_command(const StudyRequest& request);

}  // namespace neumann
