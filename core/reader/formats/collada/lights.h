// Reads lights of the common profile and of the courses' profile.
#pragma once

#include "core/reader/formats/collada/import.h"
#include "core/reader/formats/collada/nodes.h"

namespace neumann::reader::collada {

// The area light of a course: the points center + s·a + t·b with s and t in [-1, 1], shining to the side of `normal`.
struct Lamp {
    Vec3 center, a, b, normal;

    // The coordinates s and t of a point, and its height above the plane in units of |a| + |b|.
    Vec3 coordinates(const Vec3& p) const;
};

// Adds emitters to the scene, and returns the area lights among them. `up` is the index of the file's up axis.
std::vector<Lamp> add_lights(const std::vector<Instance>& lights, int up, const Import& import);

}  // namespace neumann::reader::collada
