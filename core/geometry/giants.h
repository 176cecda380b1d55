// Faces that dwarf everything else, such as a ground of kilometres around a room. If Embree's floats had to hold them, the
// coordinates of all else, and the distance at which rays leave a surface, would be as coarse as they are large: so rays meet them
// one by one, in double.
#pragma once

#include "core/geometry/bounds.h"
#include "core/geometry/face.h"
#include "core/geometry/shape.h"

#include <optional>
#include <vector>

namespace neumann {

struct Giants {
    std::vector<Face> faces;  // in order; a few, or none
    Bounds rest;              // of all others; empty where there are none

    // From where to where a ray, up to `distance`, is near the rest, where alone floats are asked; nothing where it is not. All of
    // it where there are no giants. `direction`: unit length.
    struct Part {
        double begin, end;
    };
    std::optional<Part> near_rest(const Vec3& origin, const Vec3& direction, double distance) const;
};

// What has no extent is left out.
Giants find_giants(const std::vector<Shape>& shapes);

}  // namespace neumann
