// A ray through space.
#pragma once

#include "core/base/vec.h"

#include <limits>

namespace neumann {

struct Ray {
    Vec3 origin, direction;  // direction: unit length
    double length = std::numeric_limits<double>::infinity();
};

}  // namespace neumann
