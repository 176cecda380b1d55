// Faces that dwarf everything else, such as a ground of kilometres around a room. If Embree held them, the float coordinates of all
// other faces, and the offset of ray origins, would be coarse in proportion to their size. Rays are therefore intersected with them
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
    Bounds rest;              // bounds of all other faces; empty if there are none

    // The part of a ray, up to `distance`, that is near the rest; only this part is traced with Embree. Nothing if the
    // ray does not come near; the whole ray if there are no giants. `direction` has unit length.
    struct Part {
        double begin, end;
    };
    std::optional<Part> near_rest(const Vec3& origin, const Vec3& direction, double distance) const;
};

// Shapes without extent are left out; faces of instances are no giants.
Giants find_giants(const std::vector<Shape>& shapes);

}  // namespace neumann
