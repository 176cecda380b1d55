// Views of the whole scene, which the file does not give.
#pragma once

#include "core/geometry/bounds.h"
#include "core/reader/formats/collada/nodes.h"

#include <optional>

namespace neumann::reader::collada {

// Mitsuba's to_world of a camera that looks at the middle of the scene, at a distance of three times the radius of the
// sphere around its box, as the courses' program places it. `from` is the direction from the scene to the camera, not
// 0, and `up` the index of an axis.
Mat4 view_of(const Bounds& scene, const Vec3& from, int up);

// The direction in which the courses' program places a camera: the sum of the camera's position and its direction of
// view, in the file's units. Of a broken matrix the first 12 numbers are used. Nothing if the sum is 0 or unknown.
std::optional<Vec3> course_direction(const Instance& camera);

// The direction that is in front of the scene by the custom of the up axis, for files without a camera.
Vec3 front(int up);

}  // namespace neumann::reader::collada
