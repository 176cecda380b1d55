// `neumann strip`: renders a scene several times with one thing varied, and lays the pictures out side by side.
#pragma once

#include "apps/requests/strip_request.h"

namespace neumann {

// Returns the exit code. Throws InputError and RunError; then nothing is written.
int strip_command(const StripRequest& request);

}  // namespace neumann
