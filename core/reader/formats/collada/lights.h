// Lights of the common profile and of the courses' profile.
#pragma once

#include "core/reader/formats/collada/import.h"
#include "core/reader/formats/collada/nodes.h"

namespace neumann::reader::collada {

// A course's area light: center + s·a + t·b, s and t in [-1, 1], shining to the side of `normal`.
struct Lamp {
    Vec3 center, a, b, normal;

    // s, t, and the height above its plane, in units of the lamp's size.
    Vec3 coordinates(const Vec3& p) const;
};

// Adds emitters to the scene, and returns the area lights among them. `up`: the file's up axis, 0 to 2.
std::vector<Lamp> add_lights(const std::vector<Instance>& lights, int up, const Import& import);

}  // namespace neumann::reader::collada
