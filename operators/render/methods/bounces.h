// The default number of bounces N with a picture of their own: large enough that the rest is small.
#pragma once

#include "operators/render/from_paths/pilot.h"

namespace neumann {

int default_bounces(const Pilot& pilot);

}  // namespace neumann
