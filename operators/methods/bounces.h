// How many bounces have a picture of their own, where nothing asks for them: until the rest is small.
#pragma once

#include "operators/pictures/pilot.h"

namespace neumann {

int default_bounces(const Pilot& pilot);

}  // namespace neumann
